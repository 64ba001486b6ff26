#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "dashpot/damper/nets/aligned.h"
#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// Standardised samples in blocks of kBlock, ordered by group; a block belongs to one group and is
/// filled up with samples that do not count.
struct SampleBlocks {
  std::size_t inputs = 0, samples = 0;
  /// Price of a group's squared offset per sample, of which a squared residual costs 1. Infinity
  /// when the samples have no groups.
  double offset_decay = 0;
  struct Group {
    std::size_t first = 0, last = 0;  ///< blocks first ... last - 1
    double size = 0;                  ///< samples
  };
  std::vector<Group> groups;
  AlignedVector<double> rows;  ///< per block: its inputs, its target, 1 where a sample counts

  std::size_t blocks() const { return groups.empty() ? 0 : groups.back().last; }
  const double* block(std::size_t index) const {
    return rows.data() + index * (inputs + 2) * kBlock;
  }
  /// Share of a group's sums that its offset takes out, per sample.
  double centring(const Group& group) const {
    return group.size > 0 ? 1 / (group.size * (1 + offset_decay)) : 0;
  }
  double offset_price(const Group& group, double offset) const {
    return offset == 0 ? 0 : offset_decay * group.size * offset * offset;
  }
};
SampleBlocks make_blocks(const Mlp& mlp, const TrainingSamples& samples, double offset_decay);

/// Gauss-Newton system of the residuals r = network + offset of the group - target, standardised
/// units, with the offsets at their best: J and r are centred per group (all but wholly, by
/// offset_decay).
struct NormalEquations {
  double squared_error = 0;      ///< r'r, and the price of the offsets
  std::vector<double> matrix;    ///< J'J, row by row
  std::vector<double> gradient;  ///< J'r
  std::vector<double> offsets;   ///< one per group; 0 without groups
};

/// Errors of a network, r'r and the price of the offsets, with the offsets at their best.
struct GroupedErrors {
  double squared_error = 0;
  std::vector<double> offsets;  ///< one per group; 0 without groups
};
/// Mean square of the residuals alone, the price of the offsets taken out.
double mean_square(double squared_error, std::span<const double> offsets,
                   const SampleBlocks& blocks);
/// The mean offset belongs to the network: moves it into the bias of its output. Returns what is
/// left of each, in raw units.
std::vector<double> take_mean_offset(Mlp& mlp, std::vector<double> offsets);

/// A network with one output on the blocks. Sums go over fixed stretches of blocks, then over
/// those, so that they do not depend on the number of threads.
class BlockErrors {
 public:
  BlockErrors(const Mlp& mlp, const SampleBlocks& blocks, int threads,
              SimdLevel level = simd_levels().back());
  /// `activations`: what errors() or squared_error() left at the same parameters; null: they are
  /// computed.
  NormalEquations normal_equations(std::span<const double> parameters,
                                   AlignedVector<double>* activations = nullptr) const;
  /// Its squared_error and offsets alone, at a fraction of the price. Leaves its activations, when
  /// that pays.
  GroupedErrors errors(std::span<const double> parameters,
                       AlignedVector<double>* activations = nullptr) const;
  double squared_error(std::span<const double> parameters,
                       AlignedVector<double>* activations = nullptr) const;

 private:
  const Mlp& mlp_;
  const SampleBlocks& blocks_;
  int threads_;
  const JacobianKernel& kernel_;
};

}  // namespace dashpot
