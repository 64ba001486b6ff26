#include "studies/family/family_study.h"

#include <algorithm>
#include <atomic>
#include <set>

#include "dashpot/error.h"
#include "identify/family_example.h"
#include "studies/family/training_store.h"
#include "support.h"

using namespace dashpot;

namespace {

FamilyRule quick_rule(std::vector<std::size_t> hidden) {
  FamilyRule rule = own_rule(std::move(hidden));
  rule.epochs = 20;
  return rule;
}

/// The values of one input over some samples.
std::set<double> values(const FamilySamples& family, const std::vector<std::size_t>& samples,
                        std::size_t input) {
  std::set<double> found;
  for (const std::size_t s : samples)
    found.insert(family.samples.inputs[s * kFamilyInputs.size() + input]);
  return found;
}

}  // namespace

TEST_CASE("samples: one cycle of each record, the paper's eight inputs in their order") {
  const FamilySamples family = family_samples(small_family());
  CHECK(family.cycles.size() == 16);
  CHECK(family.size() == 16 * 24);
  const double* row = &family.samples.inputs[family.first[1] * kFamilyInputs.size()];
  // Second record: A_p, A_g, h, L, viscosity, T_y, then v (just behind its rise) and x (its
  // lowest).
  for (const auto& [k, value] :
       {std::pair(0, 1.6e-4), {1, 2.5e-5}, {2, 0.001}, {3, 0.006}, {4, 0.28}, {5, 4e4}})
    CHECK(row[k] == value);
  CHECK_CLOSE(row[6], 0.03 * std::sin(2 * 3.14159265358979 * 0.5 / 24), 1e-9, 0);
  CHECK_CLOSE(row[7], -0.01 * std::cos(2 * 3.14159265358979 * 0.5 / 24), 1e-9, 0);
  Dataset other = small_family();
  other.records[3].conditions.pop_back();
  CHECK(message_of([&] { family_samples(other); }).find("has no condition 'yield_stress'") !=
        std::string::npos);
}

TEST_CASE(
    "a geometry that is left out is not learnt from with any fluid, nor a fluid with any "
    "geometry") {
  const FamilySamples family = family_samples(small_family());
  const std::vector<FamilyDivision> geometries = divisions_of(family, FamilyProtocol::Geometries),
                                    fluids = divisions_of(family, FamilyProtocol::Fluids);
  REQUIRE(geometries.size() == 4);
  REQUIRE(fluids.size() == 2);
  for (const FamilyDivision& division : geometries) {
    CHECK(division.judged.size() == 4 * 24);
    CHECK(division.training.size() == 12 * 24);
    CHECK(values(family, division.judged, 4).size() == 2);  // both fluids
    const double gap = *values(family, division.judged, 2).begin(),
                 length = *values(family, division.judged, 3).begin();
    for (const std::size_t s : division.training) {
      const double* row = &family.samples.inputs[s * kFamilyInputs.size()];
      CHECK((row[2] != gap || row[3] != length));
    }
  }
  for (const FamilyDivision& division : fluids) {
    CHECK(values(family, division.judged, 4).size() == 1);
    CHECK(values(family, division.training, 4) != values(family, division.judged, 4));
  }
  CHECK(divisions_of(family, FamilyProtocol::EachDamper).size() == 8);
  const FamilyDivision random = divisions_of(family, FamilyProtocol::RandomSamples).front();
  CHECK(random.training.size() + random.judged.size() == family.size());
  Dataset one = small_family();
  one.records.resize(4);
  CHECK_THROWS_AS(divisions_of(family_samples(one), FamilyProtocol::Fluids), Error);
}

TEST_CASE(
    "models of the registry stand beside the networks: the same samples, with each group left "
    "out") {
  const FamilySamples family = family_samples(small_family());
  CHECK(family.runs[3].size() - family.runs[3].warm_up == family.cycles[3].size());
  CHECK(family.runs[3].time[family.runs[3].warm_up] == family.cycles[3].time.front());
  FamilyStudyOptions options;
  options.models = {"family_gated"};
  const FamilyStudy study = study_family(family, {}, options);
  REQUIRE(study.models.size() == 1);
  const FamilyModelOutcome& gated = study.models.front();
  for (const ErrorSums* sums : {&gated.learnt, &gated.geometries, &gated.fluids})
    CHECK(metrics(*sums).samples == family.size());
  CHECK(metrics(gated.learnt).r2 > 0.98);
  CHECK(metrics(gated.geometries).r2 < metrics(gated.learnt).r2);
  Dataset no_current = small_family();
  for (Record& record : no_current.records) record.channels.pop_back();
  CHECK(judge_family_models(family_samples(no_current), options).empty());
}

