#pragma once
#include <string>
#include <vector>

#include "dashpot/record/readers/tdms_segments.h"

namespace dashpot {

/// The steps from raw to physical values that properties NI_Scale[n]_... state: lines, polynomials,
/// tables, sums and differences of each other.
class TdmsScale {
 public:
  /// Of the first of these sets of properties (the channel's, the group's, the root's) that states
  /// any; nothing is done where none does. Throws Error(file, ...) on properties that are missing.
  static TdmsScale of(const std::vector<const TdmsProperties*>& sets, const std::string& file);

  /// Why it cannot be applied: a kind that is not read. "" when it can.
  const std::string& unread() const { return unread_; }
  bool empty() const { return steps_.empty(); }
  double operator()(double raw) const;

 private:
  struct Step {
    enum class Kind { Raw, Polynomial, Table, Add, Subtract } kind = Kind::Raw;
    std::size_t input = 0, second = 0;  ///< steps; kRaw: the raw value
    std::vector<double> numbers;        ///< coefficients, or raw and scaled values in turn
  };

  std::vector<Step> steps_;
  std::string unread_;
};

}  // namespace dashpot
