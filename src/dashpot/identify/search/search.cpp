#include "dashpot/identify/search/search.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <tuple>

#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/task_farm.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/split.h"

namespace dashpot {
namespace {

constexpr std::size_t kFactor = 3;     // of halving: how many compete for one place
constexpr std::size_t kLeastLast = 3;  // trials of the last rung, so that there is a choice
constexpr std::size_t kMostRungs = 4;  // less than 1/27 of the effort says little

std::vector<NetworkDesign> first_designs(const SearchOptions& options) {
  if (options.method == SearchMethod::Grid) return grid_designs(options.space, options.steps);
  return random_designs(options.space, options.trials, options.fit.seed);
}

std::vector<Rung> halving_rungs(std::size_t trials) {
  if (trials < kFactor * kLeastLast)
    throw Error(
        "--method", std::to_string(trials) + " trials are too few to be divided by three",
        "halving needs " + std::to_string(kFactor * kLeastLast) + " or more; search by chance");
  std::vector<Rung> rungs{{trials, 1}};
  while (rungs.back().trials >= kFactor * kLeastLast && rungs.size() < kMostRungs)
    rungs.push_back({rungs.back().trials / kFactor, 1});
  for (std::size_t k = 0; k < rungs.size(); ++k)
    rungs[k].share =
        std::pow(1.0 / static_cast<double>(kFactor), static_cast<double>(rungs.size() - 1 - k));
  return rungs;
}

std::vector<Record> first_part(const std::vector<Record>& records, double share) {
  std::vector<Record> parts;
  for (const Record& record : records) {
    const double scored = static_cast<double>(record.size() - record.warm_up);
    parts.push_back(
        record.slice(0, record.warm_up + static_cast<std::size_t>(std::ceil(share * scored))));
  }
  return parts;
}

double standard_error(const std::vector<FoldResult>& folds) {
  const double n = static_cast<double>(folds.size());
  if (folds.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double mean = 0, square = 0;
  for (const FoldResult& fold : folds) mean += metrics(fold.sums).esr / n;
  for (const FoldResult& fold : folds) square += std::pow(metrics(fold.sums).esr - mean, 2);
  return std::sqrt(square / (n - 1) / n);
}

/// Pools the folds in their order, so that the bits are the same in whatever order they ended.
void judge(Trial& trial) {
  ErrorSums sums;
  for (const FoldResult& fold : trial.folds) {
    sums.add(fold.sums);
    trial.worst_esr = std::max(trial.worst_esr, fold.worst_esr);
    trial.parameters = std::max(trial.parameters, fold.parameters);
    trial.diverged += fold.diverged;
    trial.seconds += fold.seconds;
    if (trial.failure.empty()) trial.failure = fold.failure;
  }
  trial.left_out = metrics(sums);
  trial.standard_error = standard_error(trial.folds);
}

/// Marks those that no other has beaten with as few parameters. `trials` stand best first.
void mark_front(SearchReport& report) {
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (Trial& trial : report.trials) {
    trial.on_front = report.is_finalist(trial) && trial.parameters < fewest;
    if (trial.on_front) fewest = trial.parameters;
  }
}

class SearchRun {
 public:
  SearchRun(const Dataset& dataset, const LeaveOut& leave_out, const SearchOptions& options,
            TrialStore* store, const OnTrial& on_trial)
      : dataset_(dataset), store_(store), on_trial_(on_trial), folds_(split(dataset, leave_out)) {
    report_.options = options;
    report_.rungs = search_rungs(options);
    for (const Rung& rung : report_.rungs)
      work_ += static_cast<double>(rung.trials * folds_.size()) * rung.share;
    report_.leave_out = leave_out;
    for (const Fold& fold : folds_) report_.folds.push_back(fold.name);
  }

  SearchReport run() {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<NetworkDesign> designs = first_designs(report_.options);
    for (std::size_t rung = 0; rung < report_.rungs.size() && !designs.empty(); ++rung) {
      // Judge as many as the rung has places, best first; the usable ones go on.
      designs.resize(std::min(designs.size(), report_.rungs[rung].trials));
      std::vector<Trial> trials = run_rung(designs, rung);
      sort_trials(trials);
      designs.clear();
      for (const Trial& trial : trials)
        if (trial.is_usable()) designs.push_back(trial.design);
      take_over(std::move(trials));
    }

    sort_trials(report_.trials);
    mark_front(report_);
    report_.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(report_);
  }

  /// The results of one part, for the store alone.
  PartReport run_part(const Part& part) {
    std::vector<Trial> trials = trials_of(first_designs(report_.options), 0);
    const std::size_t all = trials.size() * folds_.size();
    std::vector<std::size_t> tasks;
    for (std::size_t k = 0; k < all; ++k)
      if (part.has(k)) tasks.push_back(k);
    work_ = static_cast<double>(tasks.size());
    const FarmReport farm =
        farm_out(tasks, report_.options.fit.threads, store_->store(), "", [&](std::size_t k) {
          run_fold(trials[k / folds_.size()], k / folds_.size(), k % folds_.size());
        });
    return {
        .tasks = tasks.size(), .all = all, .kept = farm.found, .wall_seconds = farm.wall_seconds};
  }

 private:
  /// Trials of these designs, with a place for each fold, and what they train on at this rung.
  std::vector<Trial> trials_of(const std::vector<NetworkDesign>& designs, std::size_t rung) {
    share_ = report_.rungs[rung].share;
    training_.clear();
    for (const Fold& fold : folds_)
      training_.push_back(by_samples() ? first_part(fold.training, share_) : fold.training);

    std::vector<Trial> trials;
    for (const NetworkDesign& design : designs)
      trials.push_back(
          {.design = design, .rung = rung, .folds = std::vector<FoldResult>(folds_.size())});
    missing_.assign(designs.size(), folds_.size());
    return trials;
  }

  /// Each fold of each trial is a task.
  std::vector<Trial> run_rung(const std::vector<NetworkDesign>& designs, std::size_t rung) {
    std::vector<Trial> trials = trials_of(designs, rung);
    parallel_for(designs.size() * folds_.size(), report_.options.fit.threads, [&](std::size_t k) {
      run_fold(trials[k / folds_.size()], k / folds_.size(), k % folds_.size());
    });
    return trials;
  }

  void run_fold(Trial& trial, std::size_t index, std::size_t fold) {
    const Monitor& monitor = report_.options.fit.monitor;
    const std::string stage = format_design(trial.design) + ", " + folds_[fold].name;
    monitor.report(stage, done_ / work_);

    // The result as it was kept, or made now and kept.
    const TrialStore::Key key{format_design(trial.design), share_, fold};
    std::optional<FoldResult> kept = store_ ? store_->load(key) : std::nullopt;
    const bool is_kept = kept.has_value();
    trial.folds[fold] = is_kept ? *std::move(kept) : result_of(trial.design, fold);
    if (store_ && !is_kept) store_->save(key, trial.folds[fold]);

    // The last fold of a trial to end judges it.
    {
      const std::lock_guard lock(guard_);
      done_ += share_;
      ++report_.results;
      report_.kept += is_kept;
      trial.kept += is_kept;
      if (--missing_[index] == 0) {
        judge(trial);
        if (on_trial_) on_trial_(trial, report_);
      }
    }
    monitor.report(stage, done_ / work_);
  }

  FoldResult result_of(const NetworkDesign& design, std::size_t fold) const {
    IdentifyOptions options = options_of(design, report_.options);
    if (by_epochs() && share_ < 1 && design.epochs) {
      const double epochs = share_ * static_cast<double>(*design.epochs);
      options.network.epochs = static_cast<std::size_t>(std::max(1.0, std::round(epochs)));
    }

    // A fit that fails is a result as well.
    FoldResult result;
    const double begin = cpu_seconds();
    try {
      const FitReport fit =
          identify(report_.options.model, training_[fold], dataset_.drive_unit, options);
      if (fit.model)
        run_left_out(fit, folds_[fold], result);
      else
        result.failure = fit.message.empty() ? "the fit failed" : fit.message;
    } catch (const Error& error) {
      result.failure = error.what();
    }
    result.seconds = cpu_seconds() - begin;
    return result;
  }

  void run_left_out(const FitReport& fit, const Fold& fold, FoldResult& result) const {
    const IdentifyOptions& options = report_.options.fit;
    const Evaluation left_out = evaluate(
        *fit.model, fold.left_out, dataset_.drive_unit,
        {.offset = options.offset, .known_offsets = fit.offsets, .threads = options.threads});
    for (const RecordResult& record : left_out.records)
      if (!record.diverged_at) result.sums.add(record.sums);
    result.worst_esr = left_out.worst_esr;
    result.diverged = left_out.diverged;
    result.parameters = fit.model->parameter_count();
  }

  /// Results of a further rung take the place of those of an earlier one.
  void take_over(std::vector<Trial> trials) {
    std::erase_if(report_.trials, [&](const Trial& old) {
      return std::ranges::any_of(trials,
                                 [&](const Trial& now) { return now.design == old.design; });
    });
    std::ranges::move(trials, std::back_inserter(report_.trials));
  }

  bool by_samples() const { return share_ < 1 && report_.options.effort == SearchEffort::Samples; }
  bool by_epochs() const { return report_.options.effort == SearchEffort::Epochs; }

  const Dataset& dataset_;
  TrialStore* store_;
  const OnTrial& on_trial_;
  std::vector<Fold> folds_;
  std::vector<std::vector<Record>> training_;  ///< of each fold, at this rung
  double share_ = 1;
  double work_ = 0;
  std::mutex guard_;
  std::atomic<double> done_ = 0;
  std::vector<std::size_t> missing_;  ///< folds of each trial
  SearchReport report_;
};

std::string_view name_of(SearchMethod method) {
  return method == SearchMethod::Grid     ? "grid"
         : method == SearchMethod::Random ? "random"
                                          : "halving";
}

std::string describe_roles(const Dataset& dataset) {
  std::string text;
  for (const Record& record : dataset.records)
    text += record.role == Role::Training ? 'T' : record.role == Role::LeftOut ? 'L' : '-';
  return text;
}

}  // namespace

std::vector<Rung> search_rungs(const SearchOptions& options) {
  require_space(options.space, options.model);
  const bool halving = options.method == SearchMethod::Halving;
  if (halving && options.effort == SearchEffort::Epochs && !options.space.fixed.epochs)
    throw Error("--effort", "epochs: their number, which is the full effort, is missing",
                "state them with --network epochs=300");
  const std::size_t designs = first_designs(options).size();
  if (designs == 0) throw Error("--trials", "there is none", "give at least one");
  return halving ? halving_rungs(designs) : std::vector{Rung{designs, 1}};
}

void sort_trials(std::vector<Trial>& trials) {
  // The settings decide last, so that equal trials have an order too.
  const auto key = [](const Trial& t) {
    const bool usable = t.is_usable();
    const int group = usable ? 0 : t.failure.empty() ? 1 : 2;
    return std::tuple(group, -static_cast<double>(t.rung), usable ? t.left_out.esr : 0.0,
                      t.parameters, format_design(t.design));
  };
  std::ranges::sort(trials, {}, key);
}

bool Trial::is_usable() const {
  return failure.empty() && diverged == 0 && left_out.samples > 0 && std::isfinite(left_out.esr);
}

bool SearchReport::is_finalist(const Trial& trial) const {
  return trial.is_usable() && trial.rung + 1 == rungs.size();
}

const Trial* SearchReport::best() const {
  return trials.empty() || !is_finalist(trials.front()) ? nullptr : &trials.front();
}

const Trial* SearchReport::smallest() const {
  const Trial* chosen = best();
  if (!chosen || !std::isfinite(chosen->standard_error)) return chosen;
  const double limit = chosen->left_out.esr + chosen->standard_error;
  for (const Trial& trial : trials)
    if (is_finalist(trial) && trial.left_out.esr <= limit && trial.parameters < chosen->parameters)
      chosen = &trial;
  return chosen;
}

NamedTexts describe_search(const Dataset& dataset, const LeaveOut& leave_out,
                           const SearchOptions& options, const std::string& program) {
  std::vector<std::string> axes;
  for (const SearchAxis& axis : options.space.axes) axes.push_back(format_axis(axis));
  IdentifyOptions fit = options.fit;
  fit.network = options.space.fixed;
  NamedTexts texts{{"data", fingerprint(dataset.records) + to_string(dataset.drive_unit) +
                                describe_roles(dataset)},
                   {"left out", format_leave_out(leave_out)},
                   {"model", options.model},
                   {"searched", join(axes, " ")},
                   {"method", std::string(name_of(options.method))}};
  for (auto& [name, value] : describe_options(fit)) texts.emplace_back(name, value);
  if (options.method == SearchMethod::Halving)
    texts.emplace_back("effort", options.effort == SearchEffort::Samples ? "samples" : "epochs");
  // Another instruction set rounds otherwise.
  texts.emplace_back("processor", "SIMD level " + std::string(name_of(simd_levels().back())));
  texts.emplace_back("program", program);
  return texts;
}

SearchReport search(const Dataset& dataset, const LeaveOut& leave_out, const SearchOptions& options,
                    TrialStore* store, const OnTrial& on_trial) {
  return SearchRun(dataset, leave_out, options, store, on_trial).run();
}

PartReport search_part(const Dataset& dataset, const LeaveOut& leave_out,
                       const SearchOptions& options, TrialStore& store, const Part& part) {
  if (options.method == SearchMethod::Halving)
    throw Error("--method", "halving is not shared among processes",
                "its later rounds need all results of the one before: search by chance or on a "
                "grid");
  const OnTrial nobody;
  return SearchRun(dataset, leave_out, options, &store, nobody).run_part(part);
}

IdentifyOptions options_of(const NetworkDesign& design, const SearchOptions& options) {
  IdentifyOptions fit = options.fit;
  fit.network = design;
  fit.seed = seed_for(options.fit.seed, format_design(design));
  return fit;
}

}  // namespace dashpot
