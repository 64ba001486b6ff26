#include "dashpot/damper/inverse/train_inverse.h"

#include <algorithm>
#include <cmath>

#include "damper/inverse/inverses.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

/// F = 500 v + (100 + 900 i) tanh(v / 5 mm/s): an effect of the current that is known everywhere.
constexpr double kKnee = 200;
double sensitivity(double v) { return 900 * std::tanh(kKnee * v); }

InverseRun closed_form_run(double frequency, double phase) {
  InverseRun run{.name = "closed form", .inputs = {}, .force = {}, .weight = {}};
  for (int k = 0; k < 4000; ++k) {
    const double t = k * run.sample_time, w = 2 * M_PI * frequency;
    const double v = 0.1 * std::cos(w * t), i = 0.5 + 0.5 * std::sin(7 * t + phase);
    run.inputs.push_back({0.1 / w * std::sin(w * t), v, i});
    run.force.push_back(500 * v + (100 + 900 * i) * std::tanh(kKnee * v));
    run.weight.push_back(sensitivity(v) * sensitivity(v));
  }
  return run;
}

}  // namespace

TEST_CASE("run on a model: the weight is the squared effect of the current, in closed form") {
  const LawModel model = driven(find_law("bingham"), 0);
  // 'driven' lets its c0 and its friction fc go from a quarter to the whole of their values: c0 |v|
  // + fc.
  const auto value = [](std::string_view name) {
    return std::ranges::find(find_law("bingham").params, name, &ParamInfo::name)->value;
  };
  const double effect = 0.75 * (value("c0") * 0.1 + value("f_c"));
  const std::vector<DamperInput> inputs{
      {0, 0.1, 0}, {1e-4, 0.1, 0.5}, {2e-4, -0.1, 1}, {1e-4, 0, 0.5}};
  const InverseRun run = run_on_model(model, "hand", inputs, {});
  REQUIRE(run.size() == 4);
  for (std::size_t k = 0; k < 3; ++k) CHECK_CLOSE(run.weight[k], effect * effect, 1e-9, 0);
  CHECK(run.weight[3] == 0);  // at rest the current makes no difference
}

TEST_CASE("teaching tests: within the range, every current, the same for the same seed") {
  const MotionRange range{0.01, 2};
  const InverseLimits limits{.current_min = 0.2, .current_max = 1.5};
  const std::vector<BenchTest> tests = teaching_tests(range, limits, 3),
                               again = teaching_tests(range, limits, 3);
  CHECK(tests.size() == 4);
  for (std::size_t n = 0; n < tests.size(); ++n) {
    CAPTURE(tests[n].name);
    double least = INFINITY, most = -INFINITY, largest = 0, fastest = 0;
    for (double t = 0; t < tests[n].motion.duration; t += 0.01) {
      const auto [x, v] = tests[n].motion.at(t);
      const double i = tests[n].drive.at(t);
      CHECK(x == again[n].motion.at(t).displacement);
      CHECK(i == again[n].drive.at(t));
      least = std::min(least, i), most = std::max(most, i);
      largest = std::max(largest, std::abs(x)), fastest = std::max(fastest, std::abs(v));
    }
    CHECK(least >= limits.current_min);
    CHECK(most <= limits.current_max);
    CHECK(most - least > 0.8 * (limits.current_max - limits.current_min));
    // Noise has no sharp ends: some of it goes beyond twice its deviation.
    CHECK(largest < 1.8 * range.amplitude);
    CHECK(fastest < 1.6 * range.speed());
  }
}

TEST_CASE("train: a static network finds the inverse in closed form where the current matters") {
  const std::vector<InverseRun> runs{closed_form_run(1, 0)}, others{closed_form_run(1, 1)};
  const InverseTraining options{.samples = 1500, .iterations = 100};
  const TaughtInverse taught = train_inverse(find_inverse_network("static"), runs, others, options);
  CHECK(taught.left_out_rmse < 0.05);  // A, of a range of 1 A: 14 neurons round off where v turns
  const std::vector<std::vector<double>> currents{answers(taught.network, others.front())};
  CHECK(weighted_error(others, currents) == taught.left_out_rmse);
  const TaughtInverse again = train_inverse(find_inverse_network("static"), runs, others, options);
  CHECK(again.network.mlp.parameters == taught.network.mlp.parameters);
  InverseTraining threads = options;
  threads.threads = 2;
  CHECK(
      train_inverse(find_inverse_network("static"), runs, others, threads).network.mlp.parameters ==
      taught.network.mlp.parameters);
}

TEST_CASE("train: a network with feedback that saw true currents only is worse in free run" *
          doctest::test_suite("long")) {
  const LawModel model = driven(find_law("bouc_wen"), 0);
  std::vector<InverseRun> runs[2];
  for (const std::size_t part : {0, 1})
    runs[part].push_back(run_on_model(model, teaching_tests({}, {}, part + 1).front(), {}));
  InverseTraining options{.samples = 1000, .iterations = 30};
  const auto error = [&] {
    return train_inverse(find_inverse_network("metered"), runs[0], runs[1], options).left_out_rmse;
  };
  const double with_own = error();
  options.rounds = 0;
  CHECK(with_own < error());
}

TEST_CASE("train: runs that cannot teach are refused") {
  std::vector<InverseRun> runs{closed_form_run(1, 0)};
  const auto message = [&] {
    return message_of([&] { train_inverse(find_inverse_network("one_sensor"), runs, runs, {}); });
  };
  runs.front().sample_time = 8e-3;
  CHECK(message().find("looks back in steps of 5 ms") != std::string::npos);
  runs.front().sample_time = 1e-3;
  std::ranges::fill(runs.front().weight, 0.0);
  CHECK(message().find("makes no difference to the force anywhere") != std::string::npos);
}
