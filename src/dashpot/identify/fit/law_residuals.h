#pragma once
#include <span>
#include <utility>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/identify/fit/law_unknowns.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

/// How much of each record is used.
struct Thinning {
  double share = 1;        ///< only that first part of it
  std::size_t stride = 1;  ///< every so many samples: for laws without a memory
};

/// Measured minus modelled force in free run over all records, as a function of a law's unknowns.
/// With OffsetMode::Record the mean of each record is taken out, which eliminates its offset
/// exactly. What is known of parameters beforehand follows as one residual each.
class LawResiduals {
 public:
  LawResiduals(const LawUnknowns& unknowns, const std::vector<Record>& records,
               DriveUnit drive_unit, OffsetMode offset, const Thinning& thinning = {});

  /// The number of residuals of the data, without those of priors.
  std::size_t size() const { return size_; }
  /// False when a record diverges.
  bool evaluate(std::span<const double> unknowns, std::span<double> residuals) const;
  /// noise: N, standard deviation of one independent residual, which priors are weighed against; 0:
  /// without the priors.
  LeastSquaresProblem problem(double noise, int threads) const;
  /// First index and length of each record's residuals.
  const std::vector<std::pair<std::size_t, std::size_t>>& segments() const { return segments_; }

 private:
  struct Run {
    std::vector<DamperInput> inputs;
    std::vector<double> time, force;
    std::size_t warm_up;
  };
  bool simulate(const LawModel& model, std::span<double> residuals) const;
  bool jacobian(std::span<const double> unknowns, std::span<double> residuals,
                std::span<double* const> columns, int threads) const;
  bool differences(std::span<const double> unknowns, const LawUnknowns::Group& group,
                   std::span<const double> residuals, std::span<double* const> columns) const;

  const LawUnknowns* unknowns_;
  OffsetMode offset_;
  std::vector<Run> runs_;
  std::vector<std::pair<std::size_t, std::size_t>> segments_;
  std::size_t size_ = 0;
  /// In each record, and no parameter follows from others at another drive.
  bool constant_drive_;
};

}  // namespace dashpot
