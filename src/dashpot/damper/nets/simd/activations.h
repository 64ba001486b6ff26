#pragma once
#include "dashpot/damper/nets/activation.h"
#include "dashpot/damper/nets/simd/intrinsics.h"

namespace dashpot {
namespace {

/// Hyperbolic tangent within a few units in the last place, odd to the last bit, without branches.
///   x = k ln 2 / 2 + z,  |z| <= ln 2 / 4,  p = 2^k:  tanh(k ln 2 / 2) = (p - 1) / (p + 1),  and
///   tanh z = z N(z^2) / D(z^2), so far down Lambert's continued fraction that the rest rounds
///   away.
/// The addition theorem makes one fraction of the two.
template <class Real>
inline Lanes<Real> tanh_lanes(Lanes<Real> x) {
  using A = Arithmetic<Real>;
  using V = Lanes<Real>;
  using I = typename LaneTypes<Real>::Integers;
  static_assert(sizeof(I) == sizeof(V), "an exponent is made in the integer under its number");
  constexpr Real kTwoLog2E = static_cast<Real>(2.88539008177792681472);
  // Adding it rounds, and leaves k + kBias in the last bits.
  constexpr Real kRound = A::kRound + A::kBias;
  const V y = -larger(V{} - A::kTanhOne, -larger(V{} - A::kTanhOne, x));  // a NaN passes

  // Split off k, and make 2^k by moving k + bias into the exponent. z in two steps keeps its
  // digits.
  const V shifted = y * kTwoLog2E + kRound;
  const V k = shifted - kRound;
  const V p = __builtin_bit_cast(V, __builtin_bit_cast(I, shifted) << A::kMantissa);
  const V z = (y - k * (A::kLn2High / 2)) - k * (A::kLn2Low / 2);

  // N and D: the continued fraction to z^3 / z^2 in float, to z^5 / z^6 in double.
  const V square = z * z;
  V numerator, denominator;
  if constexpr (sizeof(Real) == sizeof(float)) {
    numerator = z * (square + 15);
    denominator = square * 6 + 15;
  } else {
    numerator = z * ((square * 21 + 1260) * square + 10395);
    denominator = ((square + 210) * square + 4725) * square + 10395;
  }

  // tanh(a + z) = (tanh a + tanh z) / (1 + tanh a tanh z), as one fraction.
  const V less = p - 1, more = p + 1;
  return (less * denominator + more * numerator) / (more * denominator + less * numerator);
}

/// Activations that only bound a sum below: products do it in passing.
constexpr bool is_bound(Activation kind) {
  return kind == Activation::Identity || kind == Activation::Relu;
}

template <Activation kKind, class Real>
inline Lanes<Real> activated(Lanes<Real> sum) {
  if constexpr (kKind == Activation::Relu)
    return larger(Lanes<Real>{}, sum);  // a NaN passes
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
    for (std::size_t k = 0; k < count; k += kLanes<Real>)
      store(at + k, activated<kKind, Real>(load(at + k)));
}
template <Activation kKind, class Real>
void deactivate(Real* deltas, const Real* values, std::size_t count) {
  if constexpr (kKind != Activation::Identity)
    for (std::size_t k = 0; k < count; k += kLanes<Real>)
      store(deltas + k, through<kKind, Real>(load(values + k), load(deltas + k)));
}

}  // namespace
}  // namespace dashpot
