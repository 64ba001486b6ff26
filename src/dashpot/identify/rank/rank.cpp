#include "dashpot/rank.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>

#include "dashpot/base/parallel.h"
#include "dashpot/base/part.h"
#include "dashpot/base/task_farm.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify.h"
#include "dashpot/identify/judge/conformal.h"
#include "dashpot/identify/judge/forgetting.h"
#include "dashpot/identify/judge/stress.h"
#include "dashpot/identify/rank/divisions.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/identify/rank/fit_store.h"
#include "dashpot/identify/rank/information.h"
#include "dashpot/identify/rank/mean_of_models.h"
#include "dashpot/identify/rank/paired_ratio.h"
#include "dashpot/identify/rank/rank_and_tell.h"
#include "dashpot/record/inertia.h"

namespace dashpot {
namespace {

/// Nanoseconds for one advance and one force as a simulation asks for them, measured over a whole
/// record.
double step_cost(const DamperModel& model, const Record& record, DriveUnit drive_unit) {
  const std::vector<DamperInput> inputs = damper_inputs(record, drive_unit);
  std::vector<double> state(model.state_size()), force(inputs.size());
  double best = INFINITY;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto begin = std::chrono::steady_clock::now();
    model.rest(inputs.front(), state);
    model.DamperModel::run(inputs, {.time = record.time.data()}, state,
                           {force.data()});  // step by step, not a law's own loop
    const auto taken = std::chrono::steady_clock::now() - begin;
    best = std::min(best, std::chrono::duration<double, std::nano>(taken).count() /
                              static_cast<double>(inputs.size()));
  }
  return best;
}

double force_span(const std::vector<Record>& records) {
  double low = INFINITY, high = -INFINITY;
  for (const Record& record : records)
    for (const double force : record.channel("force").samples)
      low = std::min(low, force), high = std::max(high, force);
  return high - low;
}

/// Every record is shown once: the curves of training records that are shown as left-out ones would
/// fill the memory with those of dozens of models.
void drop_curves(Evaluation& training, const Evaluation& left_out, const LeaveOut& leave_out) {
  const auto is_shown = [&](const RecordResult& r) {
    return leave_out.by == LeaveOut::By::Blocks ||
           std::ranges::find(left_out.records, r.record, &RecordResult::record) !=
               left_out.records.end();
  };
  for (RecordResult& r : training.records) {
    if (!is_shown(r)) continue;
    for (auto curve : {&RecordResult::time, &RecordResult::displacement, &RecordResult::velocity,
                       &RecordResult::drive, &RecordResult::measured, &RecordResult::modelled,
                       &RecordResult::spread})
      (r.*curve) = {};
  }
}

/// How long a fit takes beside the others: the unknowns, times what a force costs, times the number
/// of tries.
double expected_cost(const std::string& model, const Record& record, DriveUnit drive_unit) {
  constexpr double kNetwork = 3000;  // a training beside the fit of a law without states, measured
  const Law* inside = law_inside(model);
  if (!inside) return kNetwork;

  // Unknowns of the law, times the cost of one force.
  const Law& law = *inside;
  std::vector<double> values;
  double unknowns = 0;
  for (const ParamInfo& param : law.params) {
    values.push_back(param.value);
    if (param.fit != Fit::Fixed) unknowns += static_cast<double>(coefficient_count(param.form));
  }
  const double of_law =
      unknowns * step_cost(LawModel::constant(law, values),
                           record.slice(0, std::min<std::size_t>(record.size(), 1000)), drive_unit);
  return is_law(model) ? of_law : of_law + kNetwork;
}

/// What models are compared over.
std::string unit_of(const LeaveOut& leave_out, const std::vector<Fold>& folds) {
  if (folds.size() >= kFewestDivisions)
    return leave_out.by == LeaveOut::By::Blocks ? "block" : "division";
  const bool are_cut = std::ranges::any_of(
      folds, [](const Fold& fold) { return fold.left_out.size() < kLeastUnits; });
  return are_cut ? "stretch of time" : "record";
}

/// A block of a record becomes a result of its own: "run 1, 4 to 8 s".
void name_block(RecordResult& result) {
  result.record += ", " + format_number(result.time[result.warm_up], 3) + " to " +
                   format_number(result.time.back(), 3) + " s";
}

/// What a law's fit knows of its numbers, for its file: intervals and, row by row, the covariance.
Value numbers_json(const FitReport& fit) {
  Value names = Value::array(), low = Value::array(), high = Value::array(),
        covariance = Value::array();
  const auto number = [](double value) { return std::isfinite(value) ? Value(value) : Value(); };
  const std::size_t count = fit.parameters.size();
  for (std::size_t k = 0; k < count; ++k) {
    names.push_back(fit.parameters[k].name);
    low.push_back(number(fit.parameters[k].low));
    high.push_back(number(fit.parameters[k].high));
    Value row = Value::array();
    for (std::size_t j = 0; j < count; ++j) row.push_back(number(fit.covariance[k * count + j]));
    covariance.push_back(std::move(row));
  }
  return Value::object({{"names", std::move(names)},
                        {"low", std::move(low)},
                        {"high", std::move(high)},
                        {"covariance", std::move(covariance)}});
}

/// What is to be known of a model that does not forget, or slowly; nothing of others.
std::string forgetting_warning(const Forgetting& result) {
  if (result.is_forgotten() && result.seconds <= kForgettingSeconds) return {};
  if (result.is_forgotten())
    return "it is slow to forget how it began: from another state its force comes within " +
           format_number(100 * kForgottenShare, 2) + " % of the span only after " +
           format_number(result.seconds, 2) + " s";
  const std::string left = std::isfinite(result.share_left)
                               ? "runs from different states still differ by " +
                                     format_number(100 * result.share_left, 2) +
                                     " % of the force span"
                               : "it diverges from a state that it meets elsewhere in the data";
  return "it does not forget how it began: on '" + result.record + "' " + left +
         "; it is not recommended";
}

/// All fits of one ranking: for each model one per fold, then the final one.
class RankingRun {
 public:
  RankingRun(const std::vector<std::string>& models, const Dataset& dataset,
             const LeaveOut& leave_out, const IdentifyOptions& options, FitStore* store,
             OnJudged on_judged = {})
      : dataset_(dataset),
        options_(options),
        store_(store),
        on_judged_(std::move(on_judged)),
        divisions_(divide(dataset, leave_out)),
        domain_(domain_of(training_, dataset.drive_unit)),
        force_span_(force_span(training_)) {
    // Empty rows for all models, with a place for each fit.
    ranking_.leave_out = leave_out;
    ranking_.unit = unit_of(leave_out, folds_);
    for (const Fold& fold : folds_) ranking_.folds.push_back(fold.name);
    for (const std::string& model : models) {
      RankedModel ranked;
      ranked.name = model;
      ranked.title = model_info(model).title;
      if (model_info(model).kind == ModelKind::Mean) {
        mean_ = std::move(ranked);
        continue;
      }
      ranked.fold_fits.resize(divisions_.is_one ? 0 : folds_.size());
      ranked.held_back_fits.resize(held_back_.size());
      ranking_.models.push_back(std::move(ranked));
    }
    if (mean_ && ranking_.models.size() < 2)
      throw Error(mean_->name, "is made of the other models of a ranking",
                  "name two or more of them with it");
  }

