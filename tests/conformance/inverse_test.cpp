#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "conformance/laws.h"
#include "damper/inverse/example_network.h"
#include "damper/inverse/inverses.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/inverse/numeric.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit_inverse.h"
#include "dashpot/identify/judge/track.h"
#include "sanitized.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kSampleTime = 1e-3;

Motion test_motion() {
  return random_motion({.frequency = 3, .duration = 3, .sample_time = kSampleTime, .seed = 3});
}

TrackReport track_numeric(const LawModel& model, const Motion& motion,
                          const std::vector<double>& wanted) {
  const DriverOptions driver = driver_of(model, {});
  return track(model, NumericInverse(model, limits_of(driver, kSampleTime)), Driver(driver), motion,
               wanted);
}

/// Mostly of ordinary size, now and then huge, tiny or not finite.
double any_number(double size, Random& random) {
  switch (random.index(40)) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return std::numeric_limits<double>::infinity();
    case 2:
      return -1e300;
    case 3:
      return 5e-324;
    case 4:
      return 0;
    case 5:
      return size * std::pow(10.0, random.uniform(-12, 6));
    default:
      return size * random.normal();
  }
}

/// How many commands are NaN or outside the limits, of random calls in one go.
std::size_t bad_commands(const InverseModel& inverse, std::size_t calls, Random& random) {
  std::vector<double> state(inverse.state_size());
  inverse.rest({}, state);
  std::size_t bad = 0;
  for (std::size_t k = 0; k < calls; ++k) {
    const double current =
        inverse.command({any_number(1000, random), any_number(0.01, random),
                         any_number(0.1, random), any_number(1, random), any_number(1000, random)},
                        state);
    bad += !(current >= inverse.limits().current_min && current <= inverse.limits().current_max);
  }
  return bad;
}

/// How many calls, when the thorough run is asked for:
/// DASHPOT_INVERSE_CALLS=10000000 dashpot_tests --test-case='no inverse*'
std::optional<std::size_t> thorough_calls() {
  const char* text = std::getenv("DASHPOT_INVERSE_CALLS");
  return text ? std::optional(std::strtoull(text, nullptr, 10)) : std::nullopt;
}

}  // namespace

TEST_CASE("the numeric inverse tracks a random admissible force to 1 % of its span, for every law" *
          doctest::test_suite("long")) {
  const Motion motion = test_motion();
  for_each_law([&](const Law& law) {
    for (const double lag_rate : {0.0, 150.0}) {
      CAPTURE(lag_rate);
      const LawModel model = driven(law, lag_rate);
      const InverseLimits limits = limits_of(driver_of(model, {}), kSampleTime);
      const TrackReport report =
          track_numeric(model, motion, admissible_force(model, motion, limits, 2, 7));
      // Least where only the states feel the current: what one horizon can change is less than all.
      CHECK(report.reachable_share > 60);
      CHECK(report.reachable.rms_span <= 1);
      MESSAGE(law.name << ", lag " << lag_rate << " 1/s: " << report.reachable.rms_span
                       << " % rms, " << 100 * report.reachable.max_error / report.span
                       << " % at most, in reach " << report.reachable_share << " % of the time");
    }
  });
}

TEST_CASE("a force out of reach saturates the current, and the report says so, for every law") {
  const Motion motion = test_motion();
  for_each_law([&](const Law& law) {
    const LawModel model = driven(law, 0);
    const Observer observer(model, {});
    std::vector<double> wanted;
    for (const double v : motion.velocity)
      wanted.push_back(std::copysign(100 * observer.force_max(), v));
    const TrackReport report = track_numeric(model, motion, wanted);
    CHECK(report.reachable_share == 0);
    // All but the instants at which more current means less force, or none.
    if (observer.current_effect() > 0) CHECK(report.saturated_share > 90);
  });
}

