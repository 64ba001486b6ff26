#pragma once
#include <array>
#include <span>
#include <vector>

#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/nets/free_run_record.h"
#include "dashpot/identify/fit/law_unknowns.h"
#include "dashpot/numerics/least_squares.h"
#include "dashpot/record/trial_parts.h"
#include "dashpot/split.h"

namespace dashpot {

/// The signals of a law's network at the scored samples, row by row: HybridSource::read, no mixing
/// yet.
struct SignalRows {
  std::size_t width = 0, currents = 0;
  std::size_t force = 0;  ///< the place of the law's force
  std::vector<double> values;
  std::size_t motions() const { return width - currents; }
  const double* row(std::size_t k) const { return values.data() + k * width; }
  std::size_t size() const { return values.empty() ? 0 : values.size() / width; }
};

/// Each signal less what those before it tell, scaled to deviation 1; silent where next to nothing
/// is left.
SignalMixing mixing_of(const SignalRows& rows);

/// One sample as the network sees it.
using SignalPoint = std::array<double, SignalMixing::kMost>;
SignalPoint standardised(const SignalMixing& mixing, const GatedNetwork& network,
                         const double* raw);
/// Weights: those of the neurons, then of the gates.
GatedNetwork with_weights(GatedNetwork network, std::span<const double> weights);

/// The data and the settings that all fits of a hybrid share.
struct HybridData {
  LawUnknowns unknowns;
  HysteresisBank bank;
  std::vector<FreeRunRecord> records;
  OffsetMode offset = OffsetMode::Record;
};

/// A law with a network on top in free run over parts of records. The unknowns are those of the
/// law, then the network's weights: one least-squares problem, for the law's states feel nothing of
/// the network.
class HybridResiduals {
 public:
  /// Scores every stride-th sample of the parts. With OffsetMode::Record the mean of each part's
  /// residuals is taken out, which eliminates its offset exactly. `data` must outlive this.
  HybridResiduals(const HybridData& data, ScoredParts parts, std::size_t stride);

  /// The number of residuals of the data, without those of decay and priors.
  std::size_t size() const { return size_; }
  /// The law's signals at the scored samples; empty when a record diverges.
  SignalRows signals(std::span<const double> law_unknowns) const;

  /// The network at its start with its scales, and the decay of all unknowns towards their start,
  /// N^2 per squared unit of distance.
  struct Network {
    const SignalMixing& mixing;
    GatedNetwork start;  ///< its ranges of signals do not hold here
    double decay = 0;
    std::vector<bool> fixed;  ///< per weight: stays at its start; empty: none
  };
  /// From the law's unknowns `law_start`, which lie at the size of 1; noise as in
  /// LawResiduals::problem.
  LeastSquaresProblem problem(const Network& network, std::span<const double> law_start,
                              double noise, int threads) const;
  /// The same over the weights alone, with the law's signals as they are.
  LeastSquaresProblem problem(const Network& network, const SignalRows& rows) const;

  /// The residuals of the data at these weights: measured minus modelled force, N.
  void evaluate(const Network& network, const SignalRows& rows, std::span<const double> weights,
                std::span<double> residuals) const;

 private:
  /// Slopes of the signals by one of the law's unknowns; nothing where the records diverge on
  /// either side.
  SignalRows slopes(const SignalRows& here, std::span<const double> law_unknowns,
                    std::size_t unknown) const;
  /// Residuals and their derivatives by the unknowns whose `slopes` are given, then by the weights.
  void linearise(const Network& network, const SignalRows& rows,
                 const std::vector<SignalRows>& slopes, std::span<const double> weights,
                 std::span<double> residuals, std::span<double* const> columns) const;
  void take_means_out(std::span<double> values) const;

  const HybridData& data_;
  const LawUnknowns& unknowns_;
  ScoredParts parts_;
  std::size_t stride_, size_ = 0;
  std::vector<double> force_;  ///< measured, at the scored samples
};

}  // namespace dashpot
