#include "dashpot/identify/fit/fit_inverse.h"

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Short records of a damper at these levels, without noise.
Dataset records_at(const LawModel& damper, std::vector<double> levels) {
  BenchOptions bench{.motions = {{0.015, 1}, {0.008, 2}, {0.004, 3}},
                     .drive_levels = std::move(levels)};
  bench.cycles = 2;
  bench.sample_rate = 200;
  bench.force_noise = bench.force_offset = 0;
  return run_virtual_bench(damper, damper.drive_unit(), bench);
}

InverseFitOptions options_for(const std::string& network) {
  return {.network = network, .training = {.samples = 800, .iterations = 60, .threads = 1}};
}

double tracking_error(const ParameterSet& set, const InverseNetwork& network,
                      const MotionRange& range) {
  const DriverOptions driver =
      driver_of(set.model, {.current_min = set.drive_min, .current_max = set.drive_max});
  const InverseLimits limits = limits_of(driver, 1e-3);
  const InverseTrial trial = inverse_trials(set.model, range, limits).front();
  return track(set.model, HistoryNetwork(network, limits), Driver(driver), trial.motion,
               trial.wanted)
      .reachable.rms_span;
}

}  // namespace

TEST_CASE("fit inverse: records at several currents teach it, without a model" *
          doctest::test_suite("long")) {
  const ParameterSet set = load_parameter_set("kwok2006");
  const Dataset data = records_at(set.model, {0, 0.4, 0.8, 1.2, 1.5});
  const LeaveOut leave_out = default_leave_out(data);
  const InverseFit fit = fit_inverse(data, leave_out, nullptr, options_for("history"));
  CHECK(fit.records.size() == 15);
  CHECK(fit.network.current_max == 1.5);
  CHECK(fit.left_out_rmse < 0.3);
  CHECK(fit.warnings.size() == 1);
  CHECK(tracking_error(set, fit.network, {0.012, 1.2}) < 8);

  const InverseFit again = fit_inverse(data, leave_out, nullptr, options_for("history"));
  CHECK(again.network.mlp.parameters == fit.network.mlp.parameters);
  CHECK(again.left_out_rmse == fit.left_out_rmse);

  // A model that knows the truth takes away a record's zero.
  Dataset shifted = data;
  for (double& force : shifted.records[3].channels[2].samples) force += 200;
  REQUIRE(shifted.records[3].channels[2].name == "force");
  const InverseFit weighed = fit_inverse(shifted, leave_out, &set.model, options_for("history"));
  CHECK(tracking_error(set, weighed.network, {0.012, 1.2}) < 8);
}

TEST_CASE("fit inverse: records that cannot serve are told apart") {
  const ParameterSet set = load_parameter_set("kwok2006");
  const auto message = [&](const Dataset& data, const std::string& network) {
    return message_of(
        [&] { fit_inverse(data, default_leave_out(data), nullptr, options_for(network)); });
  };
  CHECK(
      message(records_at(set.model, {0.5}), "history")
          .find(
              "the drive is 0.5 A throughout: nothing tells what another would do; take records at "
              "several") != std::string::npos);
  CHECK(
      message(records_at(set.model, {0, 1}), "chang_zhou")
          .find("chang_zhou would only learn to hold on to its own past current; take 'history'") !=
      std::string::npos);
  Dataset blind = records_at(set.model, {0, 1});
  std::erase_if(blind.records[1].channels,
                [](const Channel& c) { return c.name == "displacement"; });
  CHECK(message(blind, "history").find("has no displacement, which history needs") !=
        std::string::npos);
}

TEST_CASE("fit inverse: records whose current varies teach feedback, too" *
          doctest::test_suite("long")) {
  const ParameterSet set = load_parameter_set("kwok2006");
  std::vector<BenchTest> tests;
  for (const BenchTest& test : teaching_tests({0.015, 2}, {.current_max = set.drive_max}, 4))
    tests.push_back(test);
  BenchOptions bench;
  bench.sample_rate = 200;
  bench.force_noise = bench.force_offset = bench.displacement_noise = 0;
  bench.velocity_sensor = true;
  const Dataset data = run_virtual_bench(set.model, DriveUnit::Ampere, tests, bench);
  const InverseFit fit = fit_inverse(data, {.by = LeaveOut::By::Fraction, .fraction = 0.3}, nullptr,
                                     options_for("chang_zhou"));
  CHECK(fit.warnings.empty());
  CHECK(tracking_error(set, fit.network, {0.015, 2}) < 4);
}

TEST_CASE("fit inverse: the range of a model's domain, and trials within it") {
  const MotionRange range = motion_range({-0.02, 0.01, -0.3, 0.25, 0, 1});
  CHECK(range.amplitude == 0.02);
  CHECK_CLOSE(range.speed(), 0.3, 1e-12, 0);
  const ParameterSet set = load_parameter_set("kwok2006");
  for (const InverseTrial& trial : inverse_trials(set.model, range, {.current_max = 1.5})) {
    CAPTURE(trial.name);
    CHECK(trial.wanted.size() == trial.motion.size());
    CHECK(std::ranges::max(trial.motion.velocity) < 1.4 * range.speed());
  }
}
