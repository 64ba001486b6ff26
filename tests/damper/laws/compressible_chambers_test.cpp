#include "dashpot/damper/laws/compressible_chambers.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/laws/plate_bingham.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

/// 10 mm at 1 Hz.
DamperInput sine(double t) {
  const double w = 2 * std::numbers::pi;
  return {0.01 * std::sin(w * t), 0.01 * w * std::cos(w * t), 0};
}

/// Forces at `samples` instants of the first second, from rest.
std::vector<double> forces(const std::vector<double>& parameters, int samples) {
  const LawModel model = LawModel::constant(find_law("compressible_chambers"), parameters);
  std::vector<double> state(1), out;
  model.rest(sine(0), state);
  for (int k = 0; k < samples; ++k) {
    model.advance(sine(1.0 * k / samples), sine((k + 1.0) / samples), 1.0 / samples, state);
    out.push_back(model.force(sine((k + 1.0) / samples), state));
  }
  return out;
}

}  // namespace

TEST_CASE("compressible_chambers: at a steady speed it carries the force of plate_bingham") {
  const PlateBingham gap{.c0 = 1120, .f_y = 800, .f0 = 0, .v_s = 0};
  const CompressibleChambers p{.c0 = 1120, .f_y = 800, .k = 2.5e6, .f_f = 20, .f0 = 3};
  for (const double v : {-0.2, 0.01, 0.5}) {
    const double z = plate_bingham_force(&gap, 0, v, nullptr) / p.k;
    double dz;
    compressible_chambers_derivative(&p, 0, v, &z, &dz);
    CHECK_CLOSE(dz, 0, 0, 1e-12);
    CHECK_CLOSE(compressible_chambers_force(&p, 0, v, &z), p.k * z + std::copysign(20, v) + 3,
                1e-15, 0);
  }
}

TEST_CASE(
    "compressible_chambers: below the yield force it is a spring, of stiffness 2 beta A^2 / V") {
  const CompressibleChambers p{.c0 = 1120, .f_y = 800, .k = 2.5e6, .f_f = 0, .f0 = 0};
  const double z = 799.0 / p.k;
  double dz;
  compressible_chambers_derivative(&p, 0, 0.03, &z, &dz);
  CHECK(dz == 0.03);
  CHECK_CLOSE(compressible_chambers_force(&p, 0, 0.03, &z), 799, 1e-14, 0);
}

TEST_CASE(
    "compressible_chambers: its own step agrees with small explicit ones, and stands any "
    "stiffness") {
  const std::vector<double> stiff = {1120, 800, 2e7, 20, 0};  // 18e3 / s
  const std::vector<double> coarse = forces(stiff, 500), fine = forces(stiff, 50000);
  double worst = 0;
  for (std::size_t k = 0; k < coarse.size(); ++k)
    worst = std::max(worst, std::abs(coarse[k] - fine[100 * k + 99]));
  CHECK(worst < 4);  // of 900 N
  const CompressibleChambers rigid{.c0 = 1, .f_y = 800, .k = 1e10, .f_f = 0, .f0 = 0};
  const PlateBingham gap{.c0 = 1, .f_y = 800, .f0 = 0, .v_s = 0};
  const double x[] = {0, 0}, v[] = {0.1, 0.1};
  double z = 0;
  for (int k = 0; k < 5; ++k) compressible_chambers_step(&rigid, x, v, 1e-3, &z);
  CHECK_CLOSE(rigid.k * z, plate_bingham_force(&gap, 0, 0.1, nullptr), 1e-6, 0);
}

TEST_CASE(
    "compressible_chambers: with little viscosity it tends to TC-5.3, zero force at 7.5 mm after "
    "reversal") {
  const std::vector<double> force = forces({0.1, 1000, 4e5, 0, 0}, 4000);
  for (std::size_t k = 1000; k < 2000; ++k) {
    if (force[k - 1] <= 0 || force[k] > 0) continue;
    CHECK_CLOSE(sine((k + 1) / 4000.0).displacement, 7.5e-3, 0, 2e-5);
  }
  CHECK(force[999] > 1000);
  CHECK(force[999] < 1003);
}
