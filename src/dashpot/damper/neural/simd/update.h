#pragma once
#include "dashpot/damper/neural/kernel.h"

namespace dashpot {
namespace {

template <Optimiser kKind, class Real>
inline void update_as(const UpdateRule<Real>& rule, std::size_t count, Real* __restrict weights,
                      const Real* __restrict gradient, Real* __restrict mean, Real* __restrict square) {
  const UpdateRule<Real> r = rule;  // a copy that the stores below cannot change
  for (std::size_t k = 0; k < count; ++k) {
    const Real w = weights[k];
    const Real sign = (w > 0 ? Real{1} : Real{0}) - (w < 0 ? Real{1} : Real{0});
    const Real g = gradient[k] + r.l2 * w + r.l1 * sign;
    Real step = g;
    if constexpr (kKind == Optimiser::Momentum) step = mean[k] = r.momentum * mean[k] + g;
    if constexpr (kKind == Optimiser::Adam || kKind == Optimiser::AdamW)
      step = mean[k] = r.momentum * mean[k] + (1 - r.momentum) * g;
    if constexpr (kKind != Optimiser::Sgd && kKind != Optimiser::Momentum) {
      square[k] = r.mean_square * square[k] + (1 - r.mean_square) * g * g;
      step /= (sizeof(Real) == sizeof(float) ? __builtin_sqrtf(square[k]) : __builtin_sqrt(square[k])) +
              r.epsilon;
    }
    weights[k] = w - r.decay * w - r.rate * step;
  }
}

template <class Real>
void update(const UpdateRule<Real>& rule, std::size_t count, Real* weights, const Real* gradient, Real* mean,
            Real* square) noexcept {
  switch (rule.optimiser) {
    case Optimiser::Sgd:
      return update_as<Optimiser::Sgd>(rule, count, weights, gradient, mean, square);
    case Optimiser::Momentum:
      return update_as<Optimiser::Momentum>(rule, count, weights, gradient, mean, square);
    case Optimiser::RmsProp:
      return update_as<Optimiser::RmsProp>(rule, count, weights, gradient, mean, square);
    case Optimiser::Adam:
    case Optimiser::AdamW:
      return update_as<Optimiser::Adam>(rule, count, weights, gradient, mean, square);
  }
}

}  // namespace
}  // namespace dashpot
