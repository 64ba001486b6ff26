#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "dashpot/damper/nets/aligned.h"
#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// Samples as the Jacobian kernel wants them: standardised, in blocks of kBlock, ordered by group.
/// A block belongs to one group and is filled up with samples that do not count. Each block is
/// inputs + 2 rows of kBlock numbers:
///
///   row 0 ... inputs - 1   the samples' inputs
///   row inputs             their targets
///   row inputs + 1         1 where a sample counts, 0 where it only fills the block
struct SampleBlocks {
  std::size_t inputs = 0, samples = 0;
  /// Weight of a group's squared offset, per sample of it, beside a squared residual's 1. Infinity
  /// when the samples have no groups, which leaves no offsets.
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
  /// Share of a group's sums that its best offset takes out, per sample.
  double centring(const Group& group) const {
    return group.size > 0 ? 1 / (group.size * (1 + offset_decay)) : 0;
  }
  /// The penalty that an offset of the group adds to the squared error.
  double offset_penalty(const Group& group, double offset) const {
    return offset == 0 ? 0 : offset_decay * group.size * offset * offset;
  }
};
/// Standardises by the scales of `mlp` and copies; `samples` need not live on.
SampleBlocks make_blocks(const Mlp& mlp, const TrainingSamples& samples, double offset_decay);

/// Gauss-Newton system of the residuals r = network + offset of the group - target, in standardised
/// units, for n parameters. The offsets are at their best: J and r are centred per group (not quite
/// wholly, by offset_decay).
struct NormalEquations {
  double squared_error = 0;      ///< r'r and the penalty on the offsets
  std::vector<double> matrix;    ///< J'J, n x n, symmetric
  std::vector<double> gradient;  ///< J'r, n
  std::vector<double> offsets;   ///< one per group; 0 without groups
};

/// Errors of a network, r'r and the penalty on the offsets, with the offsets at their best.
struct GroupedErrors {
  double squared_error = 0;
  std::vector<double> offsets;  ///< one per group; 0 without groups
};
/// Mean square of the residuals alone, without the penalty on the offsets.
double mean_square(double squared_error, std::span<const double> offsets,
                   const SampleBlocks& blocks);
/// The mean offset belongs to the network: moves it into the bias of its output. Returns what is
/// left of each, in raw units.
std::vector<double> take_mean_offset(Mlp& mlp, std::vector<double> offsets);

/// Evaluates a network with one output on the blocks. Sums go over eight fixed stretches of blocks,
/// then over these in order, so that not a bit depends on the number of threads. `mlp` gives layers
/// and activations, not parameters; it and `blocks` must outlive the object.
class BlockErrors {
 public:
  BlockErrors(const Mlp& mlp, const SampleBlocks& blocks, int threads,
              SimdLevel level = simd_levels().back());
  /// `activations`: what errors() or squared_error() left at the same parameters; null: they are
  /// computed.
  NormalEquations normal_equations(std::span<const double> parameters,
                                   AlignedVector<double>* activations = nullptr) const;
  /// Its squared_error and offsets alone, at a fraction of the time. Leaves its activations in
  /// `activations` where fetching them costs less than computing them again, else empties it.
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
