#include "studies/one_sensor/one_sensor_study.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <deque>
#include <functional>
#include <mutex>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/registry.h"
#include "dashpot/identify.h"
#include "dashpot/identify/rank/fit_store.h"
#include "studies/one_sensor/one_sensor_fit.h"

namespace dashpot {
namespace {

/// The cost of a fit beside others, measured on the paper's experiments: the longest go first.
double expected_cost(const StudiedModel& model) {
  const ModelKind kind = model_info(model.model).kind;
  if (kind == ModelKind::HysteresisNetwork) return 40;
  if (kind == ModelKind::Narx) return model.design.feedback == 0 ? 8 : 30;
  if (kind == ModelKind::Network)
    return 1 + 0.2 * static_cast<double>(model.design.hidden.empty() ? 10 : model.design.hidden[0]);
  return find_law(model.model).states.empty() ? 1 : 10;
}

/// One fit, and where it is judged.
struct Task {
  StudiedModel model;
  const StudiedDamper* damper;
  const Fold* fold;
  std::optional<StudiedResult>* result;
  bool keeps_forces;
};

class StudyRun {
 public:
  StudyRun(std::vector<StudiedDamper> dampers, const OneSensorOptions& options)
      : options_(options) {
    for (StudiedModel& model : one_sensor_models())
      if (options.keys.empty() || std::ranges::count(options.keys, model.key) > 0)
        study_.models.push_back(std::move(model));
    for (StudiedDamper& damper : dampers)
      study_.dampers.push_back({.damper = std::move(damper), .results = {}, .sizes = {}});
    for (DamperStudy& one : study_.dampers) {
      add_tasks(one);
      add_sizes(one);
    }
  }

  OneSensorStudy run() {
    // The most expensive first, so that no thread is left with a long one at the end.
    std::vector<Task*> ordered;
    double total = 0, done = 0;
    for (Task& task : tasks_) ordered.push_back(&task), total += expected_cost(task.model);
    std::ranges::stable_sort(ordered, std::greater{},
                             [](const Task* task) { return expected_cost(task->model); });

    // Fits and judges; forces are kept only where figures show them.
    std::mutex guard;
    parallel_for(ordered.size(), options_.threads, [&](std::size_t k) {
      Task& task = *ordered[k];
      const std::string stage =
          task.damper->name + ", " + task.fold->name + ": " + task.model.title;
      options_.monitor.check();
      const FitReport report = fit(task);
      if (report.model) {
        *task.result = judge(report, *task.fold, task.damper->drive_unit);
        if (!task.keeps_forces) (*task.result)->forces.clear();
      }

      // Time and progress are shared by all threads.
      const std::lock_guard lock(guard);
      done += expected_cost(task.model);
      study_.seconds += report.seconds;
      options_.monitor.report(stage, done / total);
    });

    // The fits by size are gathered once all of them are done.
    for (std::size_t d = 0; d < study_.dampers.size(); ++d)
      gather_sizes(study_.dampers[d], size_results_[d]);
    study_.kept_fits = kept_;
    return std::move(study_);
  }

 private:
  void add_tasks(DamperStudy& one) {
    one.results.resize(study_.models.size());
    for (std::size_t m = 0; m < study_.models.size(); ++m) {
      const StudiedModel& model = study_.models[m];
      one.results[m].resize(one.damper.experiments.size());
      if (model_info(model.model).needs_displacement() && !one.damper.has_displacement()) continue;
      for (std::size_t e = 0; e < one.damper.experiments.size(); ++e) {
        if (model.example_only && std::ranges::count(one.damper.example, e) == 0) continue;
        tasks_.push_back({model, &one.damper, &one.damper.experiments[e], &one.results[m][e],
                          model.key == kStatic || model.key == kHysteresis});
      }
    }
  }

  /// An example of one division serves both ways round: learn from either record, judge on the
  /// other.
  void add_sizes(DamperStudy& one) {
    std::vector<Fold>& folds = size_folds_.emplace_back();
    for (const std::size_t e : one.damper.example) folds.push_back(one.damper.experiments[e]);
    if (folds.size() == 1) {
      folds.push_back({folds[0].name + ", turned round", folds[0].left_out, folds[0].training});
    }
    SizeResults& results = size_results_.emplace_back(folds.empty() ? 0 : options_.most_neurons);
    for (std::size_t n = 0; n < results.size(); ++n) {
      results[n].resize(folds.size());
      StudiedModel model{"size", std::to_string(n + 1) + " neurons", "mlp_one_sensor", {}, true};
      model.design.hidden = {n + 1};
      for (std::size_t f = 0; f < folds.size(); ++f)
        tasks_.push_back({model, &one.damper, &folds[f], &results[n][f], false});
    }
  }

