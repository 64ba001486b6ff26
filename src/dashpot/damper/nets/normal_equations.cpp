#include "dashpot/damper/nets/normal_equations.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/nets/sample_layers.h"

namespace dashpot {
namespace {

constexpr std::size_t kStretches = 8;  // of blocks: as many threads can share the work
static_assert(kBlock % padded<double>(1) == 0, "each row of a block begins on a cache line");

/// More activations than this are quicker computed again than fetched from memory.
constexpr std::size_t kMostKept = std::size_t{1} << 20;

std::size_t activations_per_block(const SampleLayers<double>& layers) {
  std::size_t rows = 0;
  for (const SampleLayer<double>& layer : layers.layers) rows += layer.outputs;
  return rows * kBlock;
}

/// The buffers with which one thread goes over blocks, and the description of them for the kernel.
class Workspace {
 public:
  /// `kept`: room for the activations of all blocks, or null.
  Workspace(const SampleLayers<double>& layers, const SampleBlocks& samples, double* kept)
      : samples_(samples), kept_(kept) {
    const std::size_t parameters = layers.weights.size();
    blocks_ = {layers.layers.data(), layers.layers.size(), parameters,
               padded<double>(parameters + 1)};
    if (kept) {
      blocks_.activation_step = activations_per_block(layers);
    } else {
      activations_.resize(activations_per_block(layers));
      blocks_.activations = activations_.data();
    }
  }

  /// Makes room for the Jacobians of kBlocksAtOnce blocks, `columns` rows of kBlock numbers each.
  /// The kernel fills the rows of parameters and residual; those that pad them stay zero.
  void prepare_jacobian() {
    blocks_.passed = kept_;
    const std::size_t size = blocks_.columns * kBlock, used = (blocks_.parameters + 1) * kBlock;
    jacobian_.reset(CacheLineAllocator<double>().allocate(kBlocksAtOnce * size));
    blocks_.jacobian = jacobian_.get();
    for (std::size_t k = 0; k < kBlocksAtOnce; ++k)
      std::fill_n(&jacobian_[k * size + used], size - used, 0.0);
  }

  /// Points the description at some blocks.
  const JacobianBlocks& take(std::size_t first, std::size_t blocks) {
    blocks_.rows = samples_.block(first);
    blocks_.blocks = blocks;
    if (kept_) blocks_.activations = kept_ + first * blocks_.activation_step;
    return blocks_;
  }

