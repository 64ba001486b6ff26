#include "dashpot/damper/force_band.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr int kVersion = 1;
constexpr double kMostRecords = 1e9;

std::vector<double> read_ascending(const Value& value) {
  std::vector<double> numbers = value.as_numbers();
  if (std::ranges::adjacent_find(numbers, std::greater_equal()) != numbers.end())
    throw Error(value.where(), "is not in order", "write ascending numbers, each once");
  return numbers;
}

/// Linear between the knots, constant beyond them.
double between_knots(const std::vector<double>& knots, const double* values, double at) {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(knots, at) - knots.begin());
  if (next == 0) return values[0];
  if (next == knots.size()) return values[next - 1];
  const double share = (at - knots[next - 1]) / (knots[next] - knots[next - 1]);
  return values[next - 1] + share * (values[next] - values[next - 1]);
}

}  // namespace

double ForceBand::half_width_at(const DamperInput& input, double members_spread) const noexcept {
  const double speed = std::abs(input.velocity);
  const auto band =
      static_cast<std::size_t>(std::ranges::upper_bound(speeds, speed) - speeds.begin());
  const double width = between_knots(drives, &half_width[band * drives.size()], input.current);
  return spread > 0 ? std::hypot(width, spread * members_spread) : width;
}

ForceBand ForceBand::scaled(double factor) const {
  ForceBand band = *this;
  for (double& width : band.half_width) width *= factor;
  band.spread *= factor;
  return band;
}

Value to_json(const ForceBand& band) {
  Value value = Value::object({{"version", kVersion},
                               {"level", band.level},
                               {"records", band.records},
                               {"speeds", Value::array(band.speeds)},
                               {"drives", Value::array(band.drives)},
                               {"half_width_N", Value::array(band.half_width)}});
  if (band.spread > 0) value.add("spread", band.spread);
  return value;
}

ForceBand read_force_band(const Value& value) {
  ObjectReader reader(value, "an interval");
  if (const Value& version = reader.required("version"); version.as_number() != kVersion)
    throw Error(version.where(), "is another version of the interval", "write 1");

  // Read its parts.
  ForceBand band;
  band.level = reader.number("level");
  const double records = reader.number("records");
  if (!(records >= 0 && records <= kMostRecords))
    throw Error(value.where(), "records is " + format_number(records), "a number of recordings");
  band.records = static_cast<std::size_t>(records);
  band.speeds = read_ascending(reader.required("speeds"));
  band.drives = read_ascending(reader.required("drives"));
  const Value& widths = reader.required("half_width_N");
  band.half_width = widths.as_numbers();
  if (const Value* spread = reader.optional("spread")) {
    band.spread = spread->as_number();
    if (!(band.spread > 0))
      throw Error(spread->where(), "is not positive", "leave it out for a single model");
  }
  reader.finish();

  // Check that they fit together.
  if (!(band.level > 0 && band.level < 1))
    throw Error(value.where(), "level is not between 0 and 1");
  if (band.drives.empty() ||
      band.half_width.size() != (band.speeds.size() + 1) * band.drives.size())
    throw Error(widths.where(), "has not one width per band of speed and knot of drive");
  if (std::ranges::any_of(band.half_width, [](double width) { return !(width > 0); }))
    throw Error(widths.where(), "a width is not positive");
  return band;
}

}  // namespace dashpot
