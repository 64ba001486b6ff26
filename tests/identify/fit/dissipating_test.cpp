#include <array>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/probe_sine.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr std::array kEnsembles{"hysteresis_network", "neural_state_space"};

const std::vector<Record>& records_of_a_bench() {
  static const std::vector<Record> records = [] {
    BenchOptions options;
    options.motions = {{0.01, 1}, {0.005, 3}};
    options.drive_levels = {0, 1};
    options.sample_rate = 100;
    options.cycles = 1;
    return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options).records;
  }();
  return records;
}

/// Small and brief, which leaves them active.
FitReport brief_fit(const std::string& model, bool allow_active) {
  IdentifyOptions options{.allow_active = allow_active};
  if (model == "hysteresis_network")
    options.network = {.hidden = {10}, .epochs = 30, .l2 = 1e-4, .members = 2};
  else
    options.network = {.hidden = {3}, .epochs = 30, .l2 = 2e-7, .members = 1};
  FitReport fit = identify(model, records_of_a_bench(), DriveUnit::Ampere, options);
  REQUIRE(fit.model);
  return fit;
}

Dissipation verdict_of_brief(const FitReport& fit) {
  return dissipation(*fit.model, domain_of(records_of_a_bench(), DriveUnit::Ampere));
}

/// The least share that a model takes out of sines between those that its training paid for.
double share_between(const DamperModel& model) {
  double least = 1;
  for (const double frequency : {2.0, 5.0, 11.0, 33.0, 65.0, 120.0, 170.0})
    for (const double amplitude : {5e-7, 5e-6, 3e-5, 2e-4})
      for (const double drive : {0.1, 0.6, 0.9}) {
        const ProbeSine sine{frequency, amplitude, 0, drive};
        const std::vector<DamperInput> cycle = cycle_of(sine);
        std::vector<double> state(model.state_size()), force(cycle.size());
        model.rest(cycle.front(), state);
        for (int n = 0; n < 4; ++n)
          model.run(cycle, {.step = step_of(sine)}, state, {force.data()});
        least = std::min(least, measured(cycle, force, step_of(sine)).share());
      }
  return least;
}

}  // namespace

TEST_CASE("an ensemble that would feed energy in is trained on until it does not, and says so" *
          doctest::test_suite("long")) {
  for (const std::string name : kEnsembles) {
    CAPTURE(name);
    const FitReport active = brief_fit(name, true);
    CHECK_FALSE(verdict_of_brief(active).dissipates());
    CHECK(active.warnings.empty());

    const FitReport paid = brief_fit(name, false);
    CHECK(verdict_of_brief(paid).dissipates());
    // States that act back on themselves leave more between the sines than those that do not.
    CHECK(share_between(*paid.model) > (name == "hysteresis_network" ? -0.02 : -0.05));
    CHECK(paid.training_rmse < 2 * active.training_rmse);
    REQUIRE(paid.warnings.size() == 1);
    CHECK(contains(paid.warnings[0], "it is trained on to dissipate"));
    CHECK(contains(paid.warnings[0], "--allow-active keeps that fit"));
  }
}

TEST_CASE("an ensemble that dissipates as it fits best keeps its digits") {
  const auto digits = [](bool allow_active) {
    IdentifyOptions options{.allow_active = allow_active};
    options.network = {.hidden = {4}, .epochs = 12, .l2 = 1e-4, .members = 2};
    const FitReport fit =
        identify("hysteresis_network", records_of_a_bench(), DriveUnit::Ampere, options);
    CHECK(verdict_of_brief(fit).dissipates());
    CHECK(fit.warnings.empty());
    return format_json(fit.model->to_json());
  };
  CHECK(digits(true) == digits(false));
}
