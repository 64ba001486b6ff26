#pragma once
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

namespace dashpot {
namespace {

/// A network of one layer of tanh neurons, of velocity and perhaps current, as the polynomial of
/// velocity that it is near a velocity v0:
///
///     F(v0 + w) = sum f_k w^k,    f_k = sum over neurons of out_n b_n^k t^(k)(s_n) / k!
///
/// with k = 0 ... kTerms - 1, s_n = bias + weights . [v0, current], b_n the weight of velocity. All
/// derivatives of tanh are polynomials of t = tanh s:
///
///     t' = 1 - t^2                           t''' / 6   = t' (t^2 - 1/3)
///     t'' / 2 = -t t'                        t'''' / 24 = -t t' (t^2 - 2/3)
///                                            t''''' / 120 = t' (t^2 (t^2 - 1) + 2/15)
///
/// so that one exponential and half a division per neuron give all terms: exp(2 s) is the product
/// of one that current gives and one that velocity gives. Real: what the neurons
/// calculate in; of float, a vector holds two neurons of all vehicles.
template <class Real>
class TanhNeurons {
 public:
  static constexpr std::size_t kStates = 0, kTerms = 6;
  using Polynomial = Lane[kTerms];

  explicit TanhNeurons(const LaneRide& ride) {
    // The rows of LaneRide::damper: weights, biases, output weights, its bias; scale and mean.
    const LaneNetwork::Layer& layer = ride.network->layers[0];
    const double *biases = ride.damper + layer.inputs * layer.outputs * kWidth,
                 *out = biases + layer.outputs * kWidth,
                 *scale = out + (layer.outputs + 1) * kWidth;

    // Neuron by neuron, kTogether of them in a vector. Output weights are kept times b_n^k.
    for (std::size_t n = 0; n < layer.outputs; ++n) {
      Neurons& to = neurons_[n / kTogether];
      const std::size_t place = n % kTogether * kWidth;
      put(load(biases + n * kWidth), to.bias, place);
      Lane by_velocity{}, power = load(scale) * load(out + n * kWidth);
      for (std::size_t i = 0; i < layer.inputs; ++i) {
        const Lane weight = load(ride.damper + (n * layer.inputs + i) * kWidth);
        if (ride.network->inputs[i] == LaneInput::Current)
          put(weight, to.by_current, place);
        else
          put(by_velocity = weight, to.by_velocity, place);
      }
      for (std::size_t k = 0; k < kTerms; ++k, power *= by_velocity) put(power, to.out[k], place);
    }

    // Neurons of no weight fill the last vector.
    end_ = neurons_ + (layer.outputs + kTogether - 1) / kTogether;
    mean_ = load(scale) * load(out + layer.outputs * kWidth) + load(scale + kWidth);
  }

  /// The neurons' exp at two currents, the present one and that before, are kept: a controller of
  /// two states goes to and fro between them.
  void set_current(Lane current) {
    const LaneMask before = current == currents_[0], fresh = ~before & (current != currents_[1]);
    if (any(fresh)) {
      currents_[0] = fresh ? currents_[1] : currents_[0];
      currents_[1] = fresh ? current : currents_[1];
      const Vector i = spread(currents_[1]);
      const auto moved = spread(fresh ? all(1) : Lane{}) != 0;
      for (Neurons* n = neurons_; n < end_; ++n) {
        n->resting[0] = moved ? n->resting[1] : n->resting[0];
        n->resting[1] = exp_of_twice<Real, kFar>(n->bias + n->by_current * i);
      }
    }
    const auto first = spread(before ? all(1) : Lane{}) != 0;
    for (Neurons* n = neurons_; n < end_; ++n) n->at_rest = first ? n->resting[0] : n->resting[1];
  }
  /// The neurons' exp at a velocity, for what follows.
  void move_to(Lane velocity) {
    const Vector v = spread(velocity);
    for (Neurons* n = neurons_; n < end_; ++n)
      n->moving = exp_of_twice<Real, kFar>(n->by_velocity * v);
  }
  /// Their tanh there at the present current, for what follows. Two share a division, which takes
  /// longer than all else. Returns the force, N.
  Lane respond() {
    Vector sum{};
    Neurons* n = neurons_;
    for (; n + 1 < end_; n += 2) {
      const Vector a = 1 + n[0].exp_of_sum(), b = 1 + n[1].exp_of_sum(), less = 2 / (a * b);
      n[0].tanh = 1 - less * b;
      n[1].tanh = 1 - less * a;
      sum += n[0].out[0] * n[0].tanh;
      sum += n[1].out[0] * n[1].tanh;
    }
    if (n < end_) {
      n->tanh = 1 - 2 / (1 + n->exp_of_sum());
      sum += n->out[0] * n->tanh;
    }
    return gathered(sum) + mean_;
  }
  /// f_k there, N (s/m)^k.
  void expand(Polynomial& force) const {
    Vector sum[kTerms]{};
    for (const Neurons* n = neurons_; n < end_; ++n) add(*n, sum);
    for (std::size_t k = 0; k < kTerms; ++k) force[k] = gathered(sum[k]);
    force[0] += mean_;
  }

