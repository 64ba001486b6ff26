#include "studies/family/family_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "dashpot/base/parallel.h"
#include "studies/family/training_store.h"

namespace dashpot {
namespace {

/// Share of the samples that a random division leaves out: 28 800 of the paper's 105 600.
constexpr double kLeftOutShare = 28800.0 / 105600.0;
constexpr std::uint64_t kDivisionSeed = 1;

/// One training, whatever experiments it serves.
struct Task {
  std::string key;
  FamilyRule rule;
  const FamilyDivision* division;
  std::uint64_t seed;
  StudiedNetwork* network;

  /// Cost of the training beside others: about parameters times epochs times samples.
  double work() const {
    double width = static_cast<double>(kFamilyInputs.size()), sum = 100;
    for (const std::size_t next : rule.hidden) {
      sum += (width + 1) * static_cast<double>(next);
      width = static_cast<double>(next);
    }
    return sum * rule.epochs * static_cast<double>(division->training.size());
  }
};

/// The trainings of all experiments, without repetition, and what came of them.
class StudyRun {
 public:
  StudyRun(FamilySamples family, const FamilyStudyOptions& options) : options_(options) {
    study_.family = std::move(family);
    study_.effort = options.effort;
  }

  FamilyStudy run(const std::vector<FamilyExperiment>& experiments) {
    for (const FamilyExperiment& experiment : experiments) add(experiment);
    train();
    parallel_for(study_.outcomes.size(), options_.threads, [&](std::size_t k) {
      options_.monitor.check();
      judge(study_.outcomes[k]);
    });
    for (const StudiedNetwork& network : study_.networks) study_.seconds += network.seconds;
    study_.kept = kept_;
    study_.models = judge_family_models(study_.family, options_);
    return std::move(study_);
  }

 private:
  const std::vector<FamilyDivision>& divisions(FamilyProtocol protocol) {
    std::vector<FamilyDivision>& known = divisions_[protocol];
    if (known.empty()) known = divisions_of(study_.family, protocol);
    return known;
  }

  void add(const FamilyExperiment& experiment) {
    if (study_.outcome(experiment.protocol, experiment.rule))
      return;  // another table asked for it first

    // The outcome keeps the rule as asked for; what is trained is the rule at the study's
    // effort.
    FamilyOutcome& outcome = study_.outcomes.emplace_back();
    outcome.experiment = experiment;
    FamilyRule rule = experiment.rule;
    rule.epochs = std::max(1, static_cast<int>(std::lround(options_.effort * rule.epochs)));

    // One training for each seed and division.
    for (std::uint64_t seed = 1; seed <= experiment.seeds; ++seed) {
      auto& networks = outcome.networks.emplace_back();
      for (const FamilyDivision& division : divisions(experiment.protocol))
        networks.push_back(
            &network_of({fmt::format("{}, {} {}, seed {}", describe(rule),
                                     static_cast<int>(experiment.protocol), division.name, seed),
                         rule, &division, seed, nullptr}));
    }
  }

  const StudiedNetwork& network_of(Task task) {
    task.network = &study_.networks.emplace_back();
    tasks_.push_back(std::move(task));
    return *tasks_.back().network;
  }

  /// The longest first, so that no thread is left with one at the end.
  void train() {
    std::ranges::stable_sort(tasks_,
                             [](const Task& a, const Task& b) { return a.work() > b.work(); });
    double all = 0;
    for (const Task& task : tasks_) all += task.work();
    std::atomic<double> done = 0;
    parallel_for(tasks_.size(), options_.threads, [&](std::size_t k) {
      Task& task = tasks_[k];
      options_.monitor.report(
          fmt::format("{}, seed {}", architecture_name(task.rule.hidden), task.seed), done / all);
      make(task);
      done += task.work();
    });
  }

  void make(Task& task) {
    const TrainingSamples samples = chosen(study_.family.samples, task.division->training);
    *task.network = untrained_network(task.rule, samples);
    if (options_.store && options_.store->load(task.key, *task.network)) {
      ++kept_;
      return;
    }
    *task.network = train_family_network(task.rule, samples, task.seed, options_.monitor);
    if (options_.store) options_.store->save(task.key, *task.network);
  }

