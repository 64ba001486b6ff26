#include "dashpot/damper/nets/padded_network.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace dashpot {
namespace {

/// Shares out one array: parts begin on cache lines.
template <class Real>
class Parts {
 public:
  std::size_t take(std::size_t count) {
    const std::size_t at = end_;
    end_ += padded<Real>(count);
    return at;
  }
  std::size_t size() const { return end_; }

 private:
  std::size_t end_ = 0;
};

template <class Real>
NeuronLayer<Real> shape_of(const Mlp& mlp, std::size_t layer, std::size_t samples) {
  NeuronLayer<Real> shape{};
  shape.inputs = mlp.layers[layer - 1];
  shape.outputs = mlp.layers[layer];
  shape.activation = mlp.activation(layer);
  const bool last = layer + 1 == mlp.layers.size();
  shape.in_step = padded<Real>(shape.inputs + 1);
  shape.out_step = last ? padded<Real>(samples) : padded<Real>(shape.outputs + 1);
  shape.columns = last ? shape.in_step : padded<Real>(shape.outputs);
  return shape;
}

/// Fills in counts, ones and bounds of each column: `lanes` has room for three rows of them.
template <class Real>
void describe_lanes(NeuronLayer<Real>& layer, Real* lanes) {
  Real *counts = lanes, *ones = counts + layer.columns, *bounds = ones + layer.columns;
  std::fill_n(counts, layer.outputs, Real{1});
  std::fill_n(
      bounds, layer.columns,
      layer.activation == Activation::Relu ? Real{0} : -std::numeric_limits<Real>::infinity());
  if (layer.outputs < layer.columns) ones[layer.outputs] = bounds[layer.outputs] = 1;
  layer.counts = counts;
  layer.ones = ones;
  layer.bounds = bounds;
}

}  // namespace

template <class Real>
PaddedNetwork<Real>::PaddedNetwork(const Mlp& mlp, std::size_t samples, SimdLevel level)
    : kernel_(kernel<Real>(level)) {
  assert(mlp.layers.size() >= 2);
  for (std::size_t layer = 1; layer < mlp.layers.size(); ++layer)
    layers_.push_back(shape_of<Real>(mlp, layer, samples));
  place_weights();
  assert(place_.size() == Mlp::parameter_count(mlp.layers));
  if (samples > 0) place_passes(samples);
  if (!mlp.parameters.empty()) set_parameters(mlp.parameters);
}

template <class Real>
void PaddedNetwork<Real>::place_weights() {
  Parts<Real> parts, lanes;
  std::vector<std::size_t> starts, lane_starts;
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    // Where each parameter goes: hidden layers input by input, the output layer neuron by neuron.
    const NeuronLayer<Real>& layer = layers_[l];
    const bool last = l + 1 == layers_.size();
    const std::size_t start = parts.take((last ? layer.outputs : layer.inputs + 1) * layer.columns);
    const std::size_t by_neuron = last ? layer.columns : 1, by_input = last ? 1 : layer.columns;
    for (std::size_t n = 0; n < layer.outputs; ++n)
      for (std::size_t i = 0; i < layer.inputs; ++i)
        place_.push_back(start + n * by_neuron + i * by_input);
    for (std::size_t n = 0; n < layer.outputs; ++n)
      place_.push_back(start + n * by_neuron + layer.inputs * by_input);

    starts.push_back(start);
    lane_starts.push_back(lanes.take(last ? 0 : 3 * layer.columns));
  }

  // Only now, when the array has its final size, can layers point into it.
  size_ = parts.size();
  weights_.resize(size_);
  lanes_.resize(lanes.size());
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    layers_[l].weights = weights_.data() + starts[l];
    if (l + 1 < layers_.size()) describe_lanes(layers_[l], lanes_.data() + lane_starts[l]);
  }
}

template <class Real>
void PaddedNetwork<Real>::place_passes(std::size_t samples) {
  const std::size_t rows = padded<Real>(samples);
  gradient_.resize(size_);

  // Share out room: per layer its inputs, deltas and transposed weights, then the network's
  // outputs.
  Parts<Real> squares, parts;
  struct Places {
    std::size_t transposed, in, deltas;
  };
  std::vector<Places> places;
  for (const NeuronLayer<Real>& layer : layers_) {
    const bool last = places.size() + 1 == layers_.size();
    places.push_back({squares.take(padded<Real>(layer.outputs) * padded<Real>(layer.inputs)),
                      parts.take(rows * layer.in_step),
                      parts.take(last ? layer.outputs * layer.out_step : rows * layer.columns)});
  }

  const std::size_t out = parts.take(layers_.back().outputs * layers_.back().out_step);
  transposed_.resize(squares.size());
  passes_.resize(parts.size());

  // Point into it. A layer's outputs are the next one's inputs, and behind the inputs stands the 1
  // that biases meet.
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    NeuronLayer<Real>& layer = layers_[l];
    layer.gradient = gradient_.data() + (layer.weights - weights_.data());
    layer.transposed = transposed_.data() + places[l].transposed;
    layer.in = passes_.data() + places[l].in;
    layer.deltas = passes_.data() + places[l].deltas;
    layer.out = passes_.data() + (l + 1 < layers_.size() ? places[l + 1].in : out);
    for (std::size_t r = 0; r < rows; ++r) layer.in[r * layer.in_step + layer.inputs] = 1;
  }
}

template <class Real>
void PaddedNetwork<Real>::set_parameters(std::span<const double> parameters) {
  assert(parameters.size() == place_.size());
  for (std::size_t k = 0; k < place_.size(); ++k)
    weights_[place_[k]] = static_cast<Real>(parameters[k]);
  transposed_from_ = kNone;
}

template <class Real>
void PaddedNetwork<Real>::get_parameters(std::span<double> parameters) const {
  for (std::size_t k = 0; k < place_.size(); ++k) parameters[k] = weights_[place_[k]];
}

template <class Real>
void PaddedNetwork<Real>::get_gradient(std::span<double> gradient) const {
  for (std::size_t k = 0; k < place_.size(); ++k) gradient[k] = gradient_[place_[k]];
}

template <class Real>
void PaddedNetwork<Real>::backward(std::size_t samples, Real* by_inputs) {
  const std::size_t first = by_inputs ? 0 : 1;  // the way back ends there
  if (first < transposed_from_) kernel_.transpose(layers_.data() + first, layers_.size() - first);
  transposed_from_ = std::min(first, transposed_from_);
  kernel_.backward(layers_.data(), layers_.size(), samples, by_inputs);
}

template <class Real>
void PaddedNetwork<Real>::update(const UpdateRule<Real>& rule, AlignedVector<Real>& mean,
                                 AlignedVector<Real>& square) {
  kernel_.update(rule, size_, weights_.data(), gradient_.data(), mean.data(), square.data());
  transposed_from_ = kNone;
}

template class PaddedNetwork<float>;
template class PaddedNetwork<double>;

}  // namespace dashpot