  using SizeResults = std::vector<std::vector<std::optional<StudiedResult>>>;

  static void gather_sizes(DamperStudy& one, const SizeResults& results) {
    for (std::size_t n = 0; n < results.size(); ++n) {
      StudiedSize size{.neurons = n + 1, .parameters = 0, .error = 0, .by_fold = {}};
      ErrorSums sums;
      for (const std::optional<StudiedResult>& result : results[n]) {
        if (!result) continue;
        sums.add(result->sums);
        size.by_fold.push_back(result->metrics.rmse);
        size.parameters = result->parameters;
      }
      size.error = metrics(sums).rmse;
      one.sizes.push_back(std::move(size));
    }
  }

  /// The fit as it was kept in the store, or made now and kept.
  FitReport fit(const Task& task) {
    // The fit as the study asks for it.
    IdentifyOptions options;
    options.seed = options_.seed;
    options.threads = 1;
    options.monitor.stop = options_.monitor.stop;
    const StudiedFit work = studied_fit(task.model, task.fold->training, options);

    // Taken from the store where it was made before.
    const FitStore::Request request{task.model.model, work.training, task.damper->drive_unit,
                                    work.options};
    if (options_.store)
      if (std::optional<FitReport> kept = options_.store->load(request)) {
        ++kept_;
        return std::move(*kept);
      }

    // Made now, and kept.
    FitReport report =
        identify(task.model.model, work.training, task.damper->drive_unit, work.options);
    if (options_.store) options_.store->save(request, report);
    return report;
  }

  const OneSensorOptions& options_;
  OneSensorStudy study_;
  std::vector<Task> tasks_;
  std::deque<std::vector<Fold>> size_folds_;
  std::deque<SizeResults> size_results_;
  std::atomic<std::size_t> kept_ = 0;
};

std::optional<StudiedResult> pooled(const OneSensorStudy& study, std::size_t damper,
                                    const std::string& key,
                                    const std::vector<std::size_t>& experiments) {
  // Sums over the experiments; one that is missing leaves nothing to pool.
  StudiedResult sum;
  for (const std::size_t e : experiments) {
    const StudiedResult* one = study.result(damper, key, e);
    if (!one) return std::nullopt;
    sum.sums.add(one->sums);
    if (one->one_step) {
      if (!sum.one_step) sum.one_step.emplace();
      sum.one_step->add(*one->one_step);
    }
    if (!sum.diverged_at) sum.diverged_at = one->diverged_at;
    sum.parameters = std::max(sum.parameters, one->parameters);
    sum.seconds += one->seconds;
  }

  // Metrics from the sums of all experiments.
  if (experiments.empty()) return std::nullopt;
  sum.metrics = metrics(sum.sums);
  return sum;
}

}  // namespace

const StudiedModel& OneSensorStudy::model(const std::string& key) const {
  const auto found = std::ranges::find(models, key, &StudiedModel::key);
  assert(found != models.end());
  return *found;
}

const StudiedResult* OneSensorStudy::result(std::size_t damper, const std::string& key,
                                            std::size_t experiment) const {
  const auto found = std::ranges::find(models, key, &StudiedModel::key);
  if (found == models.end()) return nullptr;
  const auto& cell =
      dampers[damper].results[static_cast<std::size_t>(found - models.begin())][experiment];
  return cell ? &*cell : nullptr;
}

std::optional<StudiedResult> OneSensorStudy::example(std::size_t damper,
                                                     const std::string& key) const {
  return pooled(*this, damper, key, dampers[damper].damper.example);
}

std::optional<StudiedResult> OneSensorStudy::all(std::size_t damper, const std::string& key) const {
  std::vector<std::size_t> experiments;
  for (std::size_t e = 0; e < dampers[damper].damper.experiments.size(); ++e)
    experiments.push_back(e);
  return pooled(*this, damper, key, experiments);
}

OneSensorStudy study_one_sensor(std::vector<StudiedDamper> dampers,
                                const OneSensorOptions& options) {
  return StudyRun(std::move(dampers), options).run();
}

std::size_t smallest_sufficient(const std::vector<StudiedSize>& sizes) {
  constexpr double kAsGood = 1.02;
  double least = INFINITY;
  for (const StudiedSize& size : sizes) least = std::min(least, size.error);
  for (const StudiedSize& size : sizes)
    if (size.error <= kAsGood * least) return size.neurons;
  return 0;
}

}  // namespace dashpot
