// Passive networks over windows, one per lane: compiled once per instruction set. The equations are
// those of c_text/passive_cell.h; a window's forward pass keeps what its way back needs.
#include "dashpot/damper/kinds/passive_network/simd/tables.h"
#include "dashpot/damper/nets/simd/activations.h"
#include "dashpot/damper/nets/simd/intrinsics.h"
#include "dashpot/damper/nets/simd/lanes.h"

namespace dashpot {
namespace {

using V = Lanes<float>;
using Bits = LaneTypes<float>::Integers;

constexpr float kLeastGate = -12, kMostGate = 8;  // as in passive_gates()
constexpr std::size_t kTile = 4;  // rows at once: its accumulators and one input fit the registers

inline V smaller(V a, V b) { return -larger(-a, -b); }
inline V magnitude(V a) { return __builtin_bit_cast(V, __builtin_bit_cast(Bits, a) & 0x7fffffff); }

/// e^x to some 1e-7 of itself, for x within -80 ... 80.
inline V exp_lanes(V x) {
  using A = Arithmetic<float>;
  constexpr float kRound = A::kRound + A::kBias;
  const V held = smaller(larger(x, V{} - 80.0f), V{} + 80.0f);
  const V shifted = held * 1.44269504f + kRound, k = shifted - kRound;
  const V power = __builtin_bit_cast(V, __builtin_bit_cast(Bits, shifted) << A::kMantissa);
  const V z = (held - k * A::kLn2High) - k * A::kLn2Low;
  V tail = z * (1 / 5040.0f) + 1 / 720.0f;
  tail = ((tail * z + 1 / 120.0f) * z + 1 / 24.0f) * z + 1 / 6.0f;
  return (((tail * z + 0.5f) * z + 1) * z + 1) * power;
}

/// (1 - e^-reach) / reach, given e^-reach.
inline V mean_decay(V reach, V decay) {
  const V large = (1.0f - decay) / larger(reach, V{} + 1e-2f);
  return reach > 1e-2f ? large : 1.0f - reach * (0.5f - reach * (1 / 6.0f));
}
/// Its derivative by reach.
inline V mean_decay_slope(V reach, V decay, V mean) {
  const V large = (decay - mean) / larger(reach, V{} + 1e-2f);
  return reach > 1e-2f ? large : -0.5f + reach * (1 / 3.0f);
}

inline float scalar_exp(float x) { return exp_lanes(V{} + x)[0]; }

/// out = weights in: `rows` sums of `count` inputs.
void multiply(const float* weights, std::size_t rows, std::size_t count, const V* in, V* out) {
  std::size_t j = 0;
  for (; j + kTile <= rows; j += kTile, weights += kTile * count) {
    V sums[kTile] = {};
    for (std::size_t i = 0; i < count; ++i)
#pragma GCC unroll 4
      for (std::size_t t = 0; t < kTile; ++t) sums[t] += weights[t * count + i] * in[i];
    for (std::size_t t = 0; t < kTile; ++t) out[j + t] = sums[t];
  }
  for (; j < rows; ++j, weights += count) {
    V sum{};
    for (std::size_t i = 0; i < count; ++i) sum += weights[i] * in[i];
    out[j] = sum;
  }
}

/// in_slopes += weights' slopes.
void multiply_back(const float* weights, std::size_t rows, std::size_t count, const V* slopes,
                   V* in_slopes) {
  std::size_t i = 0;
  for (; i + kTile <= count; i += kTile) {
    V sums[kTile];
    for (std::size_t t = 0; t < kTile; ++t) sums[t] = in_slopes[i + t];
    for (std::size_t j = 0; j < rows; ++j)
#pragma GCC unroll 4
      for (std::size_t t = 0; t < kTile; ++t) sums[t] += weights[j * count + i + t] * slopes[j];
    for (std::size_t t = 0; t < kTile; ++t) in_slopes[i + t] = sums[t];
  }
  for (; i < count; ++i)
    for (std::size_t j = 0; j < rows; ++j) in_slopes[i] += weights[j * count + i] * slopes[j];
}

/// Rows over time of which a gradient is the sum of products.
struct History {
  const V* at;
  std::size_t step;  ///< from sample to sample
};

/// gradient[j][i] += sum over samples and lanes of slopes[j] in[i].
template <std::size_t kRows, std::size_t kColumns>
void add_tile(float* gradient, std::size_t count, History slopes, History in, std::size_t samples) {
  V sums[kRows][kColumns] = {};
  for (std::size_t t = 0; t < samples; ++t) {
    const V *d = slopes.at + t * slopes.step, *x = in.at + t * in.step;
#pragma GCC unroll 4
    for (std::size_t a = 0; a < kRows; ++a)
#pragma GCC unroll 4
      for (std::size_t b = 0; b < kColumns; ++b) sums[a][b] += d[a] * x[b];
  }
  for (std::size_t a = 0; a < kRows; ++a)
    for (std::size_t b = 0; b < kColumns; ++b)
      gradient[a * count + b] += Shuffle<float>::sum(sums[a][b]);
}
void add_products(float* gradient, std::size_t rows, std::size_t count, History slopes, History in,
                  std::size_t samples) {
  constexpr std::size_t kColumns = kRegisters > 16 ? 4 : 2;
  const auto columns = [&]<std::size_t kRows>(std::size_t j) {
    const History d{slopes.at + j, slopes.step};
    std::size_t i = 0;
    for (; i + kColumns <= count; i += kColumns)
      add_tile<kRows, kColumns>(gradient + j * count + i, count, d, {in.at + i, in.step}, samples);
    for (; i < count; ++i)
      add_tile<kRows, 1>(gradient + j * count + i, count, d, {in.at + i, in.step}, samples);
  };
  std::size_t j = 0;
  for (; j + kTile <= rows; j += kTile) columns.template operator()<kTile>(j);
  for (; j < rows; ++j) columns.template operator()<1>(j);
}

/// What a pass forward keeps, a row per sample of each.
struct Rows {
  V *inputs, *hidden, *goals, *gates, *springs, *memories, *drives, *shares, *levers, *decays,
      *means, *reaches, *seen, *viscous, *z, *followers, *slopes, *gate_slopes, *viscous_slopes;
};

/// Hands out rows of the room; with a null room it only counts.
class Room {
 public:
  explicit Room(float* at) : at_(reinterpret_cast<V*>(at)) {}
  V* take(std::size_t vectors) {
    V* const at = at_ ? at_ + used_ : nullptr;
    used_ += vectors;
    return at;
  }
  std::size_t used() const { return used_; }

