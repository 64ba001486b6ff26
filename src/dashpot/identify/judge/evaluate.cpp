#include "dashpot/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/identify/judge/conformal.h"
#include "dashpot/model_file.h"
#include "dashpot/record/inertia.h"
#include "dashpot/record/time_base.h"

namespace dashpot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The drive of a record; 0 throughout where the drive of the dataset is one unknown constant.
std::vector<double> drive_samples(const Record& record, DriveUnit drive_unit) {
  if (drive_unit == DriveUnit::None) return std::vector<double>(record.size());
  return record.channel(drive_channel(drive_unit)).samples;
}

/// Refuses records whose drive is not known beside others whose drive is, and says which.
void require_known_drive(const std::vector<Record>& records, DriveUnit drive_unit) {
  if (drive_unit == DriveUnit::None) return;
  const std::string& name = drive_channel(drive_unit);
  std::vector<std::string> unknown;
  for (const Record& record : records)
    if (!record.find(name)) unknown.push_back(record.name);
  if (unknown.empty()) return;

  // The first few by name, beside how many have one.
  constexpr std::size_t kNamed = 3;
  const std::size_t known = records.size() - unknown.size();
  const std::string first = unknown.front();
  const std::size_t others = unknown.size() - 1;
  unknown.erase(unknown.begin());
  if (unknown.size() > kNamed) unknown.resize(kNamed);
  std::string what = "has no known " + name;
  if (others > 0)
    what += (others == 1 ? ", nor has " : ", nor have ") + join(unknown, ", ") +
            (others > kNamed ? " and " + std::to_string(others - kNamed) + " more" : "");
  if (known > 0)
    what += "; " + std::to_string(known) + " of " + std::to_string(records.size()) +
            (known == 1 ? " records has one" : " records have one");
  throw Error(first, what,
              "give it as a column, in the file name (run_0.5" + to_string(drive_unit) +
                  ".csv), in manifest.csv or as 'level:' in a dataset file, whose 'drive: none' "
                  "takes all records as of one constant, unknown drive");
}

/// The offset that training gave the record: the mean over its parts, where a block was left out
/// between them.
std::optional<double> known_offset(const EvaluateOptions& options, const std::string& record) {
  double sum = 0, parts = 0;
  for (const auto& [name, offset] : options.known_offsets)
    if (name == record) sum += offset, ++parts;
  return parts > 0 ? std::optional(sum / parts) : std::nullopt;
}

/// Mean of measured - modelled over the scored samples.
double mean_error(const RecordResult& result) {
  double sum = 0;
  for (std::size_t k = result.warm_up; k < result.measured.size(); ++k)
    sum += result.measured[k] - result.modelled[k];
  return sum / static_cast<double>(result.measured.size() - result.warm_up);
}

ErrorSums error_sums(const RecordResult& result, double offset) {
  ErrorSums sums;
  for (std::size_t k = result.warm_up; k < result.measured.size(); ++k)
    sums.add(result.measured[k], result.modelled[k] + offset);
  return sums;
}

double energy_error_percent(const RecordResult& r) {
  const std::span time(r.time), velocity(r.velocity), measured(r.measured), modelled(r.modelled);
  const double truth = dissipated_energy(time.subspan(r.warm_up), velocity.subspan(r.warm_up),
                                         measured.subspan(r.warm_up));
  const double model = dissipated_energy(time.subspan(r.warm_up), velocity.subspan(r.warm_up),
                                         modelled.subspan(r.warm_up));
  return 100 * (model - truth) / std::abs(truth);
}

/// Whether samples of the record lie on each instant of the model's grid.
bool on_grid(const Record& record, double step) {
  if (record.sample_time <= 0) return false;
  const double samples = step / record.sample_time;
  return samples > 0.5 && std::abs(samples - std::round(samples)) < 1e-6;
}

