#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "damper/kinds/passive_network/passive_network_example.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/model_file.h"
#include "sanitized.h"
#include "support.h"

using namespace dashpot;

namespace {

/// F = damping (v - times w), w' = rate (v - w): a first-order lag beside a dashpot. For times > 1
/// it feeds energy into slow motions, up to rate sqrt(times - 1).
class LaggingDamper : public DamperModel {
 public:
  LaggingDamper(double times, double rate, double force = 0)
      : times_(times), rate_(rate), force_(force) {}

  ModelKind kind() const override { return ModelKind::Law; }
  std::string name() const override { return "lagging"; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override { return 2; }
  std::size_t state_size() const noexcept override { return 1; }
  void rest(const DamperInput&, std::span<double> state) const noexcept override { state[0] = 0; }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    const double middle = (from.velocity + to.velocity) / 2;
    state[0] = middle + (state[0] - middle) * std::exp(-rate_ * dt);
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override {
    return kDamping * (input.velocity - times_ * state[0]) + force_;
  }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<LaggingDamper>(times_, rate_, force_ + newton);
  }
  Value to_json() const override { return {}; }

  static constexpr double kDamping = 1000;

 private:
  double times_, rate_, force_;
};

const Domain kCar{-0.05, 0.05, -1, 1, 0, 2};

/// Parameters of a law with a filter around its defaults, without a dashpot beside it that would
/// hide what the filter does: its set allows a filter of 200 1/s, and it has one of `share` times
/// as much.
std::vector<double> at_the_edge(const std::string& name, double share, Random& random) {
  const Law& law = find_law(name);
  std::vector<double> p;
  for (const ParamInfo& param : law.params) p.push_back(param.value * random.uniform(0.3, 3));
  for (const char* beside : {"c", "C_po"})
    for (std::size_t k = 0; k < p.size(); ++k)
      if (law.params[k].name == beside) p[k] = 0;
  p[law.index_of("f0")] = 0;

  // The width of the loop in time sets what is allowed: tau itself, or the one over a_s.
  constexpr double kAllowed = 200;  // 1/s
  const double allowed = law.fastest_rate(p.data());
  if (name == "tanh_acceleration")
    p[law.index_of("tau")] *= allowed / kAllowed;
  else
    p[law.index_of("a_s")] *= kAllowed / allowed;
  p[law.rate_parameter] = share * kAllowed;
  return p;
}

/// Moves a model from rest by a sum of sines of random size, rate and phase, which begins slowly,
/// and gives each step's power and length.
void walk(const LawModel& model, Random& random,
          const std::function<void(double power, double step)>& step_done) {
  constexpr double kStep = 1e-4;
  std::array<double, 6> size, rate, phase;
  for (std::size_t k = 0; k < size.size(); ++k) {
    rate[k] = 6 * std::exp(random.uniform(0, 5));
    size[k] = 0.1 * random.uniform();
    phase[k] = random.uniform(0, 6.28);
  }
  const auto input_at = [&](int n) {
    const double t = n * kStep;
    double speed = 0;
    for (std::size_t k = 0; k < size.size(); ++k)
      speed += size[k] * std::sin(rate[k] * t + phase[k]);
    return DamperInput{0, speed * std::min(1.0, t / 0.05), 0};
  };

  std::vector<double> state(model.state_size());
  model.rest({}, state);
  for (int n = 0; n < 20000; ++n) {
    const DamperInput from = input_at(n), to = input_at(n + 1);
    const double before = model.force(from, state) * from.velocity;
    model.advance(from, to, kStep, state);
    step_done((before + model.force(to, state) * to.velocity) / 2, kStep);
  }
}

}  // namespace

TEST_CASE("a dashpot takes out all that passes through it") {
  const Dissipation result =
      dissipation(*load_parameter_set("lai_liao2002").model.with_offset(0), kCar);
  CHECK(result.is_tested);
  CHECK(result.dissipates());
  CHECK(activity(result, DriveUnit::Ampere).empty());
}

TEST_CASE("a model that feeds energy in is found, with its band and its damping") {
  // active below 20 Hz: w sqrt(2 - 1) = rate
  const double rate = 2 * std::numbers::pi * 20;
  const LaggingDamper damper(2, rate);
  const Dissipation result = dissipation(damper, kCar, 1);
  CHECK_FALSE(result.dissipates());
  CHECK(result.active_from == 1);
  CHECK(result.active_to == 14);  // the last of its frequencies below 20 Hz
  CHECK(result.frequency == 1);   // where the lag is least

  // Re(F / v) = damping (1 - times / (1 + (w / rate)^2))
  const double ratio = 2 * std::numbers::pi * result.frequency / rate;
  const double expected = LaggingDamper::kDamping * (1 - 2 / (1 + ratio * ratio));
  CHECK_CLOSE(result.damping, expected, 5e-3, 0);
  CHECK(contains(activity(result, DriveUnit::Volt), "motions of 1 to 14 Hz: at 1 Hz"));
}