  Ranking run() {
    const auto begin = std::chrono::steady_clock::now();

    // Each model is judged as soon as its last fit has ended.
    const std::vector<Task> tasks = tasks_by_cost();
    std::vector<std::atomic<std::size_t>> left(ranking_.models.size());
    for (const Task& task : tasks) ++left[place_of(task)];
    make(tasks, [&](const Task& task) {
      if (--left[place_of(task)] > 0) return;
      RankedModel& ranked = ranking_.models[place_of(task)];
      judge(ranked);
      tell(ranked);
    });
    if (refused_ == tasks.size()) throw Error("", ranking_.models.front().fit.message);
    if (mean_) add_mean();

    // Then sort. What a step costs is measured when nothing else runs.
    for (RankedModel& ranked : ranking_.models)
      if (ranked.fit.model)
        ranked.nanoseconds_per_step =
            step_cost(*ranked.fit.model, training_.front(), dataset_.drive_unit);
    std::stable_sort(ranking_.models.begin(), ranking_.models.end(), better);
    compare_with_first();
    ranking_.kept_fits = kept_;
    ranking_.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(ranking_);
  }

  /// The fits of one part, for the store alone.
  PartReport run_part(const Part& part) {
    std::vector<Task> tasks = tasks_by_cost();
    PartReport report{.all = tasks.size()};
    std::erase_if(tasks, [&](const Task& task) { return !part.has(task.number); });

    // Processes agree on a task by its number, whatever they measured.
    std::vector<std::size_t> numbers;
    std::map<std::size_t, const Task*> by_number;
    for (const Task& task : tasks) {
      numbers.push_back(task.number);
      by_number[task.number] = &task;
    }
    std::atomic<std::size_t> done = 0;
    const FarmReport farm =
        farm_out(numbers, options_.threads, store_->store(), identity(),
                 [&](std::size_t number) { make(*by_number.at(number), done, tasks.size()); });
    report.tasks = tasks.size();
    report.kept = farm.found;
    report.wall_seconds = farm.wall_seconds;
    return report;
  }