 private:
  V* at_;
  std::size_t used_ = 0;
};

constexpr std::size_t kMostStates = 64;

Rows rows_in(Room& room, const PassiveSizes& z, std::size_t samples) {
  const std::size_t n = z.springs, m = z.memories, h = z.neurons, hc = z.viscous_neurons;
  Rows r;
  r.inputs = room.take(samples * z.inputs());
  r.hidden = room.take(samples * (h + 2));
  r.goals = room.take(samples * m);
  r.gates = room.take(samples * 2 * n);
  r.springs = room.take(samples * n);
  r.memories = room.take(samples * m);
  r.drives = room.take(samples);
  r.shares = room.take(samples * 2);
  r.levers = room.take(samples * n);
  r.decays = room.take(samples * n);
  r.means = room.take(samples * n);
  r.reaches = room.take(samples * n);
  r.seen = room.take(samples * (z.seen() + 1));
  r.viscous = room.take(samples * (hc + 2));
  r.z = room.take(samples);
  r.followers = room.take(samples);
  r.slopes = room.take(samples * (h + m));
  r.gate_slopes = room.take(samples * 2 * n);
  r.viscous_slopes = room.take(samples * hc);
  return r;
}

std::size_t room_for(const PassiveSizes& sizes, std::size_t samples) noexcept {
  Room room(nullptr);
  rows_in(room, sizes, samples);
  return room.used() * kLanes<float>;
}

/// One block of windows: the pass forward, then the way back.
class Pass {
 public:
  explicit Pass(const PassiveWindows& w)
      : w_(w),
        z_(w.sizes),
        at_(z_),
        n_(z_.springs),
        m_(z_.memories),
        h_(z_.neurons),
        hc_(z_.viscous_neurons),
        p_(w.numbers),
        room_(w.room),
        r_(rows_in(room_, z_, w.samples)) {
    drive_kept_ = w.lags ? scalar_exp(-p_[at_.drive_rate] * w.step) : 0.0f;
    follower_kept_ = scalar_exp(-p_[at_.inertia_rate] * w.step);
    for (std::size_t k = 0; k < m_; ++k)
      memory_kept_[k] = scalar_exp(-p_[at_.memory_rates + k] * w.step);
  }