/// Errors of predictions one step ahead: a model that feeds its force back is given the measured
/// force (less `offset`, N) at each of its steps instead of its own. A figure that flatters: at
/// high sample rates the last force alone predicts the next. Without samples for a model that feeds
/// nothing back.
ErrorSums one_step_errors(const DamperModel& model, const Record& record, DriveUnit drive_unit,
                          double offset) {
  const double step = model.feedback_step();
  if (step == 0) return {};

  // A record that is sampled off the model's grid is resampled onto it, if it is long enough.
  if (!on_grid(record, step)) {
    if (record.time.back() - record.time.front() < 2 * step) return {};
    Record grid = record;
    resample(grid, 1 / step);
    return on_grid(grid, step) ? one_step_errors(model, grid, drive_unit, offset) : ErrorSums{};
  }

  // Step through the record. Score each force before the model is given the measured one.
  const std::vector<DamperInput> inputs = damper_inputs(record, drive_unit);
  const std::vector<double>& force = record.channel("force").samples;
  std::vector<double> state(model.state_size());
  ErrorSums sums;
  model.rest(inputs.front(), state);
  for (std::size_t k = 0; k < inputs.size() && !model.has_diverged(state); ++k) {
    if (k > 0) model.advance(inputs[k - 1], inputs[k], record.time[k] - record.time[k - 1], state);
    if (k >= record.warm_up) sums.add(force[k], model.force(inputs[k], state) + offset);
    model.observe(force[k] - offset, state);
  }
  return sums;
}

RecordResult evaluate_record(const DamperModel& model, const Record& record, DriveUnit drive_unit,
                             const EvaluateOptions& options) {
  RecordResult result;
  result.record = record.name;
  result.condition = record.condition;
  result.drive_level = record.drive_level;
  result.warm_up = record.warm_up;
  result.band = options.band;
  result.time = record.time;
  result.measured = record.channel("force").samples;
  result.velocity = record.channel("velocity").samples;
  result.drive = drive_samples(record, drive_unit);
  if (const Channel* displacement = record.find("displacement"))
    result.displacement = displacement->samples;

  // Run the model free, made for this record's conditions where it is one of a family.
  const std::shared_ptr<const DamperModel> specialised = model.specialised(record.conditions);
  const DamperModel& damper = specialised ? *specialised : model;
  result.extrapolations = damper.extrapolations();
  FreeRun run = free_run(damper, damper_inputs(record, drive_unit), record.time);
  result.modelled = std::move(run.force);
  result.spread = std::move(run.spread);
  result.diverged_at = run.diverged_at;
  if (result.diverged_at) return result;

  // The record's free offset, unless training has fixed it.
  if (const std::optional<double> known = known_offset(options, record.name)) {
    result.offset = *known;
  } else if (options.offset == OffsetMode::Record) {
    result.offset = mean_error(result);
  }

  // Score it with and without the offset.
  result.sums = error_sums(result, result.offset);
  result.sums_without_offset = error_sums(result, 0);
  result.one_step = one_step_errors(damper, record, drive_unit, result.offset);
  result.metrics = metrics(result.sums);
  result.metrics_without_offset = metrics(result.sums_without_offset);
  for (double& force : result.modelled) force += result.offset;
  result.energy_error = energy_error_percent(result);
  if (result.band) result.coverage = coverage(result, *result.band);
  return result;
}

/// Bands of |v|, as shares of the largest |v| in the records.
constexpr struct {
  std::string_view name;
  double low, high;
} kBands[] = {{"pre-yield, |v| below 5 % of the largest", 0, 0.05},
              {"low, 5-25 %", 0.05, 0.25},
              {"middle, 25-60 %", 0.25, 0.6},
              {"high, above 60 %", 0.6, 1}};

std::vector<BandResult> velocity_bands(const std::vector<RecordResult>& records) {
  double fastest = 0;
  for (const RecordResult& r : records)
    for (const double v : r.velocity) fastest = std::max(fastest, std::abs(v));

  std::vector<BandResult> bands;
  for (const auto& band : kBands) {
    // The fastest sample belongs to the last band.
    const bool last = band.high == 1;
    ErrorSums sums;
    for (const RecordResult& r : records) {
      if (r.diverged_at) continue;
      for (std::size_t k = r.warm_up; k < r.measured.size(); ++k) {
        const double share = std::abs(r.velocity[k]) / fastest;
        if (share >= band.low && (share < band.high || last))
          sums.add(r.measured[k], r.modelled[k]);
      }
    }
    bands.push_back(
        {std::string(band.name), band.low * fastest, band.high * fastest, metrics(sums)});
  }
  return bands;
}

