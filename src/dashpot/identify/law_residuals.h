#pragma once
#include <span>
#include <utility>
#include <vector>

#include "dashpot/identify/law_unknowns.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

/// Measured minus modelled force in free run over all records, as a function of a law's unknowns. With
/// OffsetMode::Record the mean of each record is taken out, which eliminates its offset exactly.
class LawResiduals {
 public:
  /// `share`: only that first part of each record (1: all), to try starts cheaply.
  LawResiduals(const LawUnknowns& unknowns, const std::vector<Record>& records, std::string_view drive_unit,
               OffsetMode offset, double share = 1);

  std::size_t size() const { return size_; }
  /// False when a record diverges.
  bool evaluate(std::span<const double> unknowns, std::span<double> residuals) const;
  LeastSquaresProblem problem() const;
  /// First index and length of each record's residuals.
  const std::vector<std::pair<std::size_t, std::size_t>>& segments() const { return segments_; }

 private:
  struct Run {
    std::vector<DamperInput> inputs;
    std::vector<double> time, force;
    std::size_t warm_up;
  };
  const LawUnknowns* unknowns_;
  OffsetMode offset_;
  std::vector<Run> runs_;
  std::vector<std::pair<std::size_t, std::size_t>> segments_;
  std::size_t size_ = 0;
};

}  // namespace dashpot