  double forward() {
    for (std::size_t k = 0; k < n_; ++k) r_.springs[k] = V{};
    for (std::size_t k = 0; k < m_; ++k) r_.memories[k] = V{};
    r_.drives[0] = at(w_.drive, 0);
    r_.followers[0] = at(w_.velocity, 0);
    V squares{};
    for (std::size_t t = 0; t < w_.samples; ++t) {
      const V force = output(t);
      store(w_.forces + t * kLanes<float>, force);
      const V error = force + load(w_.offsets) - at(w_.force, t);
      squares += at(w_.weight, t) * error * error;
      if (t + 1 < w_.samples) advance(t);
    }
    return static_cast<double>(Shuffle<float>::sum(squares));
  }

  void backward() {
    V offset_slope{};
    for (std::size_t t = w_.samples; t-- > 0;) {
      V by_drive{}, by_share{};
      if (t + 1 < w_.samples) advance_back(t, by_drive);
      const V error = at(w_.forces, t) + load(w_.offsets) - at(w_.force, t);
      const V slope = 2.0f * at(w_.weight, t) * error;
      offset_slope += slope;
      output_back(t, slope, by_drive, by_share);
      by_drive_ = by_drive;
    }
    store(w_.offset_gradient, offset_slope);
    gather();
  }

 private:
  static V at(const float* row, std::size_t t) { return load(row + t * kLanes<float>); }
  V middle(const float* row, std::size_t t) const { return 0.5f * (at(row, t) + at(row, t + 1)); }

  V share(V drive) const {
    const float most = p_[at_.saturation];
    return most * (1.0f - exp_lanes(-larger(V{}, drive) * (1 / most)));
  }
  /// The slope by a share goes on to the drive and to the saturation.
  V share_back(V drive, V share, V slope) {
    const float inverse = 1 / p_[at_.saturation];
    const V part = share * inverse, fall = drive > 0.0f ? slope * (1.0f - part) : V{};
    by_saturation_ += slope * part - fall * drive * inverse;
    return fall;
  }
  V lever(std::size_t k, V share) const {
    return p_[at_.levers + k] + p_[at_.levers + n_ + k] * share;
  }

  /// v, x, what is read of q, the memories at this sample; returns what stands behind them.
  V* see(V* to, V velocity, V displacement, V drive, std::size_t t) const {
    to[0] = velocity, to[1] = displacement;
    to[2] = (drive - w_.drive_middle) * load(w_.reading);
    for (std::size_t k = 0; k < m_; ++k) to[3 + k] = r_.memories[t * m_ + k];
    return to + 3 + m_;
  }

  /// The force at a sample.
  V output(std::size_t t) {
    const V v = at(w_.velocity, t), x = at(w_.displacement, t), q = r_.drives[t];
    const V a = r_.shares[2 * t] = share(q);

    // The viscous term.
    V* const seen = r_.seen + t * (z_.seen() + 1);
    *see(seen, v, x, q, t) = V{} + 1.0f;
    V *const hidden = r_.viscous + t * (hc_ + 2), z{};
    multiply(p_ + at_.viscous_weights, hc_, z_.seen() + 1, seen, hidden);
    for (std::size_t k = 0; k < hc_; ++k) hidden[k] = tanh_lanes<float>(hidden[k]);
    hidden[hc_] = V{} + 1.0f, hidden[hc_ + 1] = a;
    multiply(p_ + at_.viscous, 1, hc_ + 2, hidden, r_.z + t);
    const V sum = r_.z[t];
    V force = 0.5f * (sum + root(sum * sum + 1.0f)) * v;
    (void)z;

    // The potential, inertia and springs.
    const float* u = p_ + at_.potential;
    force += u[0] * x + u[1] * exp_lanes(u[2] * x) - u[3] * exp_lanes(-u[4] * x);
    if (w_.inert) force += p_[at_.inertia] * (v - r_.followers[t]);
    for (std::size_t k = 0; k < n_; ++k) force += lever(k, a) * r_.springs[t * n_ + k];
    return force;
  }