 private:
  struct Task {
    std::size_t number;  ///< in the order of models and folds, which no measured cost changes
    const RankedModel* model;
    const Fold* fold;  ///< none: the final fit
    FitReport* report;
    double cost;
  };

  void tell(const RankedModel& ranked) {
    if (!on_judged_) return;
    const std::lock_guard lock(telling_);
    on_judged_(ranked);
  }

  /// The mean of the best models, judged as each of them is: by those of their fits that have not
  /// seen the records.
  void add_mean() {
    const std::vector<MeanShare> shares = shares_of_mean(ranking_.models);
    if (shares.empty()) {
      fail(*mean_, "all records", "fewer than two models may be members of it");
    } else {
      make_mean(ranking_.models, shares, *mean_);
      judge(*mean_);
      mean_->fit.training_rmse = mean_->training.pooled.rmse;
      tell(*mean_);
    }
    ranking_.models.push_back(std::move(*mean_));
  }

  std::size_t place_of(const Task& task) const {
    return static_cast<std::size_t>(task.model - ranking_.models.data());
  }

  /// All fits of all models in one farm; `then` is called after each, from its thread.
  void make(const std::vector<Task>& tasks, const std::function<void(const Task&)>& then) {
    std::atomic<std::size_t> done = 0;
    parallel_for(tasks.size(), options_.threads, [&](std::size_t k) {
      make(tasks[k], done, tasks.size());
      then(tasks[k]);
    });
  }

  /// One fit; `done` of `all` have ended.
  void make(const Task& task, std::atomic<std::size_t>& done, std::size_t all) {
    const std::string stage = task.model->name + (task.fold ? ", " + task.fold->name : "");
    const auto share = [&] { return static_cast<double>(done) / static_cast<double>(all); };
    options_.monitor.report("fitting " + stage, share());
    *task.report = fit(task.model->name, stage, task.fold ? task.fold->training : training_);
    ++done;
    options_.monitor.report("fitted " + stage, share());
  }

  /// All that the tasks of a part depend on, in whatever process.
  std::string identity() const {
    std::vector<std::string> parts{
        store_->program(), fingerprint(training_), to_string(dataset_.drive_unit),
        format_leave_out(ranking_.leave_out), std::string(name_of(simd_levels().back()))};
    for (const RankedModel& model : ranking_.models) parts.push_back(model.name);
    for (const auto& [name, value] : describe_options(options_)) parts.push_back(value);
    return join(parts, "\n");
  }

  /// The longest first, so that no core waits for it at the end.
  std::vector<Task> tasks_by_cost() {
    std::vector<Task> tasks;
    for (RankedModel& ranked : ranking_.models) {
      const double cost = expected_cost(ranked.name, training_.front(), dataset_.drive_unit);
      const auto add = [&](const Fold* fold, FitReport& report) {
        tasks.push_back({tasks.size(), &ranked, fold, &report, cost});
      };
      add(nullptr, ranked.fit);
      for (std::size_t f = 0; f < ranked.fold_fits.size(); ++f)
        add(&folds_[f], ranked.fold_fits[f]);
      for (std::size_t f = 0; f < held_back_.size(); ++f)
        add(&held_back_[f], ranked.held_back_fits[f]);
    }
    std::stable_sort(tasks.begin(), tasks.end(),
                     [](const Task& a, const Task& b) { return a.cost > b.cost; });
    return tasks;
  }

  /// As it was kept, or made now and kept. A model that these records cannot serve is no end of the
  /// others: its report says why.
  FitReport fit(const std::string& model, const std::string& stage,
                const std::vector<Record>& training) {
    const FitStore::Request request{model, training, dataset_.drive_unit, options_};
    if (store_)
      if (std::optional<FitReport> kept = store_->load(request)) {
        ++kept_;
        return std::move(*kept);
      }

    FitReport report;
    try {
      IdentifyOptions options = options_;
      options.monitor.stage = stage;
      report = identify(model, training, dataset_.drive_unit, options);
    } catch (const Error& error) {
      ++refused_;
      report.message = error.what();
      return report;
    }
    if (store_) store_->save(request, report);
    return report;
  }