/// Errors of the scored samples whose drive lies in [low, high); the upper end belongs to the last
/// range.
ErrorSums sums_at_drive(const std::vector<RecordResult>& records, double low, double high,
                        bool last) {
  ErrorSums sums;
  for (const RecordResult& r : records) {
    if (r.diverged_at) continue;
    for (std::size_t k = r.warm_up; k < r.measured.size(); ++k)
      if (r.drive[k] >= low && (r.drive[k] < high || (last && r.drive[k] <= high)))
        sums.add(r.measured[k], r.modelled[k]);
  }
  return sums;
}

std::vector<DriveResult> by_quarter_of_drive(const std::vector<RecordResult>& records) {
  constexpr int kQuarters = 4;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const RecordResult& r : records)
    for (const double drive : r.drive) low = std::min(low, drive), high = std::max(high, drive);
  std::vector<DriveResult> results;
  for (int q = 0; q < kQuarters; ++q) {
    const double from = low + (high - low) * q / kQuarters,
                 to = low + (high - low) * (q + 1) / kQuarters;
    const ErrorSums sums = sums_at_drive(records, from, to, q + 1 == kQuarters);
    if (sums.n > 0) results.push_back({from, to, metrics(sums)});
  }
  return results;
}

std::vector<DriveResult> by_drive(const std::vector<RecordResult>& records) {
  std::map<double, ErrorSums> levels;
  for (const RecordResult& r : records) {
    if (!r.drive_level) return by_quarter_of_drive(records);
    if (!r.diverged_at) levels[*r.drive_level].add(r.sums);
  }
  std::vector<DriveResult> results;
  for (const auto& [level, sums] : levels) results.push_back({level, level, metrics(sums)});
  return results;
}

/// The force changes as much as a share of its power needs to mean anything: a damper that rests
/// leaves noise over nothing.
bool tells_a_share(const ErrorSums& record, const ErrorSums& all) {
  constexpr double kLeast = 1e-6;  // of the mean power of all records
  return record.force_variation() * static_cast<double>(all.n) >=
         kLeast * all.force_variation() * static_cast<double>(record.n);
}

/// The figures over all records; those that diverged are counted, never averaged.
Evaluation summarise(std::vector<RecordResult> records) {
  Evaluation evaluation;
  evaluation.records = std::move(records);

  // Add up the records.
  ErrorSums sums, without, one_step;
  for (RecordResult& r : evaluation.records) {
    if (r.diverged_at) {
      ++evaluation.diverged;
      continue;
    }
    evaluation.coverage.add(r.coverage);
    sums.add(r.sums);
    without.add(r.sums_without_offset);
    one_step.add(r.one_step);
  }

  // Means over the records, and the worst of them.
  double judged = 0;
  for (const RecordResult& r : evaluation.records) {
    if (r.diverged_at || !tells_a_share(r.sums, sums)) continue;
    ++judged;
    evaluation.mean_esr += r.metrics.esr;
    evaluation.mean_energy_error += std::abs(r.energy_error);
    if (r.metrics.esr >= evaluation.worst_esr) {
      evaluation.worst_esr = r.metrics.esr;
      evaluation.worst_record = r.record;
    }
  }
  evaluation.mean_esr /= judged;
  evaluation.mean_energy_error /= judged;

  // Figures over all samples together.
  evaluation.pooled = metrics(sums);
  evaluation.pooled_without_offset = metrics(without);
  if (one_step.n > 0) evaluation.one_step = metrics(one_step);
  evaluation.bands = velocity_bands(evaluation.records);
  evaluation.drive = by_drive(evaluation.records);
  return evaluation;
}

}  // namespace

double Coverage::percent() const {
  return 100 * static_cast<double>(inside) / static_cast<double>(samples);
}

double Coverage::mean_width() const { return width / static_cast<double>(samples); }

double Coverage::mean_width_percent() const { return 100 * mean_width() / (force_max - force_min); }

void Coverage::add(const Coverage& other) {
  if (other.samples == 0) return;
  force_min = samples ? std::min(force_min, other.force_min) : other.force_min;
  force_max = samples ? std::max(force_max, other.force_max) : other.force_max;
  samples += other.samples;
  inside += other.inside;
  width += other.width;
}

const RecordResult* Evaluation::worst_covered() const {
  const RecordResult* worst = nullptr;
  for (const RecordResult& r : records)
    if (r.coverage.samples && (!worst || r.coverage.percent() < worst->coverage.percent()))
      worst = &r;
  return worst;
}

