#include "dashpot/identify/judge/forgetting.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A sine of 10 mm and so many Hz at 500 Hz; its force is only there for its span.
Record sine(const std::string& name, double frequency, double seconds, double amplitude = 0.01) {
  Record record;
  record.name = name;
  record.sample_time = 0.002;
  Channel x{"displacement", "m", {}, ""}, v{"velocity", "m/s", {}, ""}, f{"force", "N", {}, ""},
      i{"current", "A", {}, ""};
  const double w = 2 * std::numbers::pi * frequency;
  for (double t = 0; t < seconds; t += record.sample_time) {
    record.time.push_back(t);
    x.samples.push_back(amplitude * std::sin(w * t));
    v.samples.push_back(amplitude * w * std::cos(w * t));
    f.samples.push_back(1000 * v.samples.back());
    i.samples.push_back(1);
  }
  record.channels = {x, v, f, i};
  return record;
}

/// A viscous damper and a state of its own.
class WithState : public DamperModel {
 public:
  ModelKind kind() const override { return ModelKind::Law; }
  std::string name() const override { return "with_state"; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override { return 1; }
  std::size_t state_size() const noexcept override { return 1; }
  void rest(const DamperInput&, std::span<double> z) const noexcept override { z[0] = 0; }
  double force(const DamperInput& in, std::span<const double> z) const noexcept override {
    return 1000 * in.velocity + 100 * z[0];
  }
  std::unique_ptr<DamperModel> with_offset(double) const override { return nullptr; }
  Value to_json() const override { return {}; }
};

/// The velocity through a lag of `seconds`, with the gain of an integral where that is long.
class Lag final : public WithState {
 public:
  explicit Lag(double seconds) : seconds_(seconds) {}
  void advance(const DamperInput& from, const DamperInput&, double dt,
               std::span<double> z) const noexcept override {
    z[0] += dt * (20 * from.velocity - z[0] / seconds_);
  }

 private:
  double seconds_;
};

/// Two wells, z = -1 and z = 1; a push over the ridge, and it stays in the other one.
class TwoWells final : public WithState {
 public:
  void rest(const DamperInput&, std::span<double> z) const noexcept override { z[0] = 1; }
  void advance(const DamperInput& from, const DamperInput&, double dt,
               std::span<double> z) const noexcept override {
    z[0] += dt * (20 * (z[0] - std::pow(z[0], 3)) + 20 * from.velocity);
  }
};

/// Holds the velocity of its last step, 6 ms apart, and knows nothing else of the past.
class Clocked final : public WithState {
 public:
  std::size_t state_size() const noexcept override { return 2; }
  double feedback_step() const noexcept override { return 0.006; }
  void rest(const DamperInput& in, std::span<double> z) const noexcept override {
    z[0] = in.velocity;
    z[1] = 0;
  }
  void advance(const DamperInput&, const DamperInput& to, double dt,
               std::span<double> z) const noexcept override {
    z[1] += dt;
    if (z[1] < 0.006 - 1e-9) return;
    z[0] = to.velocity;
    z[1] = 0;
  }
  double force(const DamperInput&, std::span<const double> z) const noexcept override {
    return 1000 * z[0];
  }
};

constexpr double kSpan = 2 * 1000 * 0.01 * 2 * std::numbers::pi;  // N, of 1 Hz

}  // namespace

TEST_CASE("forgetting: a lag that is short beside the motion dies out, one that is long does not") {
  const std::vector<Record> records{sine("slow", 0.5, 8), sine("fast", 1, 8)};
  const Forgetting brief = forgetting(Lag(0.2), records, DriveUnit::Ampere, kSpan);
  CHECK(brief.is_tested);
  CHECK(brief.is_forgotten());
  CHECK(brief.seconds > 0.05);
  CHECK(brief.seconds < 2);
  const Forgetting lasting = forgetting(Lag(1000), records, DriveUnit::Ampere, kSpan);
  CHECK(!lasting.is_forgotten());
  CHECK(lasting.share_left > 0.02);
}

TEST_CASE("forgetting: a model that settles in one of two wells is found out") {
  // The fast motion pushes it from one well to the other; the slow one leaves it where it is.
  const std::vector<Record> records{sine("slow", 0.1, 20), sine("fast", 3, 4.1, 0.1)};
  const Forgetting result = forgetting(TwoWells(), records, DriveUnit::Ampere, kSpan);
  CHECK(!result.is_forgotten());
  CHECK(result.record == "slow");
  CHECK_CLOSE(result.share_left, 200 / kSpan, 0.2, 0);  // the wells are 200 N apart
}

TEST_CASE(
    "forgetting: hysteresis under strokes beyond its loop forgets; no state, nothing to test") {
  const std::vector<Record> records{sine("slow", 0.5, 8), sine("short", 1, 0.7)};
  const Forgetting none = forgetting(LawModel::constant(find_law("bingham"), {1000, 0, 0, 0}),
                                     records, DriveUnit::Ampere, kSpan);
  CHECK(!none.is_tested);
  CHECK(none.is_forgotten());

  const Law& dahl = find_law("dahl");
  std::vector<double> values;
  for (const ParamInfo& param : dahl.params) values.push_back(param.value);
  const Forgetting result =
      forgetting(LawModel::constant(dahl, values), records, DriveUnit::Ampere, 1000);
  CHECK(result.is_tested);
  CHECK(result.is_forgotten());
}

TEST_CASE("forgetting: a model with a clock of its own is judged by its force, not by its clock") {
  // The record ends between two of its steps, after 4.018 s. A run that began with that clock would
  // hold other velocities all along, up to 4 % of the span apart.
  const std::vector<Record> records{sine("one", 3, 4.02)};
  CHECK(forgetting(Clocked(), records, DriveUnit::Ampere, 3 * kSpan).is_forgotten());
}

TEST_CASE(
    "forgetting: the slow spring of Spencer's law is no fault, and the time says that it is slow") {
  // As published, y relaxes with (c0 + c1) / k0 = (21 + 283) / 46.9 = 6.5 s.
  const Law& law = find_law("modified_bouc_wen");
  std::vector<double> values;
  for (const ParamInfo& param : law.params) values.push_back(param.value);
  const std::vector<Record> records{sine("slow", 0.5, 4, 0.025), sine("fast", 3, 1, 0.002)};
  const Forgetting result =
      forgetting(LawModel::constant(law, values), records, DriveUnit::Ampere, 1000);
  CHECK(result.is_forgotten());
  CHECK(result.seconds > 2);

  // Where its hysteresis holds it, it takes minutes, and it is the same law.
  const LawModel spencer = load_parameters("spencer1997");
  const Dataset bench = run_virtual_bench(spencer, DriveUnit::Volt, {.drive_levels = {0, 2.25}});
  const Forgetting slow = forgetting(spencer, bench.records, DriveUnit::Volt, 2700);
  CHECK(slow.is_forgotten());
  CHECK(slow.seconds > 30);
  CHECK(slow.seconds < 200);
}

TEST_CASE("forgetting: a single record, and one that is shorter than the time allowed") {
  CHECK(forgetting(Lag(0.2), {sine("only", 1, 8)}, DriveUnit::Ampere, kSpan).is_forgotten());
  CHECK(forgetting(Lag(0.2), {sine("short", 2, 0.5)}, DriveUnit::Ampere, kSpan).is_forgotten());
  CHECK(!forgetting(Lag(1000), {sine("short", 2, 0.6)}, DriveUnit::Ampere, kSpan).is_forgotten());
}
