#include "dashpot/damper/nets/mlp_evaluator.h"

#include <algorithm>
#include <cassert>

namespace dashpot {

Mlp on_raw_inputs(Mlp mlp) {
  const std::size_t inputs = mlp.layers[0], outputs = mlp.layers[1];
  double* weight = mlp.parameters.data();
  double* const biases = weight + inputs * outputs;
  for (std::size_t n = 0; n < outputs; ++n)
    for (std::size_t i = 0; i < inputs; ++i, ++weight) {
      *weight /= mlp.input_scale[i];
      biases[n] -= *weight * mlp.input_mean[i];
    }
  return mlp;
}

template <class Real>
MlpEvaluator<Real>::MlpEvaluator(const Mlp& mlp, SimdLevel level)
    : one_kernel_(kernel<Real>(std::min(level, SimdLevel::Avx2))),
      many_kernel_(kernel<Real>(level)),
      single_(on_raw_inputs(mlp), 0, level),
      many_(on_raw_inputs(mlp)),
      output_mean_(static_cast<Real>(mlp.output_mean)),
      output_scale_(static_cast<Real>(mlp.output_scale)) {
  assert(mlp.layers.back() == 1 &&
         *std::max_element(mlp.layers.begin(), mlp.layers.end()) <= kMaxWidth);
}

template <class Real>
Real MlpEvaluator<Real>::evaluate(const Real* input) const noexcept {
  return output_mean_ + output_scale_ * one_kernel_.respond(single_.layers().data(),
                                                            single_.layers().size(), input);
}

template <class Real>
void MlpEvaluator<Real>::evaluate(std::span<const Real> inputs,
                                  std::span<Real> outputs) const noexcept {
  constexpr std::size_t kBeyond =
      kKernelAlign / sizeof(Real);  // what the kernel may read behind a block
  alignas(kKernelAlign) Real room[2 * kRoomRows * kBlock];
  alignas(kKernelAlign) Real last[kMaxWidth * kBlock + kBeyond];

  const std::size_t width = single_.inputs();
  assert(inputs.size() == outputs.size() * width);
  for (std::size_t first = 0; first < outputs.size(); first += kBlock) {
    // The kernel takes whole blocks and reads a little beyond them: the last ones come from a copy
    // with zeros behind.
    const std::size_t size = std::min(kBlock, outputs.size() - first);
    const Real* raw = inputs.data() + first * width;
    if (first * width + kBlock * width + kBeyond > inputs.size()) {
      std::fill_n(std::copy_n(raw, size * width, last), (kBlock - size) * width + kBeyond, Real{0});
      raw = last;
    }

    const Real* result = many_kernel_.evaluate(many_.layers.data(), many_.layers.size(), raw, room);
    Real* const to = outputs.data() + first;
    const Real mean = output_mean_, scale = output_scale_;  // which the loop cannot change
    for (std::size_t s = 0; s < size; ++s) to[s] = mean + scale * result[s];
  }
}

template class MlpEvaluator<float>;
template class MlpEvaluator<double>;

}  // namespace dashpot
