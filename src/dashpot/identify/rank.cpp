#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "dashpot/base/error.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/identify/identify.h"

namespace dashpot {
namespace {

/// Whether a part is set aside for good: then the model of the only fold is the final one.
bool is_one_division(const LeaveOut& leave_out) {
  return leave_out.by == LeaveOut::By::Fraction || leave_out.by == LeaveOut::By::Roles;
}

/// Nanoseconds for one advance and one force, measured over a whole record.
double step_cost(const DamperModel& model, const Record& record, std::string_view drive_unit) {
  const std::vector<DamperInput> inputs = damper_inputs(record, drive_unit);
  double best = INFINITY;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto begin = std::chrono::steady_clock::now();
    free_run(model, inputs, record.time);
    const auto taken = std::chrono::steady_clock::now() - begin;
    best = std::min(
        best, std::chrono::duration<double, std::nano>(taken).count() / static_cast<double>(inputs.size()));
  }
  return best;
}

/// All fits of one ranking: for each model one per fold, then the final one.
class RankingRun {
 public:
  RankingRun(const std::vector<std::string>& models, const Dataset& dataset, const LeaveOut& leave_out,
             const IdentifyOptions& options)
      : dataset_(dataset),
        options_(options),
        folds_(split(dataset, leave_out)),
        one_division_(is_one_division(leave_out)),
        training_(one_division_ ? folds_.front().training : dataset.records) {
    ranking_.leave_out = leave_out;
    for (const Fold& fold : folds_) ranking_.folds.push_back(fold.name);
    for (const std::string& model : models) {
      RankedModel ranked;
      ranked.name = model;
      ranked.title = model_info(model).title;
      ranked.fold_fits.resize(one_division_ ? 0 : folds_.size());
      ranking_.models.push_back(std::move(ranked));
    }
  }

  Ranking run() {
    const std::size_t fits = (one_division_ ? 0 : folds_.size()) + 1;
    const std::size_t tasks = ranking_.models.size() * fits;
    std::vector<std::size_t> order(tasks);
    std::iota(order.begin(), order.end(), 0);
    // The longest first, so that no core waits for it at the end.
    const auto cost = [&](std::size_t task) { return expected_cost(ranking_.models[task / fits].name); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
    std::atomic<std::size_t> done = 0;
    parallel_for(tasks, options_.threads, [&](std::size_t k) {
      RankedModel& ranked = ranking_.models[order[k] / fits];
      const std::size_t fit = order[k] % fits;
      const bool final = fit + 1 == fits;
      const std::string stage = ranked.name + (final ? "" : ", " + folds_[fit].name);
      options_.monitor.report("fitting " + stage, static_cast<double>(done) / static_cast<double>(tasks));
      (final ? ranked.fit : ranked.fold_fits[fit]) =
          identify(ranked.name, final ? training_ : folds_[fit].training, dataset_.drive_unit, options_);
      options_.monitor.report("fitted " + stage, static_cast<double>(++done) / static_cast<double>(tasks));
    });
    for (RankedModel& ranked : ranking_.models) judge(ranked);
    std::stable_sort(ranking_.models.begin(), ranking_.models.end(), better);
    return std::move(ranking_);
  }

 private:
  static double expected_cost(const std::string& model) {
    if (!is_law(model)) return 1;
    return find_law(model).states.empty() ? 0 : 10;
  }

  const FitReport& fit_of(const RankedModel& ranked, std::size_t fold) const {
    return ranked.fold_fits.empty() ? ranked.fit : ranked.fold_fits[fold];
  }

  void judge(RankedModel& ranked) const {
    ranked.seconds = ranked.fit.seconds;
    for (const FitReport& fit : ranked.fold_fits) ranked.seconds += fit.seconds;
    std::vector<Evaluation> evaluations;
    for (std::size_t f = 0; f < folds_.size(); ++f) {
      const FitReport& fit = fit_of(ranked, f);
      if (!fit.model) return fail(ranked, folds_[f].name);
      EvaluateOptions options{
          .offset = options_.offset, .known_offsets = fit.offsets, .threads = options_.threads};
      evaluations.push_back(evaluate(*fit.model, folds_[f].left_out, dataset_.drive_unit, options));
      for (RecordResult& record : evaluations.back().records) record.left_out = true;
    }
    ranked.left_out = pool(evaluations);
    if (!ranked.fit.model) return fail(ranked, "all records");
    ranked.training = evaluate(
        *ranked.fit.model, training_, dataset_.drive_unit,
        {.offset = options_.offset, .known_offsets = ranked.fit.offsets, .threads = options_.threads});
    ranked.nanoseconds_per_step = step_cost(*ranked.fit.model, training_.front(), dataset_.drive_unit);
  }

  static void fail(RankedModel& ranked, const std::string& where) {
    ranked.fit.status = FitReport::Status::Failed;
    ranked.fit.warnings.push_back("the fit on '" + where + "' failed: the model could not be judged");
  }

  static bool better(const RankedModel& a, const RankedModel& b) {
    const auto rank_of = [](const RankedModel& m) {
      const bool failed = m.fit.status == FitReport::Status::Failed;
      return std::pair(failed ? 2 : m.left_out.diverged > 0 ? 1 : 0, failed ? 0.0 : m.left_out.pooled.esr);
    };
    return rank_of(a) < rank_of(b);
  }

  const Dataset& dataset_;
  const IdentifyOptions& options_;
  std::vector<Fold> folds_;
  bool one_division_;
  std::vector<Record> training_;
  Ranking ranking_;
};

Domain domain_of(const std::vector<Record>& records, std::string_view drive_unit) {
  const DriveRange drive = drive_range(records, drive_unit);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Domain domain{kInfinity, -kInfinity, kInfinity, -kInfinity, drive.low, drive.high};
  for (const Record& record : records)
    for (const DamperInput& input : damper_inputs(record, drive_unit)) {
      domain.displacement_min = std::min(domain.displacement_min, input.displacement);
      domain.displacement_max = std::max(domain.displacement_max, input.displacement);
      domain.velocity_min = std::min(domain.velocity_min, input.velocity);
      domain.velocity_max = std::max(domain.velocity_max, input.velocity);
    }
  return domain;
}

}  // namespace

Ranking rank(const std::vector<std::string>& models, const Dataset& dataset, const LeaveOut& leave_out,
             const IdentifyOptions& options) {
  return RankingRun(models, dataset, leave_out, options).run();
}

ModelFile to_model_file(const RankedModel& ranked, const Dataset& dataset, const std::string& command) {
  if (!ranked.fit.model) throw Error(ranked.name, "has no fitted model to save");
  ModelFile file;
  file.model = ranked.fit.model->with_offset(0);
  file.drive_unit = dataset.drive_unit;
  std::vector<Record> used;
  for (const RecordResult& r : ranked.training.records) {
    file.provenance.training_records.push_back(r.record);
    for (const Record& record : dataset.records)
      if (record.name == r.record) used.push_back(record);
  }
  file.domain = domain_of(used, dataset.drive_unit);
  file.sample_time = used.front().sample_time;
  for (const Record& record : used)
    if (record.sample_time != file.sample_time) file.sample_time = 0;
  file.provenance.command = command;
  file.provenance.dataset = dataset.name;
  file.provenance.citation = dataset.citation;
  for (const SourceFile& source : dataset.files)
    file.provenance.files.push_back({source.path, source.sha256});
  file.quality = Value::object(
      {{"training", to_json(ranked.training.pooled)}, {"left_out", to_json(ranked.left_out.pooled)}});
  return file;
}

}  // namespace dashpot