  const FitReport& fit_of(const RankedModel& ranked, std::size_t fold) const {
    return ranked.fold_fits.empty() ? ranked.fit : ranked.fold_fits[fold];
  }

  Evaluation evaluate_fit(const FitReport& fit, const std::vector<Record>& records) const {
    return evaluate(
        *fit.model, records, dataset_.drive_unit,
        {.offset = options_.offset, .known_offsets = fit.offsets, .threads = options_.threads});
  }

  void judge(RankedModel& ranked) const {
    ranked.seconds = ranked.fit.seconds;
    for (const auto* fits : {&ranked.fold_fits, &ranked.held_back_fits})
      for (const FitReport& fit : *fits) ranked.seconds += fit.seconds;

    // The models of the folds, each on its left-out records.
    std::vector<Evaluation> evaluations;
    for (std::size_t f = 0; f < folds_.size(); ++f) {
      const FitReport& fit = fit_of(ranked, f);
      if (!fit.model) return fail(ranked, folds_[f].name, fit.message);
      evaluations.push_back(evaluate_fit(fit, folds_[f].left_out));
      for (RecordResult& record : evaluations.back().records) {
        record.left_out = true;
        if (ranking_.leave_out.by == LeaveOut::By::Blocks) name_block(record);
      }
    }
    const std::vector<ErrorGroups> errors = add_bands(ranked, evaluations);
    ranked.left_out = pool(evaluations);
    ranked.esr_parts = esr_parts(evaluations);

    // The final model: errors on its own records, its interval, its behaviour beyond them, its
    // memory, its energy.
    if (!ranked.fit.model) return fail(ranked, "all records", ranked.fit.message);
    ranked.training = evaluate_fit(ranked.fit, training_);
    ranked.band = conformal_band(error_shape(ranked.training.records), errors);
    ranked.likelihood = likelihood_of(ranked, options_);
    drop_curves(ranked.training, ranked.left_out, ranking_.leave_out);
    ranked.stress = stress(*ranked.fit.model, domain_, force_span_);
    ranked.forgetting = forgetting(*ranked.fit.model, training_, dataset_.drive_unit, force_span_,
                                   options_.threads);
    if (std::string remembered = forgetting_warning(ranked.forgetting); !remembered.empty())
      ranked.fit.warnings.push_back(std::move(remembered));
    ranked.dissipation = dissipation(*ranked.fit.model, domain_, options_.threads);
    if (!ranked.dissipation.dissipates())
      ranked.fit.warnings.push_back(activity(ranked.dissipation, dataset_.drive_unit) +
                                    "; it is not recommended");
  }

  /// A model on a fold: the shape of its errors on the training part, and its errors on the rest
  /// relative to that shape.
  struct FoldErrors {
    std::optional<ForceBand> shape;
    ErrorGroups relative;
  };
  FoldErrors fold_errors(const FitReport& fit, const Fold& fold, const Evaluation& left_out) const {
    FoldErrors errors{error_shape(evaluate_fit(fit, fold.training).records), {}};
    if (errors.shape) errors.relative = relative_errors(left_out.records, *errors.shape);
    return errors;
  }

  /// Gives each left-out record its interval, built without what it is judged on, and returns the
  /// errors that the final model's interval comes from.
  std::vector<ErrorGroups> add_bands(const RankedModel& ranked,
                                     std::vector<Evaluation>& left_out) const {
    // The ends of all records are as many parts as their stretches, without a further fit.
    if (ranking_.leave_out.by == LeaveOut::By::Fraction) {
      const FitReport& fit = fit_of(ranked, 0);
      const std::optional<ForceBand> shape = error_shape(evaluate_fit(fit, training_).records);
      if (!shape) return {};
      return cover_by_parts(*shape, left_out.front().records);
    }

    std::vector<FoldErrors> folds;
    for (std::size_t f = 0; f < folds_.size(); ++f)
      folds.push_back(fold_errors(fit_of(ranked, f), folds_[f], left_out[f]));

    // Further models, fitted only for the interval.
    std::vector<ErrorGroups> held;
    for (std::size_t f = 0; f < held_back_.size(); ++f)
      if (const FitReport& fit = ranked.held_back_fits[f]; fit.model)
        held.push_back(
            fold_errors(fit, held_back_[f], evaluate_fit(fit, held_back_[f].left_out)).relative);

    // The errors of all parts but one.
    const auto others = [&](std::size_t left) {
      std::vector<ErrorGroups> parts = held;
      for (std::size_t f = 0; f < folds.size() && folds.size() > 1; ++f)
        if (f != left) parts.push_back(folds[f].relative);
      std::erase_if(parts, [](const ErrorGroups& part) { return part.empty(); });
      return parts;
    };

    // The band of a fold comes from the others; that of the final model from all.
    for (std::size_t f = 0; f < folds.size(); ++f) {
      const std::optional<ForceBand> band = conformal_band(folds[f].shape, others(f));
      if (!band) continue;
      for (RecordResult& record : left_out[f].records) {
        record.band = band;
        record.coverage = coverage(record, *band);
      }
    }
    return others(folds.size());
  }

