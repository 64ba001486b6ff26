// The curves of the page: what every model made of every left-out record, thinned and packed.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "dashpot/report/report_json.h"
#include "dashpot/report/residual.h"
#include "dashpot/report/series.h"

namespace dashpot {

namespace {

constexpr double kSeriesBytes = 4e6;  ///< of the page, for all curves together
constexpr std::size_t kHistogramBins = 41, kLags = 100, kLongestLag = 1000;

/// The results of all models on one record; the first one gives motion and measured force.
struct RecordCurves {
  const RecordResult* first = nullptr;
  std::vector<std::pair<std::string, const RecordResult*>> models;
};

std::vector<RecordCurves> curves_by_record(const Ranking& ranking) {
  std::vector<RecordCurves> curves;
  std::map<std::string, std::size_t> place;
  for (const RankedModel& model : ranking.models)
    for (const RecordResult& result : model.left_out.records) {
      if (result.time.empty() || result.modelled.size() != result.time.size()) continue;
      const auto [found, is_new] = place.try_emplace(result.record, curves.size());
      if (is_new) curves.push_back({&result, {}});
      RecordCurves& here = curves[found->second];
      if (result.time.size() == here.first->time.size())
        here.models.emplace_back(model.name, &result);
    }
  return curves;
}

/// Points per record that keep the page within kSeriesBytes: time takes 4 bytes, all else 2, base64
/// 4/3.
std::size_t points_per_record(const std::vector<RecordCurves>& curves, std::size_t models) {
  const double bytes_per_point = (4.0 + 2.0 * (4.0 + static_cast<double>(models))) * 4 / 3;
  return static_cast<std::size_t>(kSeriesBytes / bytes_per_point /
                                  static_cast<double>(curves.size()));
}

Value pack_if_whole(const std::vector<double>& samples, std::size_t size,
                    const std::vector<std::size_t>& chosen) {
  return samples.size() == size ? pack_int16(samples, chosen) : Value();
}

Value curves_json(const RecordCurves& curves, const std::vector<std::size_t>& chosen) {
  const RecordResult& first = *curves.first;
  const std::size_t size = first.time.size();
  Value modelled = Value::object(), spread = Value::object();
  for (const auto& [name, result] : curves.models) {
    modelled.add(name, pack_int16(result->modelled, chosen));
    if (result->spread.size() == size) spread.add(name, pack_int16(result->spread, chosen));
  }
  return Value::object({{"name", first.record},
                        {"samples", size},
                        {"shown", chosen.size()},
                        {"time", pack_float32(first.time, chosen)},
                        {"displacement", pack_if_whole(first.displacement, size, chosen)},
                        {"velocity", pack_if_whole(first.velocity, size, chosen)},
                        {"drive", pack_if_whole(first.drive, size, chosen)},
                        {"measured", pack_if_whole(first.measured, size, chosen)},
                        {"modelled", std::move(modelled)},
                        {"spread", std::move(spread)}});
}

std::vector<std::size_t> shown_samples(const RecordCurves& curves, std::size_t points) {
  std::vector<std::span<const double>> leading{curves.first->measured};
  if (curves.first->velocity.size() == curves.first->time.size())
    leading.push_back(curves.first->velocity);
  for (const auto& [name, result] : curves.models) leading.push_back(result->modelled);
  return thinned_indices(leading, points);
}

Value residual_json(const RecordResult& result) {
  std::vector<double> residual;
  for (std::size_t i = result.warm_up; i < result.modelled.size(); ++i) {
    const double e = result.measured[i] - result.modelled[i];
    if (std::isfinite(e)) residual.push_back(e);
  }
  const Histogram shares = histogram(residual, kHistogramBins);
  const Autocorrelation correlation = autocorrelation(residual, kLags, kLongestLag);
  const double dt =
      (result.time.back() - result.time.front()) / static_cast<double>(result.time.size() - 1);
  std::vector<double> lags;
  for (const std::size_t lag : correlation.lags) lags.push_back(static_cast<double>(lag) * dt);
  return Value::object(
      {{"record", result.record},
       {"histogram", Value::object({{"low", shares.low},
                                    {"width", shares.width},
                                    {"shares", Value::array(shares.shares)}})},
       {"autocorrelation", Value::object({{"lags", Value::array(lags)},
                                          {"values", Value::array(correlation.values)},
                                          {"band", correlation.band}})}});
}

}  // namespace

Value series_json(const Ranking& ranking) {
  const std::vector<RecordCurves> curves = curves_by_record(ranking);
  Value records = Value::array();
  std::size_t thinned = 0;
  for (const RecordCurves& one : curves) {
    const auto chosen = shown_samples(one, points_per_record(curves, ranking.models.size()));
    thinned += chosen.size() < one.first->time.size();
    records.push_back(curves_json(one, chosen));
  }
  const std::string display =
      (thinned
           ? fmt::format(
                 "Curves of {} of {} records are thinned for display; least and greatest values "
                 "of every stretch are kept.",
                 thinned, curves.size())
           : std::string("Curves show every sample.")) +
      " They are rounded to 1/65534 of their range. Every figure is computed from the full data.";
  return Value::object({{"display", display}, {"records", std::move(records)}});
}

Value residuals_json(const Ranking& ranking) {
  Value models = Value::object();
  for (const RankedModel& model : ranking.models) {
    Value records = Value::array();
    for (const RecordResult& result : model.left_out.records)
      if (result.time.size() > 1 && result.modelled.size() == result.time.size() &&
          result.measured.size() == result.time.size())
        records.push_back(residual_json(result));
    models.add(model.name, std::move(records));
  }
  return models;
}

}  // namespace dashpot