  void advance(std::size_t t) {
    const V v = middle(w_.velocity, t), x = middle(w_.displacement, t);

    // The drive behind its lag.
    const V u = middle(w_.drive, t);
    r_.drives[t + 1] = w_.lags ? u + drive_kept_ * (r_.drives[t] - u) : at(w_.drive, t + 1);
    const V q = w_.lags ? 0.5f * (r_.drives[t] + r_.drives[t + 1]) : u;
    const V a = r_.shares[2 * t + 1] = share(q);

    // Neurons and memories.
    V* const inputs = r_.inputs + t * z_.inputs();
    V* rest = see(inputs, v, x, q, t);
    for (std::size_t k = 0; k < n_; ++k) *rest++ = r_.springs[t * n_ + k];
    *rest = V{} + 1.0f;
    V *const hidden = r_.hidden + t * (h_ + 2), *const goals = r_.goals + t * m_;
    multiply(p_ + at_.weights, h_, z_.inputs(), inputs, hidden);
    multiply(p_ + at_.weights + h_ * z_.inputs(), m_, z_.inputs(), inputs, goals);
    for (std::size_t k = 0; k < h_; ++k) hidden[k] = tanh_lanes<float>(hidden[k]);
    hidden[h_] = V{} + 1.0f, hidden[h_ + 1] = a;
    for (std::size_t k = 0; k < m_; ++k) {
      goals[k] = tanh_lanes<float>(goals[k]);
      r_.memories[(t + 1) * m_ + k] =
          goals[k] + memory_kept_[k] * (r_.memories[t * m_ + k] - goals[k]);
    }

    // Springs at resistances that stand still over the step.
    V* const gates = r_.gates + t * 2 * n_;
    multiply(p_ + at_.gates, 2 * n_, h_ + 2, hidden, gates);
    for (std::size_t k = 0; k < 2 * n_; ++k)
      gates[k] = exp_lanes(smaller(larger(gates[k], V{} + kLeastGate), V{} + kMostGate));
    for (std::size_t k = 0; k < n_; ++k) {
      const std::size_t here = t * n_ + k;
      const float turn = p_[at_.stiffness + k] * w_.step;
      const V levered = r_.levers[here] = lever(k, a);
      const V way = levered * v;
      const V reach = r_.reaches[here] = turn * (gates[k] + magnitude(way) * gates[n_ + k]);
      const V decay = r_.decays[here] = exp_lanes(-reach);
      const V mean = r_.means[here] = mean_decay(reach, decay);
      r_.springs[here + n_] = decay * r_.springs[here] + turn * way * mean;
    }
    if (w_.inert) r_.followers[t + 1] = v + follower_kept_ * (r_.followers[t] - v);
  }