 private:
  using Vector = Lanes<Real>;
  static constexpr std::size_t kTogether = kLanes<Real> / kWidth;  ///< neurons per vector
  static_assert(kTogether == 1 || kTogether == 2, "double or float");
  static_assert(kMaxWidth % kTogether == 0, "the last vector is within neurons_");
  /// From there on exp(2 x) stands still: |x| so great that tanh is 1 whatever the current adds, by
  /// kMostAtRest (LaneShape::moderate).
  static constexpr int kFar = sizeof(Real) == sizeof(float) ? 40 : 300;
  static_assert(kFar - kMostAtRest >= Arithmetic<Real>::kTanhOne);
  static constexpr Real kGreatest = sizeof(Real) == sizeof(float) ? Real(4.8e8) : Real(2.3e17);
  struct Neurons {
    Vector bias{}, by_current{}, by_velocity{};
    Vector resting[2]{};   ///< exp(2 (bias + by_current i)) at the two currents
    Vector at_rest{};      ///< and at the present one
    Vector moving{};       ///< exp(2 by_velocity v) at the velocity of move_to()
    Vector tanh{};         ///< there, after respond()
    Vector out[kTerms]{};  ///< output weight times by_velocity^k

    /// exp(2 s), no more than where tanh s is 1.
    Vector exp_of_sum() const { return smaller(Vector{} + kGreatest, at_rest * moving); }
  };

  static void put(Lane from, Vector& to, std::size_t place) {
    for (std::size_t k = 0; k < kWidth; ++k) to[place + k] = static_cast<Real>(from[k]);
  }
  /// The lanes of x once for each neuron of a vector, and back: the sum over a vector's neurons.
  static Vector spread(Lane x) {
    if constexpr (kTogether == 1)
      return x;
    else
      return twice(x, std::make_integer_sequence<int, kWidth>());
  }
  static Lane gathered(Vector sum) {
    if constexpr (kTogether == 1)
      return sum;
    else
      return halves(sum, std::make_integer_sequence<int, kWidth>());
  }
  typedef Real Half __attribute__((vector_size(kWidth * sizeof(Real))));
  template <int... kLane>
  static Vector twice(Lane x, std::integer_sequence<int, kLane...>) {
    const Half half = __builtin_convertvector(x, Half);
    return __builtin_shufflevector(half, half, kLane..., kLane...);
  }
  template <int... kLane>
  static Lane halves(Vector sum, std::integer_sequence<int, kLane...>) {
    constexpr int kCount = sizeof...(kLane);
    return __builtin_convertvector(__builtin_shufflevector(sum, sum, kLane...), Lane) +
           __builtin_convertvector(__builtin_shufflevector(sum, sum, (kLane + kCount)...), Lane);
  }

  /// Adds what these neurons give to f_k: out b^k t^(k) / k!; t is their tanh.
  [[gnu::always_inline]] static void add(const Neurons& neurons, Vector (&sum)[kTerms]) {
    static_assert(kTerms == 6, "one line per derivative of tanh");
    constexpr Real kThird = Real(1) / 3;
    const Vector(&out)[kTerms] = neurons.out;
    const Vector t = neurons.tanh, square = t * t, slope = 1 - square, bent = t * slope;
    sum[0] += out[0] * t;
    sum[1] += out[1] * slope;
    sum[2] -= out[2] * bent;
    sum[3] += out[3] * (slope * (square - kThird));
    sum[4] -= out[4] * (bent * (square - 2 * kThird));
    sum[5] += out[5] * (slope * (Real(0.4) * kThird - square * slope));
  }

  Lane currents_[2] = {all(__builtin_nan("")), all(__builtin_nan(""))};  ///< A, of `resting`
  Lane mean_;  ///< N, the output where all neurons give 0
  Neurons neurons_[kMaxWidth / kTogether];
  const Neurons* end_;
};

}  // namespace
}  // namespace dashpot
