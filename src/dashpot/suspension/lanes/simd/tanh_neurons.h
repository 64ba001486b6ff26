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
/// so that one exponential and half a division per neuron give all terms. Real: what the neurons
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

  void set_current(Lane current) {
    const Vector i = spread(current);
    for (Neurons* n = neurons_; n < end_; ++n) n->at_rest = n->bias + n->by_current * i;
  }
  /// The neurons' tanh at a velocity and the present current, for what follows. Two sums share a
  /// division, which takes longer than all else. Returns the force, N.
  Lane move_to(Lane velocity) {
    Vector sum{};
    const Vector v = spread(velocity);
    Neurons* n = neurons_;
    for (; n + 1 < end_; n += 2) {
      const Vector a = 1 + exp_of_twice<Real>(n[0].at_rest + n[0].by_velocity * v),
                   b = 1 + exp_of_twice<Real>(n[1].at_rest + n[1].by_velocity * v),
                   less = 2 / (a * b);
      n[0].tanh = 1 - less * b;
      n[1].tanh = 1 - less * a;
      sum += n[0].out[0] * n[0].tanh;
      sum += n[1].out[0] * n[1].tanh;
    }
    if (n < end_) {
      n->tanh = 1 - 2 / (1 + exp_of_twice<Real>(n->at_rest + n->by_velocity * v));
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
  struct Neurons {
    Vector bias{}, by_current{}, by_velocity{};
    Vector at_rest{};      ///< the sum s at the present current and no velocity
    Vector tanh{};         ///< at the velocity of move_to()
    Vector out[kTerms]{};  ///< output weight times by_velocity^k
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
    sum[5] += out[5] * (slope * (square * (square - 1) + Real(0.4) * kThird));
  }

  Lane mean_;  ///< N, the output where all neurons give 0
  Neurons neurons_[kMaxWidth / kTogether];
  const Neurons* end_;
};

}  // namespace
}  // namespace dashpot
