#pragma once
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/intrinsics.h"

namespace dashpot {
namespace {

// One training step over flat arrays of weights, gradient and moments, all padded with zeros.
//
//   g = gradient + l2 w + l1 sgn w
//   Momentum   step = m,  m = momentum m + g
//   RmsProp    step = g / (sqrt s + epsilon),  s = mean_square s + (1 - mean_square) g^2
//   Adam       step = m / (sqrt s + epsilon),  m = momentum m + (1 - momentum) g
//   w = w - decay w - rate step
//
// AdamW is Adam with `decay`; corrections for the start stand in rate and epsilon already.

/// value / (sqrt(square) + epsilon)
inline Lanes<double> over_root(Lanes<double> value, Lanes<double> square, double epsilon) {
  return value / (root(square) + epsilon);
}
/// The same within a few units in the last place: the root comes from its own unit of the
/// processor, which is then too busy to divide; a step of Newton's method sharpens the estimate of
/// the inverse.
inline Lanes<float> over_root(Lanes<float> value, Lanes<float> square, float epsilon) {
  const Lanes<float> divisor = root(square) + epsilon, inverse = reciprocal_estimate(divisor);
  return value * (inverse * (2 - divisor * inverse));
}

/// The step of one optimiser. kPlain: without any penalty or decay of the weights.
template <Optimiser kKind, bool kPlain, class Real>
void update_as(const UpdateRule<Real>& rule, std::size_t count, Real* weights, const Real* gradient,
               Real* mean, Real* square) {
  constexpr bool kHasMean = kKind != Optimiser::Sgd && kKind != Optimiser::RmsProp;
  constexpr bool kHasSquare = kKind != Optimiser::Sgd && kKind != Optimiser::Momentum;
  const UpdateRule<Real> r = rule;  // a copy, which the stores below cannot change
  const Real share = kKind == Optimiser::Momentum ? Real{1} : 1 - r.momentum;
  for (std::size_t k = 0; k < count; k += kLanes<Real>) {
    const Lanes<Real> w = load(weights + k), none{};
    Lanes<Real> step = load(gradient + k);
    if constexpr (!kPlain) step += r.l2 * w + (w > 0 ? none + r.l1 : w < 0 ? none - r.l1 : none);
    const Lanes<Real> g = step;

    // The moments that this optimiser keeps, and the step that they give.
    if constexpr (kHasMean) store(mean + k, step = r.momentum * load(mean + k) + share * g);
    if constexpr (kHasSquare) {
      const Lanes<Real> average = r.mean_square * load(square + k) + (1 - r.mean_square) * g * g;
      store(square + k, average);
      step = over_root(step, average, r.epsilon);
    }

    store(weights + k, (kPlain ? w : w - r.decay * w) - r.rate * step);
  }
}

template <class Real>
void update(const UpdateRule<Real>& rule, std::size_t count, Real* weights, const Real* gradient,
            Real* mean, Real* square) noexcept {
  const bool plain = rule.l1 == 0 && rule.l2 == 0 && rule.decay == 0;
  const auto as = [&]<Optimiser kKind>() {
    if (plain) return update_as<kKind, true>(rule, count, weights, gradient, mean, square);
    update_as<kKind, false>(rule, count, weights, gradient, mean, square);
  };
  switch (rule.optimiser) {
    case Optimiser::Sgd:
      return as.template operator()<Optimiser::Sgd>();
    case Optimiser::Momentum:
      return as.template operator()<Optimiser::Momentum>();
    case Optimiser::RmsProp:
      return as.template operator()<Optimiser::RmsProp>();
    case Optimiser::Adam:
    case Optimiser::AdamW:
      return as.template operator()<Optimiser::Adam>();
  }
}

}  // namespace
}  // namespace dashpot
