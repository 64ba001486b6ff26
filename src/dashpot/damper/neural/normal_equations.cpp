#include "dashpot/damper/neural/normal_equations.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

#include "dashpot/damper/neural/tanh.h"

// The block kernels are compiled once per instruction set and chosen when the program starts. `flatten`
// draws the helpers in, so that they are compiled for the same set.
#if defined(__x86_64__)
#define DASHPOT_KERNEL __attribute__((flatten, target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define DASHPOT_KERNEL
#endif

namespace dashpot {
namespace {

constexpr std::size_t kTile = 3;  // rows of a tile of J'J: 9 sums and 6 operands fit 16 registers

/// What one block needs besides its samples; allocated once per pass.
struct Workspace {
  std::vector<BlockRow> activations;  // of all layers, inputs first
  std::vector<BlockRow> jacobian;     // a row per parameter, then the residual, then zeros up to a whole tile
  std::vector<double> gram;           // jacobian * jacobian' of one group, upper triangle of tiles
  std::size_t parameters = 0;

  explicit Workspace(const std::vector<std::size_t>& layers)
      : activations(std::accumulate(layers.begin(), layers.end(), std::size_t{0})),
        parameters(Mlp::parameter_count(layers)) {
    jacobian.resize((parameters + 1 + kTile - 1) / kTile * kTile);
    gram.resize(jacobian.size() * jacobian.size());
  }
  double gram_at(std::size_t a, std::size_t b) const {
    return gram[std::min(a, b) * jacobian.size() + std::max(a, b)];
  }
};

void add_scaled(BlockRow& sum, double factor, const BlockRow& row) {
  for (std::size_t s = 0; s < BlockRow::kSize; ++s) sum.at[s] += factor * row.at[s];
}

/// Fills the activations, and returns those of the output.
const BlockRow& forward(const std::vector<std::size_t>& layers, const double* parameters,
                        std::span<const BlockRow> block, std::vector<BlockRow>& activations) {
  BlockRow* from = activations.data();
  std::copy_n(block.begin(), layers.front(), from);
  for (std::size_t layer = 1; layer < layers.size(); ++layer) {
    const std::size_t inputs = layers[layer - 1], outputs = layers[layer];
    BlockRow* to = from + inputs;
    const double* bias = parameters + inputs * outputs;
    for (std::size_t n = 0; n < outputs; ++n, parameters += inputs) {
      to[n].at.fill(bias[n]);
      for (std::size_t i = 0; i < inputs; ++i) add_scaled(to[n], parameters[i], from[i]);
      if (layer + 1 < layers.size())
        for (double& value : to[n].at) value = branchless_tanh(value);
    }
    parameters = bias + outputs;
    from = to;
  }
  return *from;
}

/// Fills the rows of the Jacobian, last layer first. The derivative by a neuron's bias is the derivative
/// by its input sum, from which those by its weights and by the layer before follow.
void backward(const std::vector<std::size_t>& layers, const double* parameters, Workspace& work) {
  std::size_t after = work.parameters;
  const BlockRow* to = &work.activations.back();
  for (std::size_t layer = layers.size() - 1; layer > 0; --layer) {
    const std::size_t inputs = layers[layer - 1], outputs = layers[layer];
    const std::size_t bias = after - outputs, weights = bias - inputs * outputs;
    const BlockRow* from = to - inputs;
    for (std::size_t n = 0; n < outputs; ++n)
      for (std::size_t i = 0; i < inputs; ++i)
        for (std::size_t s = 0; s < BlockRow::kSize; ++s)
          work.jacobian[weights + n * inputs + i].at[s] = work.jacobian[bias + n].at[s] * from[i].at[s];
    for (std::size_t i = 0; layer > 1 && i < inputs; ++i) {
      BlockRow& delta = work.jacobian[weights - inputs + i];
      delta.at.fill(0);
      for (std::size_t n = 0; n < outputs; ++n)
        add_scaled(delta, parameters[weights + n * inputs + i], work.jacobian[bias + n]);
      for (std::size_t s = 0; s < BlockRow::kSize; ++s) delta.at[s] *= 1 - from[i].at[s] * from[i].at[s];
    }
    after = weights;
    to = from;
  }
}

using Lanes = double __attribute__((vector_size(32)));

void add_tile(const BlockRow* a, const BlockRow* b, double* gram, std::size_t stride) {
  constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(double);
  Lanes sum[kTile][kTile] = {};
  for (std::size_t s = 0; s < BlockRow::kSize; s += kLanes) {
    Lanes left[kTile], right[kTile];
    for (std::size_t i = 0; i < kTile; ++i) {
      std::memcpy(&left[i], &a[i].at[s], sizeof(Lanes));
      std::memcpy(&right[i], &b[i].at[s], sizeof(Lanes));
    }
    for (std::size_t i = 0; i < kTile; ++i)
      for (std::size_t j = 0; j < kTile; ++j) sum[i][j] += left[i] * right[j];
  }
  for (std::size_t i = 0; i < kTile; ++i)
    for (std::size_t j = 0; j < kTile; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) gram[i * stride + j] += sum[i][j][lane];
}

/// Adds one block to the Gram matrix of [J r].
DASHPOT_KERNEL void add_block(const std::vector<std::size_t>& layers, const double* parameters,
                              std::span<const BlockRow> block, Workspace& work) {
  const BlockRow& output = forward(layers, parameters, block, work.activations);
  const BlockRow& target = block[layers.front()];
  const BlockRow& counts = block[layers.front() + 1];
  work.jacobian[work.parameters - 1] = counts;  // the bias of the output: samples that do not count vanish
  BlockRow& residual = work.jacobian[work.parameters];
  for (std::size_t s = 0; s < BlockRow::kSize; ++s)
    residual.at[s] = (output.at[s] - target.at[s]) * counts.at[s];
  backward(layers, parameters, work);
  const std::size_t rows = work.jacobian.size();
  for (std::size_t a = 0; a < rows; a += kTile)
    for (std::size_t b = a; b < rows; b += kTile)
      add_tile(&work.jacobian[a], &work.jacobian[b], &work.gram[a * rows + b], rows);
}

/// Adds one block's sum and sum of squares of the residuals.
DASHPOT_KERNEL void add_errors(const std::vector<std::size_t>& layers, const double* parameters,
                               std::span<const BlockRow> block, std::vector<BlockRow>& activations,
                               std::array<double, 2>& sums) {
  constexpr std::size_t kLanes = 8;
  const BlockRow& output = forward(layers, parameters, block, activations);
  const BlockRow& target = block[layers.front()];
  const BlockRow& counts = block[layers.front() + 1];
  double sum[kLanes] = {}, squares[kLanes] = {};
  for (std::size_t s = 0; s < BlockRow::kSize; s += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double r = (output.at[s + lane] - target.at[s + lane]) * counts.at[s + lane];
      sum[lane] += r;
      squares[lane] += r * r;
    }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    sums[0] += sum[lane];
    sums[1] += squares[lane];
  }
}

/// Adds a group's Gram matrix, less what a free offset takes out of it. The derivative by the bias of the
/// output is 1, so that its row holds the group's sums.
void add_group(const Workspace& work, double centring, NormalEquations& equations) {
  const std::size_t n = work.parameters, ones = n - 1;
  const auto entry = [&](std::size_t a, std::size_t b) {
    return work.gram_at(a, b) - centring * work.gram_at(ones, a) * work.gram_at(ones, b);
  };
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) equations.matrix[a * n + b] += entry(a, b);
    equations.gradient[a] += entry(a, n);
  }
  equations.squared_error += entry(n, n);
  equations.offsets.push_back(-centring * work.gram_at(ones, n));
}

}  // namespace

