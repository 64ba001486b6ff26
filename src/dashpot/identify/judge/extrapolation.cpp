#include "dashpot/identify/judge/extrapolation.h"

#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kMargin = 0.01;  // of the range: rounding and noise are no extrapolation

struct Quantity {
  std::string name, unit;
  double low, high;
  double DamperInput::* field;
};

std::vector<Quantity> quantities(const DamperModel& model, const Domain& d, DriveUnit drive_unit) {
  std::vector<Quantity> all = {
      {"velocity", "m/s", d.velocity_min, d.velocity_max, &DamperInput::velocity},
      {drive_channel(drive_unit), to_string(drive_unit), d.current_min, d.current_max,
       &DamperInput::current}};
  if (model.needs_displacement())
    all.push_back(
        {"displacement", "m", d.displacement_min, d.displacement_max, &DamperInput::displacement});
  return all;
}

Extrapolation measure(const Quantity& q, const std::vector<std::vector<DamperInput>>& records) {
  const double margin = kMargin * (q.high - q.low);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extrapolation e{q.name, q.unit, q.low, q.high, kInfinity, -kInfinity, 0};
  std::size_t outside = 0, all = 0;
  for (const std::vector<DamperInput>& inputs : records)
    for (const DamperInput& input : inputs) {
      const double value = input.*q.field;
      e.data_low = std::min(e.data_low, value);
      e.data_high = std::max(e.data_high, value);
      if (value < q.low - margin || value > q.high + margin) ++outside;
      ++all;
    }
  e.share = all == 0 ? 0 : static_cast<double>(outside) / static_cast<double>(all);
  return e;
}

}  // namespace

std::vector<Extrapolation> extrapolations(const ModelFile& file, const Dataset& dataset) {
  std::vector<std::vector<DamperInput>> records;
  for (const Record& record : dataset.records)
    records.push_back(damper_inputs(record, dataset.drive_unit));
  return extrapolations(*file.model, file.domain, file.drive_unit, records);
}

std::vector<Extrapolation> extrapolations(const DamperModel& model, const Domain& domain,
                                          DriveUnit drive_unit,
                                          const std::vector<std::vector<DamperInput>>& motions) {
  std::vector<Extrapolation> found;
  for (const Quantity& quantity : quantities(model, domain, drive_unit)) {
    Extrapolation e = measure(quantity, motions);
    if (e.share > 0) found.push_back(std::move(e));
  }
  return found;
}

std::string describe(const Extrapolation& e) {
  const auto range = [&](double low, double high) {
    return format_number(low, 3) + " ... " + format_number(high, 3) + " " + e.unit;
  };
  const int digits = e.share < 0.995 ? 2 : 3;
  return fmt::format(
      "{} % of the samples have a {} outside the model's range {} (the recordings span {}): it "
      "extrapolates there",
      format_number(100 * e.share, digits), e.quantity, range(e.low, e.high),
      range(e.data_low, e.data_high));
}

Value to_json(const std::vector<Extrapolation>& extrapolations) {
  Value list = Value::array();
  for (const Extrapolation& e : extrapolations)
    list.push_back(Value::object({{"quantity", e.quantity},
                                  {"unit", e.unit},
                                  {"low", e.low},
                                  {"high", e.high},
                                  {"data_low", e.data_low},
                                  {"data_high", e.data_high},
                                  {"share", e.share}}));
  return list;
}

std::vector<std::string> outside_family(const Evaluation& evaluation) {
  std::vector<std::string> found;
  for (const RecordResult& r : evaluation.records)
    for (const std::string& what : r.extrapolations)
      if (std::ranges::find(found, what) == found.end()) found.push_back(what);
  return found;
}

void require_same_drive(const ModelFile& file, const Dataset& dataset, const std::string& where) {
  if (file.drive_unit == dataset.drive_unit) return;
  if (file.drive_unit == DriveUnit::None)
    throw Error(where,
                "the model was fitted at one constant, unknown drive, but the recordings are "
                "driven in " +
                    to_string(dataset.drive_unit),
                "state 'drive: none' in a dataset file to judge it on them all the same");
  if (dataset.drive_unit == DriveUnit::None)
    throw Error(where,
                "the model is driven in " + to_string(file.drive_unit) +
                    ", but no drive of the recordings is known",
                "give it in the file names (run_0.5" + to_string(file.drive_unit) +
                    ".csv), in manifest.csv or as 'level:' in a dataset file");
  throw Error(where,
              "the model is driven in " + to_string(file.drive_unit) +
                  ", but the recordings are driven in " + to_string(dataset.drive_unit),
              "a model serves recordings of its own kind of drive");
}

}  // namespace dashpot
