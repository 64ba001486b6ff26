#include "dashpot/damper/neural/mlp_evaluator.h"

#include <algorithm>
#include <cassert>

namespace dashpot {

template <class Real>
MlpEvaluator<Real>::MlpEvaluator(const Mlp& mlp, SimdLevel level)
    : one_kernel_(kernel<Real>(std::min(level, SimdLevel::Avx2))),
      many_kernel_(kernel<Real>(level)),
      single_(mlp, 0, level),
      many_(mlp),
      input_mean_(mlp.input_mean.begin(), mlp.input_mean.end()),
      output_mean_(static_cast<Real>(mlp.output_mean)),
      output_scale_(static_cast<Real>(mlp.output_scale)) {
  assert(mlp.layers.back() == 1 && *std::max_element(mlp.layers.begin(), mlp.layers.end()) <= kMaxWidth);
  for (const double scale : mlp.input_scale) input_factor_.push_back(static_cast<Real>(1 / scale));
}

template <class Real>
Real MlpEvaluator<Real>::evaluate(const Real* input) const noexcept {
  alignas(kKernelAlign) Real standardised[padded<Real>(kMaxWidth + 1)];
  const std::size_t inputs = input_mean_.size(), step = single_.input_step();
  for (std::size_t k = 0; k < step; k += padded<Real>(1))
    std::fill_n(standardised + k, padded<Real>(1), Real{0});
  for (std::size_t k = 0; k < inputs; ++k) standardised[k] = (input[k] - input_mean_[k]) * input_factor_[k];
  standardised[inputs] = 1;
  Real output;
  one_kernel_.respond(single_.layers().data(), single_.layers().size(), standardised, &output);
  return output_mean_ + output_scale_ * output;
}

template <class Real>
void MlpEvaluator<Real>::evaluate(std::span<const Real> inputs, std::span<Real> outputs) const noexcept {
  alignas(kKernelAlign) Real room[2][(kMaxWidth + 1) * kBlock];
  const std::size_t width = input_mean_.size();
  assert(inputs.size() == outputs.size() * width);
  for (std::size_t first = 0; first < outputs.size(); first += kBlock) {
    const std::size_t size = std::min(kBlock, outputs.size() - first);
    const Real* raw = inputs.data() + first * width;
    for (std::size_t k = 0; k < width; ++k) {
      Real* row = room[0] + k * kBlock;
      for (std::size_t s = 0; s < size; ++s)
        row[s] = (raw[s * width + k] - input_mean_[k]) * input_factor_[k];
      std::fill(row + size, row + kBlock, Real{0});
    }
    std::fill_n(room[0] + width * kBlock, kBlock, Real{1});
    const Real* result = many_kernel_.evaluate(many_.layers.data(), many_.layers.size(), room[0], room[1]);
    for (std::size_t s = 0; s < size; ++s) outputs[first + s] = output_mean_ + output_scale_ * result[s];
  }
}

template class MlpEvaluator<float>;
template class MlpEvaluator<double>;

}  // namespace dashpot
