#include "studies/one_sensor/one_sensor_study.h"

#include <algorithm>
#include <atomic>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_store.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Short sines of the paper's MR1 as it exists here: at 8 Hz its hysteresis is marked.
Record sine_record(double frequency, std::uint64_t seed) {
  const ParameterSet damper = load_parameter_set("mr1");
  BenchOptions bench;
  bench.sample_rate = 400;
  bench.velocity_sensor = true;
  bench.seed = seed;
  const BenchTest test = at_level(sine_test({0.02, frequency}, 1), 1, DriveUnit::Ampere);
  Record record =
      run_virtual_bench(damper.model, DriveUnit::Ampere, std::vector{test}, bench).records.front();
  record.name += ", seed " + std::to_string(seed);
  return record;
}

/// Two experiments, each recorded twice; the second is the example.
StudiedDamper small_damper() {
  StudiedDamper damper{
      .name = "small", .description = "", .is_virtual = true, .experiments = {}, .example = {1}};
  for (const double frequency : {2.0, 8.0})
    damper.experiments.push_back({"at " + std::to_string(frequency),
                                  {sine_record(frequency, 1), sine_record(frequency + 1, 2)},
                                  {sine_record(frequency + 0.5, 3)}});
  return damper;
}

OneSensorOptions quick(std::vector<std::string> keys) {
  OneSensorOptions options;
  options.keys = std::move(keys);
  options.most_neurons = 2;
  return options;
}

StudiedSize size_of(std::size_t neurons, double error) {
  return {.neurons = neurons, .parameters = 0, .error = error, .by_fold = {}};
}

}  // namespace

TEST_CASE("every experiment has what its models are asked for, the example more") {
  const OneSensorStudy study =
      study_one_sensor({small_damper()}, quick({kStatic, "regressors-1", "bingham"}));
  REQUIRE(study.models.size() == 3);
  for (const std::size_t experiment : {0, 1})
    for (const char* key : {kStatic, "bingham"}) CHECK(study.result(0, key, experiment));
  CHECK_FALSE(study.result(0, "regressors-1", 0));
  REQUIRE(study.result(0, "regressors-1", 1));
  CHECK(study.result(0, "regressors-1", 1)->parameters ==
        51);  // (2 + 1, 10, 1): a steady current has no past
  CHECK(study.result(0, kStatic, 1)->parameters == 41);  // TC-12c
  CHECK_FALSE(study.result(0, "two-sensors", 0));        // was not asked for
  CHECK(study.result(0, kStatic, 0)->forces.front().size() ==
        study.dampers[0].damper.experiments[0].left_out[0].size());
  REQUIRE(study.dampers[0].sizes.size() == 2);
  CHECK(study.dampers[0].sizes[1].by_fold.size() == 2);  // one experiment serves both ways round
  // Over all experiments the squares add up, N^2.
  const auto all = study.all(0, kStatic);
  REQUIRE(all);
  CHECK_CLOSE(all->sums.squared,
              study.result(0, kStatic, 0)->sums.squared + study.result(0, kStatic, 1)->sums.squared,
              1e-12, 0);
}

TEST_CASE("half the span is that of all forces a damper is judged on") {
  const StudiedDamper damper = small_damper();
  double low = 0, high = 0;
  for (const Fold& fold : damper.experiments) {
    const auto [least, greatest] =
        std::ranges::minmax(fold.left_out.front().channel("force").samples);
    low = std::min(low, least);
    high = std::max(high, greatest);
  }
  CHECK_CLOSE(damper.half_span(), (high - low) / 2, 1e-12, 0);
}

TEST_CASE(
    "with one sensor, a network that remembers beats one that does not where there is hysteresis" *
    doctest::test_suite("long")) {
  StudiedDamper damper = small_damper();
  damper.experiments.erase(damper.experiments.begin());
  damper.example = {};
  const OneSensorStudy study = study_one_sensor({damper}, quick({kStatic, kHysteresis}));
  CHECK(study.dampers[0].sizes.empty());  // no example, no size choice
  REQUIRE(study.result(0, kHysteresis, 0));
  CHECK(study.result(0, kHysteresis, 0)->metrics.esr <
        0.5 * study.result(0, kStatic, 0)->metrics.esr);
}

TEST_CASE("the same bits on any number of threads, and from kept fits; a study can be stopped" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  FitStore store(folder.path() / "fits.sqlite", "test");
  OneSensorOptions options = quick({kStatic, "bingham"});
  options.threads = 1;
  const OneSensorStudy one = study_one_sensor({small_damper()}, options);
  options.threads = 3;
  options.store = &store;
  const OneSensorStudy three = study_one_sensor({small_damper()}, options),
                       kept = study_one_sensor({small_damper()}, options);
  CHECK(three.kept_fits == 0);
  CHECK(kept.kept_fits == 8);  // 2 models x 2 experiments, 2 sizes x 2 folds
  for (const OneSensorStudy* study : {&three, &kept})
    for (const std::size_t e : {0, 1})
      CHECK(study->result(0, kStatic, e)->metrics.rmse == one.result(0, kStatic, e)->metrics.rmse);
  std::atomic<bool> stop = true;
  options.monitor.stop = &stop;
  CHECK_THROWS_AS(study_one_sensor({small_damper()}, options), Interrupted);
}

TEST_CASE("models that need a displacement are left out where there is none") {
  StudiedDamper damper = small_damper();
  for (Fold& fold : damper.experiments)
    for (auto* records : {&fold.training, &fold.left_out})
      for (Record& record : *records)
        std::erase_if(record.channels, [](const Channel& c) { return c.name == "displacement"; });
  const OneSensorStudy study = study_one_sensor({damper}, quick({kStatic, "two-sensors"}));
  CHECK(study.result(0, kStatic, 0));
  CHECK_FALSE(study.result(0, "two-sensors", 0));
}

TEST_CASE("minimal dimensions: the smallest network within 2 % of the least error") {
  CHECK(smallest_sufficient({size_of(1, 10), size_of(2, 5.11), size_of(3, 5.09), size_of(4, 5),
                             size_of(5, 6)}) == 3);
  CHECK(smallest_sufficient({size_of(1, 5)}) == 1);
  CHECK(smallest_sufficient({}) == 0);
}
