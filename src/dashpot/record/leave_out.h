#pragma once
#include <string>
#include <vector>

namespace dashpot {

/// How records are left out to judge a model: always whole stretches of time, never samples picked
/// at random, since neighbouring samples of a recording know each other.
struct LeaveOut {
  enum class By {
    Condition,  ///< one motion after the other
    Current,    ///< one drive level after the other
    Record,     ///< one record after the other
    Fraction,   ///< the end of every record
    Roles,      ///< the parts to which the dataset file gives the role "left_out"
    Each        ///< one combination of the conditions named in `values` after the other
  };
  By by = By::Condition;
  /// Which of them: levels (as texts), conditions or names of records. Empty: each one; for Current
  /// each inner level, since a model is not asked to extrapolate in current. For Each: names of
  /// conditions of the records, gap or viscosity; records that agree in all of them are left out
  /// together.
  std::vector<std::string> values;
  double fraction = 0.3;  ///< Fraction: share of every record's end that is left out, in (0, 1)
};

/// From "current", "current=0.87,1.98", "fraction=0.33", "each=gap,pole_length". Throws Error on an
/// unknown way and on values that it does not take.
LeaveOut parse_leave_out(const std::string& text);
/// The text that parse_leave_out reads back as the same.
std::string format_leave_out(const LeaveOut& leave_out);

}  // namespace dashpot