  /// From the slopes by the states after the step to those before it; what the middle's drive adds
  /// to the present drive's slope comes out.
  void advance_back(std::size_t t, V& by_drive) {
    const V v = middle(w_.velocity, t);
    const V *const hidden = r_.hidden + t * (h_ + 2), *const goals = r_.goals + t * m_;
    const V* const gates = r_.gates + t * 2 * n_;
    V* const gate_slopes = r_.gate_slopes + t * 2 * n_;

    // Springs.
    V by_share{};
    for (std::size_t k = 0; k < n_; ++k) {
      const std::size_t here = t * n_ + k;
      const float turn = p_[at_.stiffness + k] * w_.step;
      const V levered = r_.levers[here], reach = r_.reaches[here], decay = r_.decays[here];
      const V mean = r_.means[here], way = levered * v, slope = by_springs_[k];
      const V by_reach =
          slope * (turn * way * mean_decay_slope(reach, decay, mean) - decay * r_.springs[here]);
      const V by_way = slope * turn * mean;
      by_stiffness_[k] += (by_reach * reach + by_way * way) * (1 / p_[at_.stiffness + k]);
      const V by_lever = by_way * v + by_reach * turn * gates[n_ + k] * magnitude(v);
      by_levers_[k] += by_lever;
      by_levers_[n_ + k] += by_lever * r_.shares[2 * t + 1];
      by_share += by_lever * p_[at_.levers + n_ + k];
      gate_slopes[k] = within(gates[k], by_reach * turn * gates[k]);
      gate_slopes[n_ + k] = within(gates[n_ + k], by_reach * turn * magnitude(way) * gates[n_ + k]);
      by_springs_[k] = slope * decay;
    }

    // Gates, neurons and memories.
    V by_hidden[kMaxWidth] = {}, by_inputs[kMaxWidth] = {};
    multiply_back(p_ + at_.gates, 2 * n_, h_ + 2, gate_slopes, by_hidden);
    by_share += by_hidden[h_ + 1];
    V* const slopes = r_.slopes + t * (h_ + m_);
    for (std::size_t k = 0; k < h_; ++k) slopes[k] = by_hidden[k] * (1.0f - hidden[k] * hidden[k]);
    for (std::size_t k = 0; k < m_; ++k) {
      const V slope = by_memories_[k], kept = V{} + memory_kept_[k];
      by_memory_rates_[k] -= slope * (r_.memories[t * m_ + k] - goals[k]) * kept * w_.step;
      slopes[h_ + k] = slope * (1.0f - kept) * (1.0f - goals[k] * goals[k]);
      by_memories_[k] = slope * kept;
    }
    multiply_back(p_ + at_.weights, h_ + m_, z_.inputs(), slopes, by_inputs);
    for (std::size_t k = 0; k < m_; ++k) by_memories_[k] += by_inputs[3 + k];
    for (std::size_t k = 0; k < n_; ++k) by_springs_[k] += by_inputs[3 + m_ + k];

    // The drive, of which the step saw the middle.
    const V q = w_.lags ? 0.5f * (r_.drives[t] + r_.drives[t + 1]) : middle(w_.drive, t);
    const V by_middle =
        by_inputs[2] * load(w_.reading) + share_back(q, r_.shares[2 * t + 1], by_share);
    if (w_.lags) {
      const V after = by_drive_ + 0.5f * by_middle;
      by_drive_rate_ -= after * (r_.drives[t] - middle(w_.drive, t)) * (drive_kept_ * w_.step);
      by_drive += drive_kept_ * after + 0.5f * by_middle;
    }
    if (w_.inert) {
      by_inertia_rate_ -= by_follower_ * (r_.followers[t] - v) * (follower_kept_ * w_.step);
      by_follower_ = by_follower_ * follower_kept_;
    }
  }