TEST_CASE("what only delays, and what only preloads, feeds nothing in") {
  CHECK(dissipation(LaggingDamper(0.9, 300), kCar).dissipates());
  const Dissipation plain = dissipation(LaggingDamper(0.9, 300), kCar);
  const Dissipation preloaded = dissipation(LaggingDamper(0.9, 300, 5000), kCar);
  CHECK_CLOSE(preloaded.share, plain.share, 1e-6, 0);
  CHECK_CLOSE(preloaded.damping, plain.damping, 1e-6, 0);
}

TEST_CASE("the verdict is the same on any number of threads and for a domain without motion") {
  const LaggingDamper damper(2, 100);
  const Dissipation one = dissipation(damper, {}, 1), three = dissipation(damper, {}, 3);
  const Dissipation usual = dissipation(damper, usual_domain(0, 0), 2);
  CHECK(one.damping == three.damping);
  CHECK(one.share == usual.share);
  CHECK(one.amplitude == usual.amplitude);
}

TEST_CASE("the lag of a tanh law beyond tau r = 1 shows as what it is") {
  // F = f_y tanh(kappa (v - tau r (v - w))): in small motions a dashpot of f_y kappa (1 - tau r /
  // (1 + (r / w)^2)), positive for tau r <= 1.
  const auto with = [](double tau) {
    LawModel model = load_parameters("vrths_mr_tanh_acceleration");
    Dependence parameters = model.parameters();
    parameters.coefficients[model.law().index_of("tau")] = {tau};
    return LawModel(model.law(), parameters, DriveUnit::Ampere, 0);
  };
  CHECK(dissipation(with(0.001), kCar).dissipates());
  CHECK_FALSE(dissipation(with(0.0077), kCar).dissipates());
}

TEST_CASE("a law with a filter takes energy out of any motion within its set") {
  // From rest nothing is stored that could come back, so the work never falls below 0, whatever the
  // motion; a sum of sines that starts at rest is as good as any.
  Random random(7);
  for (const std::string name : {"tanh_acceleration", "arctan", "sigmoid", "hysteretic_biviscous"})
    for (int trial = 0; trial < 20; ++trial) {
      CAPTURE(name);
      CAPTURE(trial);
      const LawModel model = LawModel::constant(find_law(name), at_the_edge(name, 1, random));
      double work = 0, passed = 0, least = 0;
      walk(model, random, [&](double power, double step) {
        work += power * step;
        passed += std::abs(power) * step;
        least = std::min(least, work);
      });
      CHECK(passed > 0);
      CHECK(least > -1e-3 * passed);
    }
}

TEST_CASE("a law with a filter twice as quick as its set allows feeds energy in") {
  Random random(8);
  for (const std::string name : {"tanh_acceleration", "arctan", "sigmoid", "hysteretic_biviscous"})
    for (int trial = 0; trial < 3; ++trial) {
      CAPTURE(name);
      Random same = random;
      CHECK(dissipation(LawModel::constant(find_law(name), at_the_edge(name, 1, random)), kCar)
                .dissipates());
      CHECK_FALSE(dissipation(LawModel::constant(find_law(name), at_the_edge(name, 2, same)), kCar)
                      .dissipates());
    }
}

TEST_CASE("a passive network takes energy out, whatever its numbers are") {
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 2 : 10); ++seed) {
    const PassiveNetworkModel model("passive_network", {example_passive_network(seed, 1.5)});
    CHECK(dissipation(model, kCar).dissipates());
  }
}

TEST_CASE("a set of parameters says where it feeds energy in, and no other does" *
          doctest::test_suite("long")) {
  for (const std::string& name : parameter_set_names()) {
    CAPTURE(name);
    const ParameterSet set = load_parameter_set(name);
    const Dissipation measured = dissipation(set.model, usual_domain(set.drive_min, set.drive_max));
    INFO(format_json(to_json(measured)));
    CHECK(measured.dissipates() == set.dissipation.dissipates());
    if (measured.dissipates()) continue;
    CHECK(measured.frequency == set.dissipation.frequency);
    CHECK(measured.active_from == set.dissipation.active_from);
    CHECK(measured.active_to == set.dissipation.active_to);
    CHECK_CLOSE(measured.damping, set.dissipation.damping, 1e-3, 0);
    CHECK_CLOSE(measured.share, set.dissipation.share, 1e-3, 0);
  }
}