  void judge(FamilyOutcome& outcome) {
    // The divisions that the networks were trained for, in the same order.
    const TrainingSamples& samples = study_.family.samples;
    const std::vector<FamilyDivision>& divided = divisions_.at(outcome.experiment.protocol);
    outcome.by_seed.resize(outcome.networks.size());
    for (std::size_t d = 0; d < divided.size(); ++d) {
      // Each seed by itself, and the mean of their forces.
      const std::vector<std::size_t>& judged = divided[d].judged;
      std::vector<double> mean(judged.size());
      outcome.by_division.emplace_back();
      for (std::size_t seed = 0; seed < outcome.networks.size(); ++seed) {
        const StudiedNetwork& network = *outcome.networks[seed][d];
        const std::vector<double> forces = forces_at(network.mlp, samples, judged);
        const ErrorSums sums = errors_at(samples, judged, forces);
        outcome.by_seed[seed].add(sums);
        outcome.by_division.back().push_back(sums);
        outcome.seconds += network.seconds;
        for (std::size_t k = 0; k < mean.size(); ++k)
          mean[k] += forces[k] / static_cast<double>(outcome.networks.size());
      }

      // The mean of the seeds counts as one model over all divisions.
      outcome.together.add(errors_at(samples, judged, mean));
    }
  }

  const FamilyStudyOptions& options_;
  FamilyStudy study_;
  std::map<FamilyProtocol, std::vector<FamilyDivision>> divisions_;
  std::vector<Task> tasks_;
  std::atomic<std::size_t> kept_ = 0;
};

template <class Figure>
Spread spread(const std::vector<ErrorSums>& seeds, Figure figure) {
  std::vector<double> all;
  for (const ErrorSums& sums : seeds) all.push_back(figure(metrics(sums)));
  std::ranges::sort(all);
  return {(all[(all.size() - 1) / 2] + all[all.size() / 2]) / 2, all.front(), all.back()};
}

/// The damper of the authors' file One_fixed_damper.json: the first of the data set, with its first
/// fluid.
FamilyDivision fixed_damper(const FamilySamples& family) { return single_dampers(family).front(); }

}  // namespace

std::vector<FamilyDivision> divisions_of(const FamilySamples& family, FamilyProtocol protocol) {
  switch (protocol) {
    case FamilyProtocol::FixedDamper:
      return {fixed_damper(family)};
    case FamilyProtocol::EachDamper:
      return single_dampers(family);
    case FamilyProtocol::RandomSamples:
      return {random_samples(family, kLeftOutShare, kDivisionSeed)};
    case FamilyProtocol::Geometries:
      return without_geometries(family);
    case FamilyProtocol::Fluids:
      return without_fluids(family);
    default:
      return {all_samples(family)};
  }
}

std::size_t FamilyOutcome::median_seed() const {
  std::vector<std::size_t> order(by_seed.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t seed) { return by_seed[seed].absolute; });
  return order[(order.size() - 1) / 2];
}

Spread mae_of(const std::vector<ErrorSums>& seeds) {
  return spread(seeds, [](const Metrics& m) { return m.mae; });
}

Spread r2_of(const std::vector<ErrorSums>& seeds) {
  return spread(seeds, [](const Metrics& m) { return m.r2; });
}

const FamilyOutcome* FamilyStudy::outcome(FamilyProtocol protocol, const FamilyRule& rule) const {
  const std::string wanted = describe(rule);
  const auto found = std::ranges::find_if(outcomes, [&](const FamilyOutcome& one) {
    return one.experiment.protocol == protocol && describe(one.experiment.rule) == wanted;
  });
  return found == outcomes.end() ? nullptr : &*found;
}

FamilyStudy study_family(FamilySamples family, const std::vector<FamilyExperiment>& experiments,
                         const FamilyStudyOptions& options) {
  return StudyRun(std::move(family), options).run(experiments);
}

}  // namespace dashpot