  void output_back(std::size_t t, V slope, V& by_drive, V& by_share) {
    const V v = at(w_.velocity, t), x = at(w_.displacement, t), a = r_.shares[2 * t];

    // The viscous term.
    const V sum = r_.z[t], by_z = slope * v * 0.5f * (1.0f + sum / root(sum * sum + 1.0f));
    const V* const hidden = r_.viscous + t * (hc_ + 2);
    V* const slopes = r_.viscous_slopes + t * hc_;
    for (std::size_t k = 0; k < hc_; ++k) {
      by_viscous_[k] += by_z * hidden[k];
      slopes[k] = by_z * p_[at_.viscous + k] * (1.0f - hidden[k] * hidden[k]);
    }
    by_viscous_[hc_] += by_z;
    by_viscous_[hc_ + 1] += by_z * a;
    by_share += by_z * p_[at_.viscous + hc_ + 1];
    V by_seen[kMaxWidth] = {};
    multiply_back(p_ + at_.viscous_weights, hc_, z_.seen() + 1, slopes, by_seen);
    by_drive += by_seen[2] * load(w_.reading);
    for (std::size_t k = 0; k < m_; ++k) by_memories_[k] += by_seen[3 + k];

    // The potential and inertia.
    const float* u = p_ + at_.potential;
    const V more = exp_lanes(u[2] * x), less = exp_lanes(-u[4] * x);
    by_potential_[0] += slope * x;
    by_potential_[1] += slope * more;
    by_potential_[2] += slope * u[1] * more * x;
    by_potential_[3] -= slope * less;
    by_potential_[4] += slope * u[3] * less * x;
    if (w_.inert) {
      by_inertia_ += slope * (v - r_.followers[t]);
      by_follower_ -= slope * p_[at_.inertia];
    }

    // The springs and their levers.
    for (std::size_t k = 0; k < n_; ++k) {
      const V by_lever = slope * r_.springs[t * n_ + k];
      by_springs_[k] += slope * lever(k, a);
      by_levers_[k] += by_lever;
      by_levers_[n_ + k] += by_lever * a;
      by_share += by_lever * p_[at_.levers + n_ + k];
    }
    by_drive += share_back(r_.drives[t], a, by_share);
  }

  /// A gate that is held at an end does not move.
  static V within(V gate, V slope) { return ((gate > 6.2e-6f) & (gate < 2980.0f)) ? slope : V{}; }

  /// Adds everything to the gradient.
  void gather() {
    float* const g = w_.gradient;
    const auto add = [g](std::size_t first, const V* slopes, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) g[first + k] += Shuffle<float>::sum(slopes[k]);
    };
    add_products(g + at_.weights, h_ + m_, z_.inputs(), {r_.slopes, h_ + m_},
                 {r_.inputs, z_.inputs()}, w_.samples - 1);
    add_products(g + at_.gates, 2 * n_, h_ + 2, {r_.gate_slopes, 2 * n_}, {r_.hidden, h_ + 2},
                 w_.samples - 1);
    add_products(g + at_.viscous_weights, hc_, z_.seen() + 1, {r_.viscous_slopes, hc_},
                 {r_.seen, z_.seen() + 1}, w_.samples);
    add(at_.viscous, by_viscous_, hc_ + 2);
    add(at_.levers, by_levers_, 2 * n_);
    add(at_.stiffness, by_stiffness_, n_);
    add(at_.memory_rates, by_memory_rates_, m_);
    add(at_.saturation, &by_saturation_, 1);
    add(at_.potential, by_potential_, 5);
    add(at_.drive_rate, &by_drive_rate_, 1);
    add(at_.inertia, &by_inertia_, 1);
    add(at_.inertia_rate, &by_inertia_rate_, 1);
  }

  const PassiveWindows& w_;
  const PassiveSizes& z_;
  const PassiveLayout at_;
  const std::size_t n_, m_, h_, hc_;
  const float* p_;
  Room room_;
  Rows r_;
  float drive_kept_, follower_kept_, memory_kept_[kMostStates];

  // Slopes by the states after the sample that the way back has reached, and sums over samples.
  V by_springs_[kMostStates] = {}, by_memories_[kMostStates] = {}, by_drive_{}, by_follower_{};
  V by_levers_[2 * kMostStates] = {}, by_stiffness_[kMostStates] = {},
                   by_memory_rates_[kMostStates] = {}, by_viscous_[kMaxWidth] = {},
                   by_potential_[5] = {};
  V by_saturation_{}, by_drive_rate_{}, by_inertia_{}, by_inertia_rate_{};
};

double run(const PassiveWindows& windows) noexcept {
  Pass pass(windows);
  const double squares = pass.forward();
  if (windows.gradient) pass.backward();
  return squares;
}

constexpr PassiveKernel kTable{kLanes<float>, &room_for, &run};

}  // namespace

const PassiveKernel& DASHPOT_PASSIVE() { return kTable; }

}  // namespace dashpot
