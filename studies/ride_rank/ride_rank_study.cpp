#include "studies/ride_rank/ride_rank_study.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/machine/ride_rank.h"
#include "dashpot/suspension/sweep/statistics.h"

namespace dashpot {
namespace {

constexpr double kCurrentMax = 2;  // A
constexpr std::size_t kFewestModels = 3;

/// What a dyno of a damper workshop does: sines from slow and long to quick and short at three
/// currents, and one sweep under switching current.
Dataset recorded(const DamperModel& truth, std::uint64_t seed) {
  BenchOptions bench{.motions = {{0.025, 0.5}, {0.02, 5}, {0.008, 3}, {0.003, 10}},
                     .drive_levels = {0, kCurrentMax / 2, kCurrentMax},
                     .cycles = 2,
                     .seed = seed};
  std::vector<BenchTest> tests;
  for (const BenchTest& sine : bench_sines(bench))
    for (const double level : bench.drive_levels)
      tests.push_back(at_level(sine, level, DriveUnit::Ampere));
  tests.push_back(under_sequence(
      sequence_test("FM,amplitude=10mm,speed_max=0.8,duration=10,modulation=0.1", seed), "PRBS",
      {.low = 0, .high = kCurrentMax, .duration = 10, .seed = seed}));
  return run_virtual_bench(truth, DriveUnit::Ampere, tests, bench);
}

/// Adds how well these figures tell the order of the true ones.
void add_order(OrderQuality& quality, const std::vector<double>& figures,
               const std::vector<double>& truth) {
  quality.correlation += rank_correlation(figures, truth).value_or(0);
  const auto first = std::ranges::min_element(figures) - figures.begin();
  quality.regret += truth[static_cast<std::size_t>(first)] / std::ranges::min(truth);
}

/// A model that can be ridden, and its errors.
struct Candidate {
  std::string name;
  double esr;  ///< %
  ModelFile file;
  ErrorModel errors;
};

std::vector<Candidate> candidates_of(const Dataset& dataset, const RideRankStudyOptions& options,
                                     FitStore* store) {
  IdentifyOptions identification;
  identification.starts = 2;
  identification.seed = options.seed;
  identification.threads = options.threads;
  identification.monitor = options.monitor;
  const Ranking ranking =
      rank(options.models, dataset, {.by = LeaveOut::By::Condition}, identification, store);
  std::vector<Candidate> candidates;
  for (const RankedModel& ranked : ranking.models)
    if (is_recommendable(ranked))
      candidates.push_back({ranked.name, ranked.left_out.pooled.esr,
                            to_model_file(ranked, dataset, ""),
                            ErrorModel(ranked.left_out.records)});
  return candidates;
}

/// Each model beside the dampers that the recordings allow, and beside the truth.
std::vector<PredictedAndTrue> ridden(const std::vector<Candidate>& candidates,
                                     const std::shared_ptr<const DamperModel>& truth,
                                     const RideRankOptions& riding, int threads) {
  const Candidate& known = *std::ranges::min_element(
      candidates, {}, [](const Candidate& one) { return one.errors.unexplained(); });
  const std::vector<OtherDamper> dampers = possible_dampers(known.file, known.errors, riding);
  const GroundPointer ground = make_ground(riding.road, riding.seed, "--roads");
  std::vector<PredictedAndTrue> rows(candidates.size());
  parallel_for(candidates.size(), threads, [&](std::size_t k) {
    const Candidate& one = candidates[k];
    const RiddenModel model(one.file, *ground, riding);
    const PredictedRide predicted = model.predicted(dampers);
    const std::optional<RideDifference> real = model.against({truth});
    if (predicted.refusal.empty() && real)
      rows[k] = {one.name, one.esr, predicted.error, real->share};
  });
  std::erase_if(rows, [](const PredictedAndTrue& row) { return row.model.empty(); });
  return rows;
}

}  // namespace

RideRankQuality quality_of(std::span<const RideRankCase> cases) {
  RideRankQuality quality;
  double inside = 0, all = 0;
  for (const RideRankCase& one : cases) {
    if (one.models.size() < kFewestModels) continue;
    ++quality.cases;

    std::vector<double> predicted, esr, truth;
    for (const PredictedAndTrue& m : one.models) {
      predicted.push_back(m.predicted.value);
      esr.push_back(m.esr);
      truth.push_back(m.truth);
      inside += m.predicted.low <= m.truth && m.truth <= m.predicted.high;
      ++all;
    }
    add_order(quality.predicted, predicted, truth);
    add_order(quality.esr, esr, truth);
  }

  if (quality.cases == 0) return quality;
  const auto n = static_cast<double>(quality.cases);
  for (OrderQuality* order : {&quality.predicted, &quality.esr})
    order->correlation /= n, order->regret /= n;
  quality.covered = inside / all;
  return quality;
}

std::vector<RideRankCase> study_ride_rank(const RideRankStudyOptions& options, FitStore* store) {
  // Every name is looked up before the first fit.
  if (options.models.size() < kFewestModels)
    throw Error("--models", "names " + counted(options.models.size(), "model"),
                "three at least, or there is no order to tell");
  std::vector<std::string> names;
  for (const TrueDamperParts& parts : true_dampers()) names.emplace_back(parts.name);
  const std::vector<std::string>& asked = options.truths.empty() ? names : options.truths;
  for (const std::string& name : asked)
    if (std::ranges::find(names, name) == names.end())
      throw Error("--truths", "unknown true damper '" + name + "'", suggest(name, names));
  std::vector<RideRankOptions> rides;
  for (const std::string& road : options.roads)
    for (const std::string& controller : options.controllers) {
      rides.push_back({.vehicle = {.plant = options.plant,
                                   .controller = controller == "none" ? "" : controller,
                                   .current = kCurrentMax / 2},
                       .road = road,
                       .duration = options.duration,
                       .draws = options.draws,
                       .seed = options.seed,
                       .monitor = options.monitor});
      require_ridable(rides.back());
    }

  // The bench and the ranking as a user has them, then the rides that only the study can make.
  std::vector<RideRankCase> cases;
  for (const std::string& name : asked) {
    const std::shared_ptr<const DamperModel> truth =
        make_true_damper(*std::ranges::find(true_dampers(), name, &TrueDamperParts::name));
    const Dataset dataset = recorded(*truth, options.seed);
    const std::vector<Candidate> candidates = candidates_of(dataset, options, store);
    for (const RideRankOptions& ride : rides) {
      if (candidates.empty()) break;
      options.monitor.report("riding beside " + name + ", " + ride.road, 1);
      cases.push_back({name, ride.road,
                       ride.vehicle.controller.empty() ? "none" : ride.vehicle.controller,
                       ridden(candidates, truth, ride, options.threads)});
    }
  }
  return cases;
}

}  // namespace dashpot