 private:
  struct Free {
    void operator()(double* at) const { CacheLineAllocator<double>().deallocate(at, 0); }
  };
  const SampleBlocks& samples_;
  double* kept_;
  AlignedVector<double> activations_;
  std::unique_ptr<double[], Free> jacobian_;  // no vector: to zero all of it each time takes long
  JacobianBlocks blocks_{};
};

/// Sums over a stretch of blocks.
struct Stretch {
  std::size_t first = 0, last = 0;  // blocks
  AlignedVector<double> products;   // columns x columns
  // Groups x columns; for the error alone, groups x (sum, sum of squares)
  AlignedVector<double> by_group;
};

std::vector<Stretch> make_stretches(std::size_t blocks) {
  std::vector<Stretch> stretches(std::min(kStretches, std::max<std::size_t>(1, blocks)));
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    stretches[k].first = k * blocks / stretches.size();
    stretches[k].last = (k + 1) * blocks / stretches.size();
  }
  return stretches;
}

/// Calls visit(group, first, count) for the blocks of a stretch, up to kBlocksAtOnce of a group
/// each time.
template <class Visit>
void for_blocks(const SampleBlocks& blocks, const Stretch& stretch, Visit visit) {
  for (std::size_t g = 0; g < blocks.groups.size(); ++g) {
    const std::size_t last = std::min(stretch.last, blocks.groups[g].last);
    for (std::size_t b = std::max(stretch.first, blocks.groups[g].first); b < last;
         b += kBlocksAtOnce)
      visit(g, b, std::min(kBlocksAtOnce, last - b));
  }
}

/// The stretches' sums by group, added in order.
AlignedVector<double> sums_by_group(const std::vector<Stretch>& stretches) {
  AlignedVector<double> total = stretches.front().by_group;
  for (std::size_t k = 1; k < stretches.size(); ++k)
    for (std::size_t j = 0; j < total.size(); ++j) total[j] += stretches[k].by_group[j];
  return total;
}

/// Adds the stretches up to [J r]' [J r] of all samples, (n + 1) x (n + 1), takes out of it what
/// the free offsets take up, and cuts it into matrix, gradient and error.
NormalEquations combine(const std::vector<Stretch>& stretches, const SampleBlocks& blocks,
                        std::size_t n) {
  const std::size_t columns = padded<double>(n + 1);
  const AlignedVector<double> by_group = sums_by_group(stretches);

  // The upper triangle: per pair of columns the sum over the stretches, less the groups' shares.
  std::vector<double> products((n + 1) * (n + 1));
  for (std::size_t a = 0; a <= n; ++a)
    for (std::size_t b = a; b <= n; ++b) {
      double& product = products[a * (n + 1) + b];
      for (const Stretch& stretch : stretches) product += stretch.products[a * columns + b];
      for (std::size_t g = 0; g < blocks.groups.size(); ++g) {
        const double* sums = &by_group[g * columns];
        product -= blocks.centring(blocks.groups[g]) * sums[a] * sums[b];
      }
    }

  // The last column is the residual's.
  NormalEquations equations;
  equations.matrix.resize(n * n);
  for (std::size_t a = 0; a < n; ++a) {
    equations.gradient.push_back(products[a * (n + 1) + n]);
    for (std::size_t b = a; b < n; ++b)
      equations.matrix[a * n + b] = equations.matrix[b * n + a] = products[a * (n + 1) + b];
  }
  equations.squared_error = products.back();
  for (std::size_t g = 0; g < blocks.groups.size(); ++g)
    equations.offsets.push_back(-blocks.centring(blocks.groups[g]) * by_group[g * columns + n]);
  return equations;
}

}  // namespace

SampleBlocks make_blocks(const Mlp& mlp, const TrainingSamples& samples, double offset_decay) {
  const std::size_t inputs = mlp.layers.front(), count = samples.targets.size();
  SampleBlocks blocks;
  blocks.inputs = inputs;
  blocks.samples = count;

  // The samples of each group, in their order; without groups all are one.
  const bool grouped = !samples.group.empty();
  blocks.offset_decay = grouped ? offset_decay : std::numeric_limits<double>::infinity();
  std::vector<std::vector<std::size_t>> members(grouped ? samples.groups : 1);
  for (std::size_t i = 0; i < count; ++i) members[grouped ? samples.group[i] : 0].push_back(i);

  // Lay each group out in blocks of its own: sample m of a group is lane m % kBlock of block
  // m / kBlock. Rows that nothing fills are zero, the row that says which samples count among them.
  const std::size_t stride = (inputs + 2) * kBlock;
  for (const std::vector<std::size_t>& group : members) {
    const std::size_t first = blocks.blocks();
    const std::size_t last = first + (group.size() + kBlock - 1) / kBlock;
    blocks.groups.push_back({first, last, static_cast<double>(group.size())});
    blocks.rows.resize(last * stride);
    for (std::size_t m = 0; m < group.size(); ++m) {
      const std::size_t i = group[m];
      double* at = &blocks.rows[(first + m / kBlock) * stride + m % kBlock];
      for (std::size_t k = 0; k < inputs; ++k)
        at[k * kBlock] = (samples.inputs[i * inputs + k] - mlp.input_mean[k]) / mlp.input_scale[k];
      at[inputs * kBlock] = (samples.targets[i] - mlp.output_mean) / mlp.output_scale;
      at[(inputs + 1) * kBlock] = 1;
    }
  }
  return blocks;
}