  static void fail(RankedModel& ranked, const std::string& where, const std::string& why) {
    ranked.fit.status = FitReport::Status::Failed;
    ranked.fit.model.reset();  // never judged, so not to be saved either
    ranked.fit.warnings.push_back("the fit on '" + where + "' failed" +
                                  (why.empty() ? "" : " (" + why + ")") +
                                  ": the model could not be judged");
  }

  static bool better(const RankedModel& a, const RankedModel& b) {
    const auto rank_of = [](const RankedModel& m) {
      const bool failed = m.fit.status == FitReport::Status::Failed;
      return std::pair(failed                    ? 3
                       : m.left_out.diverged > 0 ? 2
                       : !is_recommendable(m)    ? 1
                                                 : 0,
                       failed ? 0.0 : m.left_out.pooled.esr);
    };
    return rank_of(a) < rank_of(b);
  }

  /// The first model is what the others are measured by, if it can be recommended.
  void compare_with_first() {
    std::vector<RankedModel>& models = ranking_.models;
    if (models.empty() || !is_recommendable(models.front())) return;
    for (auto model = models.begin() + 1; model != models.end(); ++model)
      if (is_usable(*model) && !model->esr_parts.empty())
        model->over_first = paired_ratio(model->esr_parts, models.front().esr_parts);
  }

  const Dataset& dataset_;
  const IdentifyOptions& options_;
  FitStore* store_;
  OnJudged on_judged_;
  std::mutex telling_;  ///< one model at a time
  const Divisions divisions_;
  const std::vector<Fold>& folds_ = divisions_.folds;
  const std::vector<Fold>& held_back_ = divisions_.held_back;
  const std::vector<Record>& training_ = divisions_.training;
  Domain domain_;
  double force_span_;
  std::atomic<std::size_t> kept_ = 0, refused_ = 0;
  std::optional<RankedModel> mean_;  ///< of the others, where it is asked for
  Ranking ranking_;
};

}  // namespace

bool is_usable(const RankedModel& model) {
  return model.fit.status != FitReport::Status::Failed && model.left_out.diverged == 0 &&
         !model.left_out.records.empty() && std::isfinite(model.left_out.pooled.esr);
}

bool is_recommendable(const RankedModel& model) {
  return is_usable(model) && model.forgetting.is_forgotten() && model.dissipation.dissipates();
}

std::vector<const RankedModel*> Ranking::leaders() const {
  std::vector<const RankedModel*> leaders;
  for (const RankedModel& model : models)
    if (is_recommendable(model) &&
        (leaders.empty() || !model.over_first || !model.over_first->is_worse()))
      leaders.push_back(&model);
  return leaders;
}

std::vector<const RankedModel*> Ranking::by_ride() const {
  std::vector<const RankedModel*> ridden_models;
  for (const RankedModel& model : models)
    if (model.ride && model.ride->refusal.empty()) ridden_models.push_back(&model);
  std::ranges::stable_sort(ridden_models, {},
                           [](const RankedModel* model) { return model->ride->error.value; });
  return ridden_models;
}

Ranking rank(const std::vector<std::string>& models, const Dataset& dataset,
             const LeaveOut& leave_out, const IdentifyOptions& options, FitStore* store) {
  return RankingRun(models, dataset, leave_out, options, store).run();
}

Ranking rank_and_tell(const std::vector<std::string>& models, const Dataset& dataset,
                      const LeaveOut& leave_out, const IdentifyOptions& options, FitStore* store,
                      OnJudged on_judged) {
  return RankingRun(models, dataset, leave_out, options, store, std::move(on_judged)).run();
}

