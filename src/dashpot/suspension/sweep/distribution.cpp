#include "dashpot/suspension/sweep/distribution.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

constexpr const char* kForms =
    "{uniform: [a, b]}, {normal: mean, sd: s}, {lognormal: median, sd: s} or a list of values";

double normal_share(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// The value of a standard normal variable, cut off at low and high, below which it lies with
/// probability u.
double normal_between(double low, double high, double u) {
  // Computed from the lower tail, where probabilities keep their digits.
  if (low > 0) return -normal_between(-high, -low, 1 - u);
  const double share = normal_share(low) + u * (normal_share(high) - normal_share(low));
  return std::clamp(normal_quantile(share), low, high);
}

std::string with_unit(double value, const std::string& unit) {
  return format_plain(value) + (unit == "1" ? "" : " " + unit);
}

double read_within(const Value& value, const ParameterRow& row) {
  return checked(row, read_quantity(value, row.unit), value.where());
}

double positive(double number, const Value& at, const ParameterRow& row) {
  if (number > 0) return number;
  throw Error(
      at.where(),
      "the spread of " + std::string(row.name) + " is " + with_unit(number, std::string(row.unit)),
      "above 0");
}

/// "5 %" of `whole`, or a quantity.
double read_spread(const Value& value, const ParameterRow& row, double whole) {
  const bool relative =
      value.kind() == Value::Kind::String && trim(value.as_string()).ends_with('%');
  const double number =
      relative ? std::abs(whole) * parse_quantity(value.as_string(), "1", value.where())
               : read_quantity(value, row.unit);
  return positive(number, value, row);
}

void read_uniform(const Value& value, const ParameterRow& row, Distribution& distribution) {
  if (value.items().size() != 2)
    throw Error(value.where(), "has " + std::to_string(value.items().size()) + " ends",
                "two: uniform: [from, to]");
  distribution.from = read_within(value.items()[0], row);
  distribution.to = read_within(value.items()[1], row);
}

void read_bell(ObjectReader& reader, const Value& centre, const ParameterRow& row,
               Distribution& d) {
  d.centre = read_within(centre, row);
  const Value& spread = reader.required("sd");
  d.spread = read_spread(spread, row, d.centre);
  if (d.kind == Distribution::Kind::LogNormal) {
    if (!(d.centre > 0)) throw Error(centre.where(), "a log-normal median that is not above 0");
    // The stated sd is that of the values near the median: turn it into that of their logarithm.
    d.spread = std::sqrt(std::log1p(d.spread * d.spread / (d.centre * d.centre)));
  }

  // Cut off at the row's bounds, or closer.
  d.from = row.lower;
  d.to = row.upper;
  if (const Value* from = reader.optional("from")) d.from = read_within(*from, row);
  if (const Value* to = reader.optional("to")) d.to = read_within(*to, row);
}

void require_wide(const Distribution& d, const Value& value, const ParameterRow& row) {
  const std::string unit(row.unit);
  if (!(d.from < d.to))
    throw Error(value.where(),
                "the range of " + std::string(row.name) + " is empty: " + with_unit(d.from, unit) +
                    " to " + with_unit(d.to, unit),
                "from less than to");
  if (d.kind == Distribution::Kind::Normal &&
      (d.from > d.centre + 6 * d.spread || d.to < d.centre - 6 * d.spread))
    throw Error(value.where(), "is cut off where the distribution has no values",
                "from and to within 6 sd of the mean");
  if (row.whole)
    throw Error(value.where(), std::string(row.name) + " is a whole number", "a list of values");
}

}  // namespace

double Distribution::at(double u) const {
  switch (kind) {
    case Kind::Uniform:
      return from + u * (to - from);
    case Kind::Normal:
      return std::clamp(
          centre + spread * normal_between((from - centre) / spread, (to - centre) / spread, u),
          from, to);
    case Kind::LogNormal: {
      const double low = from > 0 ? std::log(from / centre) / spread : -INFINITY;
      return std::clamp(
          centre * std::exp(spread * normal_between(low, std::log(to / centre) / spread, u)), from,
          to);
    }
    case Kind::OneOf:
      break;
  }

  const auto count = static_cast<double>(values.size());
  return values[static_cast<std::size_t>(std::min(u * count, count - 1))];
}

std::string Distribution::description(const std::string& unit) const {
  const std::string range = format_plain(from) + " ... " + with_unit(to, unit);
  if (kind == Kind::Uniform) return "uniform, " + range;
  if (kind == Kind::Normal)
    return "normal, " + format_plain(centre) + " ± " + with_unit(spread, unit) + ", within " +
           range;
  if (kind == Kind::LogNormal)
    return "log-normal, median " + with_unit(centre, unit) + ", factor " +
           format_number(std::exp(spread)) + ", within " + range;
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(format_plain(value));
  return "one of " + join(texts, ", ") + (unit == "1" ? "" : " " + unit);
}

Distribution read_values(const Value& value, const ParameterRow& row) {
  Distribution distribution{.kind = Distribution::Kind::OneOf};
  for (const Value& item : value.items()) distribution.values.push_back(read_within(item, row));
  if (distribution.values.empty())
    throw Error(value.where(), "no " + std::string(row.name) + " to choose from",
                "a list of values");
  return distribution;
}

Distribution read_distribution(const Value& value, const ParameterRow& row) {
  if (value.kind() == Value::Kind::Array) return read_values(value, row);
  if (value.kind() != Value::Kind::Object)
    throw Error(value.where(), "does not say how " + std::string(row.name) + " varies", kForms);

  // The key names the kind; what is left over is unknown.
  ObjectReader reader(value, "a distribution");
  Distribution distribution;
  if (const Value* ends = reader.optional("uniform")) {
    read_uniform(*ends, row, distribution);
  } else if (const Value* mean = reader.optional("normal")) {
    distribution.kind = Distribution::Kind::Normal;
    read_bell(reader, *mean, row, distribution);
  } else if (const Value* median = reader.optional("lognormal")) {
    distribution.kind = Distribution::Kind::LogNormal;
    read_bell(reader, *median, row, distribution);
  } else {
    reader.finish();
    throw Error(value.where(), "does not say how " + std::string(row.name) + " varies", kForms);
  }
  reader.finish();
  require_wide(distribution, value, row);
  return distribution;
}

}  // namespace dashpot
