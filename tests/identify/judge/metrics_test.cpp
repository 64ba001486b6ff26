#include <vector>

#include "dashpot/evaluate.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("TC-11: every metric of the reference case") {
  const std::vector<double> measured = {0, 100, -200, 300, -100, 50};
  const std::vector<double> modelled = {10, 90, -180, 320, -120, 40};
  ErrorSums sums;
  for (std::size_t k = 0; k < measured.size(); ++k) sums.add(measured[k], modelled[k]);
  const Metrics m = metrics(sums);
  // To the digits printed in docs/sources.md.
  CHECK_CLOSE(m.rmse, 15.811388, 0, 5e-7);
  CHECK_CLOSE(m.rms_span, 3.1622777, 0, 5e-8);
  CHECK_CLOSE(m.rms_half_span, 6.3245553, 0, 5e-8);
  CHECK_CLOSE(m.esr, 1.0084034, 0, 5e-8);
  CHECK_CLOSE(m.r2, 0.98991597, 0, 5e-9);
  CHECK_CLOSE(m.fit, 89.958071, 0, 5e-7);
  CHECK_CLOSE(m.vaf, 99.002801, 0, 5e-7);
  CHECK_CLOSE(m.mae, 15, 1e-15, 0);
  CHECK_CLOSE(m.max_error, 20, 1e-15, 0);
  CHECK_CLOSE(m.nrmse_max, 100 * 15.811388 / 300, 1e-7, 0);
}

TEST_CASE("sums of parts are the sums of the whole") {
  ErrorSums whole, first, second;
  for (int k = 0; k < 10; ++k) {
    whole.add(-5 + k, k * k * 0.1);
    (k < 4 ? first : second).add(-5 + k, k * k * 0.1);
  }
  first.add(second);
  first.add(ErrorSums{});
  CHECK(first.n == whole.n);
  CHECK_CLOSE(metrics(first).esr, metrics(whole).esr, 1e-14, 0);
  CHECK(first.force_min == whole.force_min);
  CHECK(first.force_max == whole.force_max);
}

TEST_CASE("energy of a linear damper over one period is pi c omega X^2") {
  constexpr double kPi = 3.14159265358979323846, kDamping = 1000, kOmega = 2 * kPi,
                   kAmplitude = 0.01;
  std::vector<double> time, velocity, force;
  for (int k = 0; k <= 1000; ++k) {
    time.push_back(k * 1e-3);
    velocity.push_back(kAmplitude * kOmega * std::cos(kOmega * time.back()));
    force.push_back(kDamping * velocity.back());
  }
  // The trapezoidal rule is exact here: whole periods of a sine of twice the frequency.
  CHECK_CLOSE(dissipated_energy(time, velocity, force),
              kPi * kDamping * kOmega * kAmplitude * kAmplitude, 1e-12, 0);
}
