#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// One number of each damper of a population: a parameter, a force at a speed, an error.
struct Quantity {
  std::string name, unit, meaning;
};

/// How a quantity changes over the serial number. Medians of up to 60 blocks of dampers, in the
/// order of their numbers, are what it is told from, so that single dampers have no say.
struct Drift {
  bool is_tested = false;  ///< there are enough dampers, 40 or more
  double slope = 0;        ///< unit per serial number: the median slope of all pairs of blocks
  /// The probability of such an order of the blocks where nothing drifts (Mann and Kendall).
  double probability = 1;
  bool is_seen() const;  ///< probability below 0.001
};

/// What is usual of a quantity.
struct Usual {
  std::size_t count = 0;  ///< dampers that have it
  double median = std::numeric_limits<double>::quiet_NaN();
  /// Robust standard deviations below and above the median: the larger of that from the median
  /// absolute deviation and that from the 10 % or 90 % point, so that a skewed or heavy tail is
  /// not taken for faults. About the drift, where one is seen. 0: it hardly varies and is not
  /// judged.
  double below = 0, above = 0;
  Drift drift;
  double centre = 0;  ///< serial number at which the median is expected
  double expected(double serial) const {
    return drift.is_seen() ? median + drift.slope * (serial - centre) : median;
  }
};

/// A damper that is far off in one quantity.
struct Outlier {
  std::size_t damper = 0, quantity = 0;
  double value = 0, expected = 0;
  double score = 0;  ///< (value - expected) / robust standard deviation
};

struct PopulationReport {
  std::vector<Usual> usual;        ///< by quantity
  std::vector<double> limits;      ///< by quantity, of |score|
  std::vector<Outlier> outliers;   ///< by damper, then by falling |score|
  std::size_t judged = 0;          ///< dampers with at least one judged quantity
  std::size_t judged_columns = 0;  ///< quantities that vary
};

/// Judges each damper against all. columns[q][k]: quantity q of damper k, not a number where it
/// has none. false_alarms: the share of sound dampers that may be flagged, all quantities together,
/// where these are normal: each quantity gets its equal part (Bonferroni), at the point of
/// Student's distribution with 0.37 degrees of freedom per damper, the efficiency of the median
/// absolute deviation. Fewer than 10 dampers are not judged. The order of the dampers does not
/// matter, their serial numbers do.
PopulationReport judge_population(const std::vector<std::vector<double>>& columns,
                                  std::span<const double> serials, double false_alarms);

}  // namespace dashpot
