#include "dashpot/damper/laws/modified_bouc_wen.h"

#include <algorithm>
#include <vector>

#include "damper/laws/sine_drive.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/parameter_set.h"

using namespace dashpot;

namespace {

constexpr double kStep = 2.5e-6;  // s: the drive is a straight line within it to 1e-9

/// Forces at the times of TC-4.5 in docs/sources.md.
std::vector<Simulated> forces(const LawModel& model, const Sine& sine) {
  return at_times(model, sine, {0.05, 0.1, 0.2, 0.25, 0.4, 0.5}, kStep);
}

/// The same set in SI, built without the file.
LawModel spencer_si() {
  const Law& law = load_parameters("spencer1997").law();
  Dependence d;
  const auto add = [&](std::vector<double> c) {
    d.forms.push_back(static_cast<Form>(c.size() - 1));
    d.coefficients.push_back(std::move(c));
  };
  add({14000, 69500}), add({2100, 350}), add({28300, 295}), add({4690}), add({500}), add({0.143});
  add({3.63e6}), add({3.63e6}), add({301}), add({2}), add({0});
  return LawModel(law, d, DriveUnit::Volt, 190);
}

}  // namespace

TEST_CASE("Spencer's set in cm and in SI give the forces of TC-4.5" * doctest::test_suite("long")) {
  const std::vector<std::pair<double, std::vector<double>>> printed{
      {0, {385.72013, 65.404021, -617.25625, -529.92749, 473.07619, 65.433473}},
      {1.5, {1069.1411, 21.86209, -1336.465, -1212.1764, 1193.4801, 21.86209}},
      {2.25, {1403.2336, -3.4677, -1687.9443, -1545.6985, 1545.5429, -3.4677004}}};
  for (const LawModel& model : {load_parameters("spencer1997"), spencer_si()})
    for (const auto& [voltage, expected] : printed) {
      CAPTURE(voltage);
      check_forces(forces(model, {0.015, 2.5, voltage}), expected);
    }
}

TEST_CASE("the states of TC-4.5 at 1.5 V") {
  std::vector<double> at_50_ms;
  simulate(load_parameters("spencer1997"), {0.015, 2.5, 1.5}, 0.05, kStep,
           [&](double, const DamperInput&, double, const std::vector<double>& state) {
             at_50_ms = state;
           });
  CHECK_CLOSE(at_50_ms[0], 2.0075591e-3, 0, 1e-10);
  CHECK_CLOSE(at_50_ms[1], 6.4389483e-3, 0, 1e-10);
  CHECK_CLOSE(at_50_ms[2], 1.4998877, 0, 1e-7);
}

TEST_CASE("the cycle of TC-4.5: energy and extreme forces" * doctest::test_suite("long")) {
  struct Cycle {
    double voltage, highest, lowest, energy;
  };
  for (const Cycle& printed :
       {Cycle{1.5, 1196.6351, -1339.6203, 68.48754}, {2.25, 1548.0975, -1690.515, 88.743401}}) {
    double highest = -INFINITY, lowest = INFINITY, energy = 0, power_before = NAN;
    simulate(load_parameters("spencer1997"), {0.015, 2.5, printed.voltage}, 0.8, kStep,
             [&](double t, const DamperInput& input, double force, const std::vector<double>&) {
               if (t < 0.4 - kStep / 2) return;
               highest = std::max(highest, force);
               lowest = std::min(lowest, force);
               const double power = force * input.velocity;
               if (!std::isnan(power_before)) energy += kStep * (power + power_before) / 2;
               power_before = power;
             });
    CHECK_CLOSE(highest, printed.highest, 0, 5.1e-5);
    CHECK_CLOSE(lowest, printed.lowest, 0, 5.1e-5);
    CHECK_CLOSE(energy, printed.energy, 0, 1e-6);
  }
}

TEST_CASE("Lai and Liao's set gives the forces of TC-4.5b") {
  const LawModel model = load_parameters("lai_liao2002");
  check_forces(forces(model, {0.008, 10, 0}),
               {-455.61511, 414.18518, 414.18826, -455.60894, 414.19422, 414.1971});
  check_forces(forces(model, {0.008, 10, 1}),
               {-1504.5912, 1463.3545, 1463.3551, -1504.6686, 1463.3561, 1463.3567});
  check_forces(forces(model, {0.008, 10, 2}),
               {-2553.6702, 2512.5318, 2512.532, -2553.8267, 2512.5326, 2512.5329});
}

TEST_CASE("the own step is finite and keeps |z| below z_max, whatever the parameters and n") {
  const Law& law = load_parameters("spencer1997").law();
  Random random(9);
  const auto size = [&](double low, double high) {
    return std::pow(10, random.uniform(low, high));
  };
  for (int trial = 0; trial < 20000; ++trial) {
    const double n = trial % 3 ? trial % 3 : random.uniform(1, 20), gamma = size(-2, 12);
    const double beta = trial % 5 ? size(-6, 12) : 0, A = size(-3, 5);
    const double p[] = {
        size(-9, 9), size(-10, 8), size(-1, 9), size(-10, 8), 0, 0, gamma, beta, A, n, 0};
    const double z_max = std::pow(A / (gamma + beta), 1 / n);
    const double x[] = {0, 0.01 * random.normal()}, v[] = {random.normal(), random.normal()};
    double z[] = {0, z_max * random.uniform(-1, 1)};
    REQUIRE(law.step(p, x, v, size(-5, 1), z) == 1);
    CHECK(std::isfinite(z[0]));
    CHECK(std::abs(z[1]) <= z_max * (1 + 1e-9));
  }
}

