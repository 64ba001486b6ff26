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
  std::vector<double> values;  ///< one of these, all alike

  /// The value below which the share u of all lies, 0 < u < 1.
  double at(double u) const;
  std::string description(
      const std::string& unit) const;  ///< "normal, 400 +- 40 kg, 300 ... 500 kg"
};

/// A list of values; {uniform: [a, b]}, {normal: mean, sd: s}, {lognormal: median, sd: s}: sd in
/// the unit or, for these two, in % of the mean or median; from and to cut a distribution off,
/// which lies within the row's bounds in any case. Throws Error that names file and line.
Distribution read_distribution(const Value& value, const ParameterRow& row);
/// A list of values within the row's bounds.
Distribution read_values(const Value& value, const ParameterRow& row);

}  // namespace dashpot
