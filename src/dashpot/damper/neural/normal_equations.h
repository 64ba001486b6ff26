#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dashpot/damper/neural/mlp.h"

namespace dashpot {

/// One quantity at the samples of a block: what the kernel's loops run over.
struct alignas(64) BlockRow {
  static constexpr std::size_t kSize = 128;
  std::array<double, kSize> at{};
};

/// Standardised samples in blocks, ordered by group; a block belongs to one group and is filled up with
/// samples that do not count.
struct SampleBlocks {
  std::size_t inputs = 0, samples = 0;
  /// Price of a group's squared offset per sample, of which a squared residual costs 1. Infinity when the
  /// samples have no groups.
  double offset_decay = 0;
  struct Group {
    std::size_t first = 0, last = 0;  ///< blocks first ... last - 1
    double size = 0;                  ///< samples
  };
  std::vector<Group> groups;
  std::vector<BlockRow> rows;  ///< per block: its inputs, its target, 1 where a sample counts

  /// Share of a group's sums that its offset takes out, per sample.
  double centring(const Group& group) const {
    return group.size > 0 ? 1 / (group.size * (1 + offset_decay)) : 0;
  }
  double offset_price(const Group& group, double offset) const {
    return offset == 0 ? 0 : offset_decay * group.size * offset * offset;
  }
  std::span<const BlockRow> block(std::size_t index) const {
    return std::span(rows).subspan(index * (inputs + 2), inputs + 2);
  }
};
SampleBlocks make_blocks(const Mlp& mlp, const TrainingSamples& samples, double offset_decay);

/// Gauss-Newton system of the residuals r = network + offset of the group - target, standardised units,
/// with the offsets at their best: J and r are centred per group (all but wholly, by offset_decay).
struct NormalEquations {
  double squared_error = 0;      ///< r'r, and the price of the offsets
  std::vector<double> matrix;    ///< J'J, row by row
  std::vector<double> gradient;  ///< J'r
  std::vector<double> offsets;   ///< one per group; 0 without groups
};
NormalEquations normal_equations(const std::vector<std::size_t>& layers, std::span<const double> parameters,
                                 const SampleBlocks& blocks);

/// Its squared_error alone, at a quarter of the price.
double squared_error(const std::vector<std::size_t>& layers, std::span<const double> parameters,
                     const SampleBlocks& blocks);

}  // namespace dashpot