TEST_CASE("the current-driven set with cubic laws: TC-4.5c") {
  struct Case {
    double current, alpha, c0, c1;  // in N, mm, s
    std::vector<double> forces;
  };
  const LawModel model = load_parameters("braz_cesar_barros2013");
  for (const Case& printed :
       {Case{0, 38.24, 0.59, 4.73, {134.11183, 131.22944, -15.68271, -54.436487}},
        Case{0.25, 185.02453, 3.8185937, 23.586875, {522.45502, 494.85202, -244.64958, -451.11584}},
        Case{0.5, 367.45125, 7.26125, 44.4725, {978.4295, 924.41721, -516.21887, -916.18975}}}) {
    CAPTURE(printed.current);
    std::vector<double> p(model.law().params.size());
    model.parameters_at(printed.current, p.data());
    CHECK_CLOSE(p[model.law().index_of("alpha")], 1e3 * printed.alpha, 1e-7, 0);
    CHECK_CLOSE(p[model.law().index_of("c0")], 1e3 * printed.c0, 1e-7, 0);
    CHECK_CLOSE(p[model.law().index_of("c1")], 1e3 * printed.c1, 1e-7, 0);
    check_forces(at_times(model, {0.01, 1, printed.current}, {0.05, 0.1, 0.3, 0.5}, 1e-5),
                 printed.forces);
  }
}

TEST_CASE("the 200 kN set with n = 10 and z without a unit: TC-4.6b") {
  struct Case {
    double current, alpha, c0, c1;
    std::vector<double> forces;
  };
  const ParameterSet set = load_parameter_set("yang2002");
  const LawModel settled(set.model.law(), set.model.parameters(), DriveUnit::Ampere,
                         0);  // the coil at its current
  for (const Case& printed :
       {Case{0.5,
             79580,
             946714.38,
             21765847,
             {151704.4, 78714.493, -154574.62, -78981.973, 154299.83, 135253.71}},
        Case{2,
             136010,
             1055641,
             41217518,
             {221603.25, 136893.9, -224904.63, -137156.49, 224636.75, 202827.55}}}) {
    CAPTURE(printed.current);
    std::vector<double> p(settled.law().params.size());
    settled.parameters_at(printed.current, p.data());
    CHECK_CLOSE(p[settled.law().index_of("alpha")], printed.alpha, 0, 0.5);
    CHECK_CLOSE(p[settled.law().index_of("c0")], printed.c0, 0, 0.5);
    CHECK_CLOSE(p[settled.law().index_of("c1")], printed.c1, 0, 0.5);
    check_forces(
        at_times(settled, {0.0254, 0.5, printed.current}, {0.1, 0.5, 1, 1.5, 2, 2.25}, 2.5e-5),
        printed.forces, 1e-3);
  }
  std::vector<double> at_zero(settled.law().params.size());
  settled.parameters_at(0, at_zero.data());
  CHECK(at_zero[settled.law().index_of("c1")] == -2791630);
  CHECK(set.drive_min == 0.06);
}

TEST_CASE("both forms of the force agree: through the elements and through the dashpot c1") {
  Random random(7);
  const ModifiedBoucWen p{118250, 2625, 28742.5, 4690, 500, 0.143, 3.63e6, 3.63e6, 301, 2, 12};
  for (int k = 0; k < 1000; ++k) {
    const double x = random.uniform(-0.03, 0.03), v = random.uniform(-0.5, 0.5);
    const double z[2] = {random.uniform(-0.03, 0.03), random.uniform(-0.007, 0.007)};
    double dz[2];
    modified_bouc_wen_derivative(&p, x, v, z, dz);
    CHECK_CLOSE(modified_bouc_wen_force(&p, x, v, z), p.c1 * dz[0] + p.k1 * (x - p.x0) + p.f0,
                1e-12, 1e-9);
  }
}

TEST_CASE(
    "the exponent: the fast path for n = 2 is the limit of the general one, and n = 1 works") {
  const double z[2] = {0.001, -0.004};
  double fast[2], general[2];
  ModifiedBoucWen p{118250, 2625, 28742.5, 4690, 500, 0, 3.63e6, 3.63e6, 301, 2, 0};
  modified_bouc_wen_derivative(&p, 0.002, 0.1, z, fast);
  p.n = 2 + 1e-12;
  modified_bouc_wen_derivative(&p, 0.002, 0.1, z, general);
  CHECK_CLOSE(general[1], fast[1], 1e-9, 0);

  // n = 1 at z = 0: z' = A (v - y'), with y' = c0 v / (c0 + c1) at x = y
  const double zero[2] = {0, 0};
  p.n = 1;
  modified_bouc_wen_derivative(&p, 0, 0.1, zero, general);
  CHECK_CLOSE(general[1], 301 * 0.1 * 28742.5 / (28742.5 + 2625), 1e-12, 0);
}

TEST_CASE("z has no scale: alpha/s, s A, gamma/s and beta/s give the same force") {
  const Law& law = load_parameters("spencer1997").law();
  std::vector<double> p{118250, 2625, 28742.5, 4690, 500, 0, 3.63e6, 3.63e6, 301, 2, 0};
  const auto before = forces(LawModel::constant(law, p), {0.015, 2.5, 0});
  const double s = 1.0 / 301;
  p[0] /= s, p[6] /= s, p[7] /= s, p[8] *= s;
  const auto after = forces(LawModel::constant(law, p), {0.015, 2.5, 0});
  for (std::size_t k = 0; k < before.size(); ++k)
    CHECK_CLOSE(after[k].force, before[k].force, 1e-9, 1e-9);
}