TEST_CASE("no inverse gives a current that is NaN or beyond its limits, whatever it is asked") {
  const std::size_t calls = thorough_calls().value_or(kSanitized ? 4000 : 100000) /
                            (laws().size() * inverse_schemes().size());
  std::size_t made = 0;
  for_each_law([&](const Law& law) {
    Random random(17);
    for (const double lag_rate : {0.0, 100.0})
      for (const InverseScheme& scheme : inverse_schemes()) {
        CAPTURE(std::string(scheme.name));
        // What a network was trained on matters little here, and training takes time.
        const bool taught = scheme.name.starts_with("neural");
        if (taught && (&law != laws().front() || lag_rate > 0) && !thorough_calls()) continue;
        try {
          const auto inverse =
              scheme.make(driven(law, 100), {.current_min = 0.1, .lag_rate = lag_rate});
          CHECK(inverse->name() == scheme.name);
          CHECK(bad_commands(*inverse, calls / 2, random) == 0);
          made += calls / 2;
        } catch (const Error& error) {
          CHECK(scheme.name == "polynomial");  // the only one that may not apply
          CHECK(std::string(error.what()).find("no polynomial of the current") !=
                std::string::npos);
        }
      }
  });
  MESSAGE(made << " calls");
}

TEST_CASE("no inverse network gives a current that is NaN or beyond its limits, for every preset") {
  const std::size_t calls = thorough_calls().value_or(60000) / inverse_network_presets().size();
  Random random(18);
  for (const InverseNetworkPreset& preset : inverse_network_presets()) {
    CAPTURE(std::string(preset.name));
    InverseNetwork network = example_network(preset);
    for (const double rate_max : {0.0, 40.0}) {
      network.rate_max = rate_max;
      CHECK(bad_commands(HistoryNetwork(network, {.current_min = 0.1, .lag_rate = 100}), calls / 2,
                         random) == 0);
    }
  }
}

TEST_CASE("an inverse network follows an admissible force to 5 % of its span, for every preset" *
          doctest::test_suite("long")) {
  // Taught in a moment, on less than 'dashpot invert' takes: it comes to 1 to 2 %.
  const InverseTraining quick{.samples = 1500, .iterations = 40, .rounds = 2};
  const std::vector<std::string> all{"spencer1997", "mr1", "kwok2006"};
  for (const std::string& name : thorough_calls() ? all : std::vector{all.back()}) {
    const ParameterSet set = load_parameter_set(name);
    const DriverOptions driver =
        driver_of(set.model, {.current_min = set.drive_min, .current_max = set.drive_max});
    const InverseLimits limits = limits_of(driver, kSampleTime);
    std::vector<InverseRun> runs[2];
    for (const std::size_t part : {0, 1})
      for (const BenchTest& test : teaching_tests({}, limits, part + 1))
        runs[part].push_back(run_on_model(set.model, test, limits));
    for (const InverseNetworkPreset& preset : inverse_network_presets()) {
      InverseTraining training = quick;
      training.current_max = set.drive_max;
      const TaughtInverse taught = train_inverse(preset, runs[0], runs[1], training);
      for (const InverseTrial& trial : inverse_trials(set.model, {}, limits)) {
        const TrackReport report = track(set.model, HistoryNetwork(taught.network, limits),
                                         Driver(driver), trial.motion, trial.wanted);
        CAPTURE(std::string(preset.name));
        CAPTURE(trial.name);
        CHECK(report.reachable_share > 60);
        CHECK(report.reachable.rms_span < 5);
        MESSAGE(name << ", " << preset.name << ", " << trial.name << ": "
                     << report.reachable.rms_span << " % rms");
      }
    }
  }
}

TEST_CASE("every preset of an inverse network says what it is, in alphabetical order") {
  std::string_view before;
  for (const InverseNetworkPreset& preset : inverse_network_presets()) {
    CHECK(before < preset.name);
    before = preset.name;
    for (const std::string_view text :
         {preset.title, preset.equation, preset.source, preset.remarks})
      CHECK_FALSE(text.empty());
    require_usable(example_network(preset), std::string(preset.name));
    // The equation counts the inputs.
    CHECK(preset.equation.find(",  " + std::to_string(preset.taps.size()) + "-") !=
          std::string_view::npos);
  }
  CHECK(message_of([] {
          find_inverse_network("meterd", "--network");
        }).starts_with("--network: unknown inverse network 'meterd'; did you mean 'metered'?"));
}

TEST_CASE("every scheme says what it is, in alphabetical order") {
  std::string_view before;
  for (const InverseScheme& scheme : inverse_schemes()) {
    CHECK(before < scheme.name);
    before = scheme.name;
    for (const std::string_view text :
         {scheme.title, scheme.equation, scheme.source, scheme.remarks})
      CHECK_FALSE(text.empty());
  }
  CHECK(message_of([] {
          find_inverse("numerical", "--inverse");
        }).starts_with("--inverse: unknown inverse 'numerical'; did you mean 'numeric'?"));
}