double mean_square(double squared_error, std::span<const double> offsets,
                   const SampleBlocks& blocks) {
  for (std::size_t g = 0; g < offsets.size(); ++g)
    squared_error -= blocks.offset_penalty(blocks.groups[g], offsets[g]);
  // Rounding may leave less than nothing; what is not a number stays so.
  return (squared_error < 0 ? 0 : squared_error) / static_cast<double>(blocks.samples);
}

std::vector<double> take_mean_offset(Mlp& mlp, std::vector<double> offsets) {
  const double mean =
      std::accumulate(offsets.begin(), offsets.end(), 0.0) / static_cast<double>(offsets.size());
  mlp.parameters.back() += mean;
  for (double& offset : offsets) offset = mlp.output_scale * (offset - mean);
  return offsets;
}

BlockErrors::BlockErrors(const Mlp& mlp, const SampleBlocks& blocks, int threads, SimdLevel level)
    : mlp_(mlp), blocks_(blocks), threads_(threads), kernel_(jacobian_kernel(level)) {
  assert(mlp.layers.back() == 1);
}

NormalEquations BlockErrors::normal_equations(std::span<const double> parameters,
                                              AlignedVector<double>* activations) const {
  SampleLayers<double> layers(mlp_);
  layers.set_parameters(parameters);
  const std::size_t columns = padded<double>(parameters.size() + 1);

  // Each stretch adds up its products and, per group with an offset, its sums of columns.
  std::vector<Stretch> stretches = make_stretches(blocks_.blocks());
  parallel_for(stretches.size(), threads_, [&](std::size_t k) {
    Workspace work(layers, blocks_,
                   activations && !activations->empty() ? activations->data() : nullptr);
    work.prepare_jacobian();
    stretches[k].products.resize(columns * columns);
    stretches[k].by_group.resize(blocks_.groups.size() * columns);
    for_blocks(blocks_, stretches[k], [&](std::size_t group, std::size_t first, std::size_t count) {
      const bool centred = blocks_.centring(blocks_.groups[group]) > 0;
      kernel_.add_products(work.take(first, count), stretches[k].products.data(),
                           centred ? &stretches[k].by_group[group * columns] : nullptr);
    });
  });
  return combine(stretches, blocks_, parameters.size());
}

GroupedErrors BlockErrors::errors(std::span<const double> parameters,
                                  AlignedVector<double>* activations) const {
  SampleLayers<double> layers(mlp_);
  layers.set_parameters(parameters);

  // Keep the activations for normal_equations() where that pays.
  if (activations) {
    const std::size_t size = blocks_.blocks() * activations_per_block(layers);
    activations->resize(size <= kMostKept ? size : 0);
  }

  std::vector<Stretch> stretches = make_stretches(blocks_.blocks());
  parallel_for(stretches.size(), threads_, [&](std::size_t k) {
    Workspace work(layers, blocks_,
                   activations && !activations->empty() ? activations->data() : nullptr);
    stretches[k].by_group.resize(2 * blocks_.groups.size());
    for_blocks(blocks_, stretches[k], [&](std::size_t group, std::size_t first, std::size_t count) {
      kernel_.add_errors(work.take(first, count), &stretches[k].by_group[2 * group]);
    });
  });

  // Per group the sum of its residuals gives the best offset, which lowers the sum of the squares.
  const AlignedVector<double> sums = sums_by_group(stretches);
  GroupedErrors errors;
  for (std::size_t g = 0; g < blocks_.groups.size(); ++g) {
    errors.offsets.push_back(-blocks_.centring(blocks_.groups[g]) * sums[2 * g]);
    errors.squared_error += sums[2 * g + 1] + errors.offsets[g] * sums[2 * g];
  }
  return errors;
}

double BlockErrors::squared_error(std::span<const double> parameters,
                                  AlignedVector<double>* activations) const {
  return errors(parameters, activations).squared_error;
}

}  // namespace dashpot
