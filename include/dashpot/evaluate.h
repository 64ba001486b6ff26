// Layer: identify
#pragma once

// Judging a model on records: it runs free, seeing motion and drive only, and its force is compared
// with the measured one. The same figures, with the same names, stand in every report. Models and
// records stay the caller's.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/dataset.h"
#include "dashpot/drive.h"
#include "dashpot/value.h"

namespace dashpot {

struct ModelFile;

/// Errors of a modelled force against a measured one. Several records pool by adding sums.
struct ErrorSums {
  std::size_t n = 0;
  double squared = 0, absolute = 0, largest = 0;   ///< of e = measured - modelled
  double force = 0, force_squared = 0, error = 0;  ///< sums of F, F^2, e
  double force_min = 0, force_max = 0;             ///< N
  void add(double measured, double modelled);
  void add(const ErrorSums& other);
  double force_variation() const;  ///< sum of (F - mean F)^2
};

/// The errors of a model, every figure by its name (TC-11 in docs/sources.md).
struct Metrics {
  std::size_t samples = 0;
  double rmse = 0;           ///< N
  double rms_half_span = 0;  ///< %, 200 rmse / (Fmax - Fmin): what the one-sensor paper prints
  double rms_span = 0;       ///< %, 100 rmse / (Fmax - Fmin)
  double nrmse_max = 0;      ///< %, 100 rmse / max |F|
  double esr = 0;            ///< %, 100 sum e^2 / sum (F - mean F)^2, a power ratio
  double r2 = 0;             ///< 1 - esr
  double rrse = 0;           ///< sqrt(esr)
  double fit = 0;            ///< %, 100 (1 - rrse)
  double vaf = 0;            ///< %, 100 (1 - var e / var F)
  double mae = 0;            ///< N
  double max_error = 0;      ///< N
};
Metrics metrics(const ErrorSums& sums);
Value to_json(const Metrics& metrics);

/// Energy dissipated, J: integral of F v dt by the trapezoidal rule.
double dissipated_energy(std::span<const double> time, std::span<const double> velocity,
                         std::span<const double> force);

/// The record's motion and drive as the model sees them. Throws Error naming the missing channel.
/// A record without displacement gives 0 there.
std::vector<DamperInput> damper_inputs(const Record& record, DriveUnit drive_unit);

/// The range of the drive of these records, A or V: all of it when it is constant in each, else the
/// middle 99 % of its samples, so that spikes at switching do not stretch the range.
struct DriveRange {
  double low = 0, high = 0;
  bool varies = false;     ///< within a record
  std::size_t levels = 0;  ///< distinct constant levels
};
DriveRange drive_range(const std::vector<Record>& records, DriveUnit drive_unit);

/// The range of motion and drive of these records.
Domain domain_of(const std::vector<Record>& records, DriveUnit drive_unit);

/// Force over a record in free run: the model sees motion and current only. From rest at the first
/// sample. `diverged_at`: time of the first force that is not finite or out of the model's range;
/// what follows is NaN.
struct FreeRun {
  std::vector<double> force;          ///< N, one per sample
  std::vector<double> spread;         ///< N, of an ensemble's members; empty for a single model
  std::optional<double> diverged_at;  ///< s
};
FreeRun free_run(const DamperModel& model, const std::vector<DamperInput>& inputs,
                 const std::vector<double>& time);

/// How the force zero of a record (gas, load cell) is treated.
enum class OffsetMode {
  Record,  ///< one free offset per record: a declared nuisance, printed
  None     ///< the model's own bias must do
};

/// The share of the scored samples that a band covers, and its width.
struct Coverage {
  std::size_t samples = 0, inside = 0;
  double width = 0;                     ///< N, sum over the samples
  double force_min = 0, force_max = 0;  ///< N
  double percent() const;               ///< not a number without samples
  double mean_width() const;            ///< N
  double mean_width_percent() const;    ///< of the force span
  void add(const Coverage& other);
};

/// A model on one record.
struct RecordResult {
  std::string record, condition;
  std::optional<double> drive_level;
  bool left_out = false;
  std::size_t warm_up = 0;
  double offset = 0;               ///< N, added to the model's force
  Metrics metrics;                 ///< with the offset
  Metrics metrics_without_offset;  ///< the model as it stands in its file
  ErrorSums sums, sums_without_offset;
  std::vector<std::string> extrapolations;  ///< DamperModel::extrapolations of the model there
  /// With measured forces fed back; without samples where the model feeds none back.
  ErrorSums one_step;
  double energy_error = 0;  ///< %, of the energy dissipated per record
  std::optional<double> diverged_at;
  std::optional<ForceBand> band;  ///< around the modelled force
  Coverage coverage;              ///< of that band
  std::vector<double> time, displacement, velocity, drive, measured, modelled;  ///< offset included
  std::vector<double> spread;                                                   ///< as FreeRun
  double spread_at(std::size_t sample) const { return spread.empty() ? 0 : spread[sample]; }
};

/// The samples in one band of speed.
struct BandResult {
  std::string name;          ///< "|v| < 5 % of max (pre-yield)"
  double low = 0, high = 0;  ///< m/s
  Metrics metrics;
};

/// The samples at one level of the drive, or in a quarter of its range where it varies within
/// records.
struct DriveResult {
  double low = 0, high = 0;  ///< A or V; equal: a constant level
  Metrics metrics;
};

/// A model on all records of an evaluation.
struct Evaluation {
  std::vector<RecordResult> records;
  Metrics pooled;  ///< all samples of all scored records
  Metrics pooled_without_offset;
  /// Of a model that feeds its force back, with measured forces fed back: no measure of its worth.
  std::optional<Metrics> one_step;
  // These leave records out whose force hardly changes: a share of next to nothing tells nothing.
  double worst_esr = 0;  ///< %, worst record
  std::string worst_record;
  double mean_esr = 0;             ///< %, mean over the records
  double mean_energy_error = 0;    ///< %, mean over the records of its magnitude
  std::vector<BandResult> bands;   ///< by |v|: pre-yield, low, middle, high
  std::vector<DriveResult> drive;  ///< by drive, ascending
  Coverage coverage;               ///< of the records' bands; without samples: none has a band
  /// The record with the least coverage; null without bands. Points into `records`.
  const RecordResult* worst_covered() const;
  std::size_t diverged = 0;
};

/// The outcome of driving a model beyond its data.
struct StressRun {
  double seconds = 0;        ///< simulated; 0: not run
  bool finite = false;       ///< the force was a number all along
  double largest_share = 0;  ///< largest |F| over the force span of the data
  bool is_bounded() const;   ///< finite, and within kStressSpans spans
};

/// Whether a model forgets the state in which it began. Runs of one motion, from rest and from
/// states that the model met elsewhere in the data, must meet.
struct Forgetting {
  bool is_tested = false;  ///< a model without a state has nothing to forget
  double seconds = 0;      ///< until the last two runs had met, as far as they did
  double share_left = 0;   ///< force between them after the time allowed, over the span of the data
  std::string record;      ///< whose motion it was; empty where nothing was left
  bool is_forgotten() const;  ///< not tested, or share_left within kForgottenShare
};

/// How evaluate() treats offsets and bands. Records whose offset is known, by name, keep it: an
/// offset learnt on the training part of a record serves its left-out part; of several parts, their
/// mean.
struct EvaluateOptions {
  OffsetMode offset = OffsetMode::Record;
  std::vector<std::pair<std::string, double>> known_offsets;
  std::optional<ForceBand> band = std::nullopt;  ///< to be judged too
  int threads = 0;                               ///< 0: as many as the machine has
};
/// Takes off the forces the inertia that was taken off those which the model was fitted to, as far
/// as it is not off them already. Returns how many records it changed: all but those, and those
/// without an acceleration.
std::size_t take_off_inertia(const ModelFile& file, Dataset& dataset);

/// Runs the model freely over each record, from rest, and scores it from the record's warm-up on.
/// Throws Error where a record lacks a channel that the model needs.
Evaluation evaluate(const DamperModel& model, const std::vector<Record>& records,
                    DriveUnit drive_unit, const EvaluateOptions& options = {});

/// Several evaluations (one per fold) as one.
Evaluation pool(const std::vector<Evaluation>& evaluations);

}  // namespace dashpot