SampleBlocks make_blocks(const Mlp& mlp, const TrainingSamples& samples, double offset_decay) {
  const std::size_t inputs = mlp.layers.front(), count = samples.targets.size();
  SampleBlocks blocks;
  blocks.inputs = inputs;
  blocks.samples = count;
  const bool grouped = !samples.group.empty();
  blocks.offset_decay = grouped ? offset_decay : std::numeric_limits<double>::infinity();
  std::vector<std::vector<std::size_t>> members(grouped ? samples.groups : 1);
  for (std::size_t i = 0; i < count; ++i) members[grouped ? samples.group[i] : 0].push_back(i);

  const std::size_t stride = inputs + 2;
  for (const std::vector<std::size_t>& group : members) {
    const std::size_t first = blocks.rows.size() / stride;
    const std::size_t last = first + (group.size() + BlockRow::kSize - 1) / BlockRow::kSize;
    blocks.groups.push_back({first, last, static_cast<double>(group.size())});
    blocks.rows.resize(last * stride);
    for (std::size_t m = 0; m < group.size(); ++m) {
      const std::size_t s = m % BlockRow::kSize, i = group[m];
      BlockRow* block = &blocks.rows[(first + m / BlockRow::kSize) * stride];
      for (std::size_t k = 0; k < inputs; ++k)
        block[k].at[s] = (samples.inputs[i * inputs + k] - mlp.input_mean[k]) / mlp.input_scale[k];
      block[inputs].at[s] = (samples.targets[i] - mlp.output_mean) / mlp.output_scale;
      block[inputs + 1].at[s] = 1;
    }
  }
  return blocks;
}

NormalEquations normal_equations(const std::vector<std::size_t>& layers, std::span<const double> parameters,
                                 const SampleBlocks& blocks) {
  Workspace work(layers);
  NormalEquations equations;
  equations.matrix.assign(parameters.size() * parameters.size(), 0.0);
  equations.gradient.assign(parameters.size(), 0.0);
  for (const SampleBlocks::Group& group : blocks.groups) {
    std::fill(work.gram.begin(), work.gram.end(), 0.0);
    for (std::size_t b = group.first; b < group.last; ++b)
      add_block(layers, parameters.data(), blocks.block(b), work);
    add_group(work, blocks.centring(group), equations);
  }
  return equations;
}

double squared_error(const std::vector<std::size_t>& layers, std::span<const double> parameters,
                     const SampleBlocks& blocks) {
  std::vector<BlockRow> activations(std::accumulate(layers.begin(), layers.end(), std::size_t{0}));
  double total = 0;
  for (const SampleBlocks::Group& group : blocks.groups) {
    std::array<double, 2> sums{};
    for (std::size_t b = group.first; b < group.last; ++b)
      add_errors(layers, parameters.data(), blocks.block(b), activations, sums);
    total += sums[1] - blocks.centring(group) * sums[0] * sums[0];
  }
  return total;
}

}  // namespace dashpot
