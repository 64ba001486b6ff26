#pragma once
#include "dashpot/damper/neural/activation.h"
#include "dashpot/damper/neural/simd/lanes.h"

namespace dashpot {
namespace {

template <Activation kKind, class Real>
inline Lanes<Real> activated(Lanes<Real> sum) {
  if constexpr (kKind == Activation::Relu)
    return Lanes<Real>{} > sum ? Lanes<Real>{} : sum;  // a NaN passes
  else if constexpr (kKind == Activation::Tanh)
    return tanh_lanes<Real>(sum);
  else if constexpr (kKind == Activation::Sigmoid)
    return Real{0.5} + Real{0.5} * tanh_lanes<Real>(Real{0.5} * sum);
  else
    return sum;
}

/// `delta` times the derivative of the activation, which follows from its value.
template <Activation kKind, class Real>
inline Lanes<Real> through(Lanes<Real> value, Lanes<Real> delta) {
  if constexpr (kKind == Activation::Relu)
    return value > 0 ? delta : Lanes<Real>{};
  else if constexpr (kKind == Activation::Tanh)
    return delta - delta * value * value;
  else if constexpr (kKind == Activation::Sigmoid)
    return delta * (value - value * value);
  else
    return delta;
}

/// Calls run.operator()<kind>().
template <class Run>
inline void with_activation(Activation kind, Run run) {
  switch (kind) {
    case Activation::Identity:
      return run.template operator()<Activation::Identity>();
    case Activation::Relu:
      return run.template operator()<Activation::Relu>();
    case Activation::Tanh:
      return run.template operator()<Activation::Tanh>();
    case Activation::Sigmoid:
      return run.template operator()<Activation::Sigmoid>();
  }
}

/// In place; `count` is a multiple of the padding.
template <Activation kKind, class Real>
void activate(Real* at, std::size_t count) {
  if constexpr (kKind != Activation::Identity)
    for (std::size_t k = 0; k < count; k += kLanes<Real>) store(at + k, activated<kKind, Real>(load(at + k)));
}
template <Activation kKind, class Real>
void deactivate(Real* deltas, const Real* values, std::size_t count) {
  if constexpr (kKind != Activation::Identity)
    for (std::size_t k = 0; k < count; k += kLanes<Real>)
      store(deltas + k, through<kKind, Real>(load(values + k), load(deltas + k)));
}

}  // namespace
}  // namespace dashpot
