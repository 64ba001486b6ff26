#include "dashpot/identify/one_sensor_fit.h"

#include <algorithm>

#include "dashpot/damper/registry.h"

namespace dashpot {
namespace {

constexpr std::size_t kEnoughSamples = 12000;  // of a fit; far more samples tell 61 weights nothing new
constexpr double kLeastRate = 270;  // Hz, for models that integrate: 18 samples in a period at 15 Hz
constexpr std::size_t kStretches = 60,
                      kStretch = 300;  // parts of a record for delayed samples, and their length

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

/// Of samples that a fit can do without: of a model without a memory any, of one with states those beyond a
/// rate that shows the motion.
std::size_t stride_of(const std::vector<Record>& records, std::size_t wanted, std::string_view kind) {
  if (wanted < 2 || kind == "network") return std::max<std::size_t>(wanted, 1);
  double rate = 0;
  for (const Record& record : records)
    if (record.sample_time > 0) rate = std::max(rate, 1 / record.sample_time);
  return std::clamp<std::size_t>(static_cast<std::size_t>(rate / kLeastRate), 1, wanted);
}

}  // namespace

StudiedFit studied_fit(const StudiedModel& model, const std::vector<Record>& training,
                       IdentifyOptions options) {
  const std::string_view kind = model_info(model.model).kind;
  options.network = model.design;
  options.starts = kind == "narx" ? 1 : 2;
  std::size_t samples = 0;
  for (const Record& record : training) samples += record.size();
  if (kind == "narx") {
    if (training.size() > 1 || samples < 2 * kStretches * kStretch) return {training, options};
    options.offset = OffsetMode::None;  // one record has one zero, whatever it is cut into
    return {stretches_of(training.front()), options};
  }
  const std::size_t stride = stride_of(training, samples / kEnoughSamples, kind);
  std::vector<Record> thinned;
  for (const Record& record : training) thinned.push_back(stride == 1 ? record : every_kth(record, stride));
  return {std::move(thinned), options};
}

StudiedResult judge(const FitReport& fit, const Fold& fold, const std::string& drive_unit) {
  StudiedResult result;
  result.parameters = fit.model->parameter_count();
  result.seconds = fit.seconds;
  Evaluation judged = evaluate(*fit.model, fold.left_out, drive_unit,
                               {.offset = OffsetMode::Record, .known_offsets = fit.offsets, .threads = 1});
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