void require_further(const Dataset& further, const Dataset& fitted) {
  for (const SourceFile& file : further.files)
    if (const auto same = std::ranges::find(fitted.files, file.sha256, &SourceFile::sha256);
        same != fitted.files.end())
      throw Error(file.path,
                  "is among the recordings that the models are fitted on" +
                      (same->path == file.path ? "" : ", as " + same->path),
                  "validate on recordings that no fit sees");
  if (further.drive_unit != fitted.drive_unit)
    throw Error(further.name,
                "is driven in " + name_of(further.drive_unit) + ", the recordings of the fit in " +
                    name_of(fitted.drive_unit),
                "further recordings with the same drive");
}

void validate(Ranking& ranking, const Dataset& further, const IdentifyOptions& options) {
  ranking.validated_on = further.name;
  std::vector<Record> records = further.records;
  if (ranking.inertia)
    for (Record& record : records) take_off_inertia(record, ranking.inertia->mass);

  parallel_for(ranking.models.size(), options.threads, [&](std::size_t k) {
    RankedModel& ranked = ranking.models[k];
    if (!ranked.fit.model) return;
    try {
      ranked.validation = evaluate(*ranked.fit.model, records, further.drive_unit,
                                   {.offset = options.offset,
                                    .known_offsets = {},
                                    .band = ranked.band,
                                    .threads = options.threads});
    } catch (const Error& error) {
      ranked.fit.warnings.push_back(std::string("not validated: ") + error.what());
    }
  });
}

PartReport rank_part(const std::vector<std::string>& models, const Dataset& dataset,
                     const LeaveOut& leave_out, const IdentifyOptions& options, FitStore& store,
                     const Part& part) {
  return RankingRun(models, dataset, leave_out, options, &store).run_part(part);
}

Provenance provenance_of(const Dataset& dataset, std::vector<std::string> records,
                         const std::string& command) {
  Provenance from;
  from.command = command;
  from.dataset = dataset.name;
  from.citation = dataset.citation;
  for (const SourceFile& source : dataset.files) from.files.push_back({source.path, source.sha256});
  from.training_records = std::move(records);
  return from;
}

std::size_t seen_records(const Provenance& provenance, const Dataset& dataset) {
  const bool share_a_file = std::ranges::any_of(dataset.files, [&](const SourceFile& file) {
    return std::ranges::find(provenance.files, file.sha256, &Provenance::File::sha256) !=
           provenance.files.end();
  });
  if (!share_a_file) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(dataset.records, [&](const Record& record) {
    return std::ranges::find(provenance.training_records, record.name) !=
           provenance.training_records.end();
  }));
}

ModelFile to_model_file(const RankedModel& ranked, const Dataset& dataset,
                        const std::string& command) {
  if (!ranked.fit.model) throw Error(ranked.name, "has no fitted model to save");
  ModelFile file;
  file.model = ranked.fit.model->with_offset(0);
  file.drive_unit = dataset.drive_unit;

  // Domain, sample time and mass come from the records of the fit; where these differ in one of the
  // last two, the file states none.
  std::vector<Record> used;
  std::vector<std::string> names;
  for (const RecordResult& r : ranked.training.records) {
    names.push_back(r.record);
    for (const Record& record : dataset.records)
      if (record.name == r.record) used.push_back(record);
  }
  file.domain = domain_of(used, dataset.drive_unit);
  file.sample_time = used.front().sample_time;
  file.moving_mass = used.front().moving_mass;
  for (const Record& record : used) {
    if (record.sample_time != file.sample_time) file.sample_time = 0;
    if (record.moving_mass != file.moving_mass) file.moving_mass = 0;
  }

  // Its origin, and how good it is.
  file.provenance = provenance_of(dataset, std::move(names), command);
  file.quality = Value::object({{"training", to_json(ranked.training.pooled)},
                                {"left_out", to_json(ranked.left_out.pooled)}});
  if (ranked.validation.pooled.samples > 0)
    file.quality.add("validation", to_json(ranked.validation.pooled));
  if (!ranked.fit.covariance.empty()) file.quality.add("parameters", numbers_json(ranked.fit));
  file.interval = ranked.band;
  if (ranked.dissipation.is_tested) file.dissipation = ranked.dissipation;
  return file;
}

}  // namespace dashpot
