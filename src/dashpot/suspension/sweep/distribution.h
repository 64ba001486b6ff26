#pragma once
#include <limits>
#include <string>
#include <vector>

#include "dashpot/parameter_table.h"
#include "dashpot/value.h"

namespace dashpot {

/// How an input of a sweep varies from vehicle to vehicle.
struct Distribution {
  enum class Kind { Uniform, Normal, LogNormal, OneOf };
  Kind kind = Kind::Uniform;
  double centre = 0;  ///< mean; the median of a log-normal one
  double spread = 0;  ///< standard deviation; of a log-normal one that of the logarithm
  double from = -std::numeric_limits<double>::infinity();  ///< cut off below, and above
  double to = std::numeric_limits<double>::infinity();
  std::vector<double> values;  ///< OneOf: each with the same probability

  /// The value below which a draw lies with probability u, 0 < u < 1.
  double at(double u) const;
  /// "normal, 400 ± 40 kg, within 300 ... 500 kg"
  std::string description(const std::string& unit) const;
};

/// Reads a list of values, {uniform: [a, b]}, {normal: mean, sd: s} or {lognormal: median, sd: s}.
/// sd is in the row's unit or in % of the mean or median; from and to cut the distribution off, and
/// the row's bounds do so in any case. Throws Error that names file and line.
Distribution read_distribution(const Value& value, const ParameterRow& row);
/// Reads a list of values within the row's bounds.
Distribution read_values(const Value& value, const ParameterRow& row);

}  // namespace dashpot