std::vector<DamperInput> damper_inputs(const Record& record, DriveUnit drive_unit) {
  const std::vector<double>& velocity = record.channel("velocity").samples;
  const std::vector<double> drive = drive_samples(record, drive_unit);
  const Channel* displacement = record.find("displacement");
  std::vector<DamperInput> inputs(record.size());
  for (std::size_t k = 0; k < inputs.size(); ++k)
    inputs[k] = {displacement ? displacement->samples[k] : 0.0, velocity[k], drive[k]};
  return inputs;
}

DriveRange drive_range(const std::vector<Record>& records, DriveUnit drive_unit) {
  require_known_drive(records, drive_unit);
  DriveRange range;
  std::vector<double> samples, levels;
  for (const Record& record : records) {
    const std::vector<double> drive = drive_samples(record, drive_unit);
    samples.insert(samples.end(), drive.begin(), drive.end());
    if (record.drive_level)
      levels.push_back(*record.drive_level);
    else
      range.varies = true;
  }
  if (samples.empty()) return range;

  std::sort(samples.begin(), samples.end());
  std::sort(levels.begin(), levels.end());
  range.levels =
      static_cast<std::size_t>(std::unique(levels.begin(), levels.end()) - levels.begin());

  // Half a per cent at either end is left out where the drive varies.
  const std::size_t margin = range.varies ? samples.size() / 200 : 0;
  range.low = samples[margin];
  range.high = samples[samples.size() - 1 - margin];
  return range;
}

Domain domain_of(const std::vector<Record>& records, DriveUnit drive_unit) {
  const DriveRange drive = drive_range(records, drive_unit);
  Domain domain{INFINITY, -INFINITY, INFINITY, -INFINITY, drive.low, drive.high};
  for (const Record& record : records)
    for (const DamperInput& input : damper_inputs(record, drive_unit)) {
      domain.displacement_min = std::min(domain.displacement_min, input.displacement);
      domain.displacement_max = std::max(domain.displacement_max, input.displacement);
      domain.velocity_min = std::min(domain.velocity_min, input.velocity);
      domain.velocity_max = std::max(domain.velocity_max, input.velocity);
    }
  return domain;
}

FreeRun free_run(const DamperModel& model, const std::vector<DamperInput>& inputs,
                 const std::vector<double>& time) {
  FreeRun run;
  if (inputs.empty()) return run;
  run.force.resize(inputs.size());
  if (model.is_ensemble()) run.spread.resize(inputs.size());

  // From rest at the first sample to the last force that is usable.
  std::vector<double> state(model.state_size());
  model.rest(inputs.front(), state);
  const std::size_t usable =
      model.run(inputs, {.time = time.data()}, state,
                {run.force.data(), run.spread.empty() ? nullptr : run.spread.data()});
  if (usable == inputs.size()) return run;

  // Diverged: what follows is no force.
  run.diverged_at = time[usable];
  for (std::vector<double>* values : {&run.force, &run.spread})
    std::fill(values->begin() + static_cast<std::ptrdiff_t>(std::min(usable, values->size())),
              values->end(), kNaN);
  return run;
}

Evaluation evaluate(const DamperModel& model, const std::vector<Record>& records,
                    DriveUnit drive_unit, const EvaluateOptions& options) {
  require_known_drive(records, drive_unit);
  for (const Record& record : records)
    if (model.needs_displacement() && !record.find("displacement"))
      throw Error(record.name, "has no displacement, which " + model.name() + " needs",
                  "record it, or use a model of velocity and current only");
  std::vector<RecordResult> results(records.size());
  parallel_for(records.size(), options.threads, [&](std::size_t k) {
    results[k] = evaluate_record(model, records[k], drive_unit, options);
  });
  return summarise(std::move(results));
}

std::size_t take_off_inertia(const ModelFile& file, Dataset& dataset) {
  std::size_t changed = 0;
  for (Record& record : dataset.records)
    if (const double mass = file.moving_mass - record.moving_mass; mass > 0)
      changed += take_off_inertia(record, mass);
  return changed;
}

Evaluation pool(const std::vector<Evaluation>& evaluations) {
  std::vector<RecordResult> records;
  for (const Evaluation& evaluation : evaluations)
    records.insert(records.end(), evaluation.records.begin(), evaluation.records.end());
  return summarise(std::move(records));
}

}  // namespace dashpot