TEST_CASE("the same bits on any number of threads and from kept trainings; it can be stopped") {
  const TemporaryFolder folder;
  const FamilySamples family = family_samples(small_family());
  const std::filesystem::path file = folder.path() / "trainings.sqlite";
  std::optional<TrainingStore> store(std::in_place, file, "test", family.cycles);
  const std::vector<FamilyExperiment> experiments{
      {FamilyProtocol::Geometries, quick_rule({5, 5}), 2},
      {FamilyProtocol::AllSamples, quick_rule({4}), 3},
      {FamilyProtocol::AllSamples, quick_rule({4}), 3}};
  FamilyStudyOptions options;
  options.threads = 1;
  const FamilyStudy one = study_family(family, experiments, options);
  CHECK(one.networks.size() == 2 * 4 + 3);  // what two experiments share is trained once
  options.threads = 3;
  options.store = &*store;
  const FamilyStudy three = study_family(family, experiments, options),
                    kept = study_family(family, experiments, options);
  CHECK(three.kept == 0);
  CHECK(kept.kept == 11);
  store.emplace(file, "other", family.cycles);
  CHECK(study_family(family, {experiments[1]}, options).kept == 0);
  for (const FamilyExperiment& e : experiments)
    for (const FamilyStudy* study : {&three, &kept})
      for (std::size_t seed = 0; seed < e.seeds; ++seed)
        CHECK(study->outcome(e.protocol, e.rule)->by_seed[seed].absolute ==
              one.outcome(e.protocol, e.rule)->by_seed[seed].absolute);
  CHECK(one.outcome(FamilyProtocol::Fluids, quick_rule({4})) == nullptr);
  const StudiedNetwork &made = three.networks.front(), &found = kept.networks.front();
  CHECK(made.history == found.history);
  std::atomic<bool> stop = true;
  options.monitor.stop = &stop;
  CHECK_THROWS_AS(study_family(family, experiments, options), Interrupted);
}

TEST_CASE("medians over seeds, and the mean of their forces") {
  const FamilySamples family = family_samples(small_family());
  const FamilyRule rule = quick_rule({6});
  const FamilyStudy study = study_family(family, {{FamilyProtocol::AllSamples, rule, 3}}, {});
  const FamilyOutcome& outcome = *study.outcome(FamilyProtocol::AllSamples, rule);
  std::vector<double> mae;
  for (const ErrorSums& sums : outcome.by_seed)
    mae.push_back(sums.absolute / static_cast<double>(sums.n));
  CHECK(mae[outcome.median_seed()] == mae_of(outcome.by_seed).median);
  CHECK(mae_of(outcome.by_seed).high == *std::ranges::max_element(mae));
  // Squares are convex: the mean force errs no more than the networks do on average.
  double squares = 0;
  for (const ErrorSums& sums : outcome.by_seed) squares += sums.squared / 3;
  CHECK(outcome.together.squared <= squares);
}

TEST_CASE("raw inputs stand in the authors' units: kPa and mm") {
  const FamilySamples family = family_samples(small_family());
  const StudiedNetwork raw = untrained_network(authors_rule({3}), family.samples);
  CHECK(raw.mlp.input_scale == std::vector<double>{1, 1, 1, 1, 1, 1000, 1, 0.001});
  CHECK(raw.mlp.output_scale == 1);
  CHECK(describe(authors_rule({30, 30, 30})) ==
        "h3x30, raw inputs, rate 0.01 constant, batch 100, 500 epochs, L2 0");
  CHECK(architecture_name({15, 10}) == "15-10");
}

TEST_CASE(
    "h3x15 on the published samples: better than the paper's chart in a third of the training" *
    doctest::test_suite("long")) {
  const std::filesystem::path folder = shared_data("family-dnn");
  if (folder.empty()) return;
  const FamilySamples family = family_samples(load_dataset({folder}));
  FamilyRule rule = own_rule(chosen_architecture());
  rule.epochs /= 3;
  const FamilyDivision all = all_samples(family);
  const StudiedNetwork network = train_family_network(rule, family.samples, 1, {});
  const Metrics m = metrics(
      errors_at(family.samples, all.judged, forces_at(network.mlp, family.samples, all.judged)));
  CHECK(m.mae <= 0.45);  // the acceptance; the paper's chart: 0.5115
  CHECK(m.r2 >= 0.996);
}
