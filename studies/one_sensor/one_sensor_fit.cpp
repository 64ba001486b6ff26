#include "studies/one_sensor/one_sensor_fit.h"

#include <algorithm>

#include "dashpot/damper/registry.h"

namespace dashpot {
namespace {

constexpr std::size_t kEnoughSamples = 12000;  // of a fit; 61 weights gain nothing from far more
constexpr double kLeastRate = 270;  // Hz, of models that integrate: 18 samples of a 15 Hz period
constexpr std::size_t kParts = 20;  // of a record with states
constexpr double kRunIn = 0.3;      // s
// Delayed samples are learnt from so many stretches of a record, of so many samples each.
constexpr std::size_t kStretches = 60, kStretch = 300;

Record every_kth(const Record& record, std::size_t k) {
  const auto thinned = [k](const std::vector<double>& samples) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < samples.size(); i += k) kept.push_back(samples[i]);
    return kept;
  };
  Record result = record.slice(0, 0);
  result.time = thinned(record.time);
  for (std::size_t c = 0; c < record.channels.size(); ++c)
    result.channels[c].samples = thinned(record.channels[c].samples);
  result.sample_time = record.sample_time * static_cast<double>(k);
  result.warm_up = record.warm_up / k;
  return result;
}

/// Stretches at the record's own rate, evenly over it.
std::vector<Record> stretches_of(const Record& record) {
  std::vector<Record> parts;
  for (std::size_t k = 0; k < kStretches; ++k) {
    const std::size_t first =
        record.warm_up + k * (record.size() - record.warm_up - kStretch) / (kStretches - 1);
    parts.push_back(record.slice(first, first + kStretch));
    parts.back().name += ", part " + std::to_string(k + 1);
    parts.back().warm_up = 0;
  }
  return parts;
}

/// The record in parts that belong by turns to two conditions, each run in by what comes before it:
/// trials that hold back one of the two know all its currents from the other, also where the
/// current rises slowly.
std::vector<Record> parts_by_turns(const Record& record) {
  // Samples of the run-in at the record's mean rate.
  const std::size_t run_in = static_cast<std::size_t>(kRunIn * static_cast<double>(record.size()) /
                                                      (record.time.back() - record.time.front()));

  // Each part scores its own share of the record and starts early by its run-in.
  std::vector<Record> parts;
  for (std::size_t k = 0; k < kParts; ++k) {
    const std::size_t scored = record.warm_up + k * (record.size() - record.warm_up) / kParts,
                      end = record.warm_up + (k + 1) * (record.size() - record.warm_up) / kParts,
                      first = scored - std::min(scored, std::max(run_in, record.warm_up));

    // Every second part is of the one condition, the others of the other.
    parts.push_back(record.slice(first, end));
    parts.back().name += ", part " + std::to_string(k + 1);
    parts.back().condition = k % 2 ? "every second part" : "the parts between";
    parts.back().drive_level.reset();
    parts.back().warm_up = scored - first;
  }
  return parts;
}

/// The stride k with which every k-th sample is kept: a model without a memory can do without any
/// of the others, one with states only without those beyond a rate that shows the motion.
std::size_t stride_of(const std::vector<Record>& records, std::size_t wanted, ModelKind kind) {
  if (wanted < 2 || kind == ModelKind::Network) return std::max<std::size_t>(wanted, 1);
  double rate = 0;
  for (const Record& record : records)
    if (record.sample_time > 0) rate = std::max(rate, 1 / record.sample_time);
  return std::clamp<std::size_t>(static_cast<std::size_t>(rate / kLeastRate), 1, wanted);
}

bool is_long(const std::vector<Record>& training) {
  return training.size() == 1 && training.front().size() > 2 * kStretches * kStretch;
}

}  // namespace

StudiedFit studied_fit(const StudiedModel& model, const std::vector<Record>& training,
                       IdentifyOptions options) {
  const ModelKind kind = model_info(model.model).kind;
  options.network = model.design;
  options.starts = kind == ModelKind::Network ? 2 : 1;
  // One record has one zero, whatever it is cut into.
  if (is_long(training) && (kind == ModelKind::Narx || kind == ModelKind::HysteresisNetwork))
    options.offset = OffsetMode::None;

  // Delayed samples need the record's own rate: stretches, not every k-th sample.
  if (kind == ModelKind::Narx)
    return {is_long(training) ? stretches_of(training.front()) : training, options};

  // Everything else learns from thinned records.
  std::size_t samples = 0;
  for (const Record& record : training) samples += record.size();
  const std::size_t stride = stride_of(training, samples / kEnoughSamples, kind);
  std::vector<Record> thinned;
  for (const Record& record : training)
    thinned.push_back(stride == 1 ? record : every_kth(record, stride));
  if (kind == ModelKind::HysteresisNetwork && is_long(training))
    thinned = parts_by_turns(thinned.front());
  return {std::move(thinned), options};
}

StudiedResult judge(const FitReport& fit, const Fold& fold, DriveUnit drive_unit) {
  StudiedResult result;
  result.parameters = fit.model->parameter_count();
  result.seconds = fit.seconds;

  // Free run with each record's offset fitted; offsets known from the fit stay.
  Evaluation judged =
      evaluate(*fit.model, fold.left_out, drive_unit,
               {.offset = OffsetMode::Record, .known_offsets = fit.offsets, .threads = 1});

  // Sums over the records, their forces, and the first divergence.
  for (RecordResult& record : judged.records) {
    if (record.one_step.n > 0) {
      if (!result.one_step) result.one_step.emplace();
      result.one_step->add(record.one_step);
    }
    if (record.diverged_at && !result.diverged_at) result.diverged_at = record.diverged_at;
    result.sums.add(record.sums);
    result.forces.push_back(std::move(record.modelled));
  }
  result.metrics = judged.pooled;
  return result;
}

}  // namespace dashpot
