#pragma once
#include <span>
#include <vector>

#include "dashpot/damper/nets/aligned.h"
#include "dashpot/damper_model.h"

namespace dashpot {

struct JacobianKernel;

/// States that velocity and current drive and that act back on themselves through a small
/// perceptron:
///   path states   x' = r (w - |w| x),  lags  y' = r (w - y),  current lags  u' = mu (i - u)
///   w = v + B phi,  r = rate exp(bend tanh(G phi / bend)),  phi = [1, x, u, tanh(W [x, y, v, u,
///   1])]
/// v standardised, so is u. Bounded for bounded inputs: a path state nears the direction of w, a
/// lag nears w, and w is v and something bounded, since y enters through tanh alone. With B = G = 0
/// a bank of Dahl states and lags.
struct StateSpaceCell {
  std::vector<double> path_rates, lag_rates;    ///< per standardised way; 1/s
  std::vector<double> current_rates;            ///< 1/s
  double velocity_scale = 1;                    ///< m/s
  double velocity_low = -1, velocity_high = 1;  ///< standardised; tanh sees v held within
  double current_mean = 0, current_scale = 1;   ///< A or V
  double current_low = -1, current_high = 1;    ///< standardised; u is held within
  std::vector<double> neurons;                  ///< W, row by row
  std::vector<double> feedback;                 ///< B, then G, row by row
  double model_step = 1e-3;  ///< s; a longer step is divided, into kMaxSteps at most

  static constexpr std::size_t kMaxMotions = 12, kMaxCurrents = 4, kMaxHidden = 32,
                               kMaxSteps = 1000;
  static constexpr std::size_t kMaxInputs = kMaxMotions + 1 + kMaxCurrents + 1;
  static constexpr std::size_t kMaxFeatures = 1 + kMaxMotions + kMaxCurrents + kMaxHidden;

  std::size_t motions() const noexcept { return path_rates.size() + lag_rates.size(); }
  std::size_t currents() const noexcept { return current_rates.size(); }
  std::size_t size() const noexcept { return motions() + currents(); }
  std::size_t neuron_stride() const noexcept { return motions() + 1 + currents() + 1; }
  std::size_t hidden() const noexcept { return neurons.size() / neuron_stride(); }
  std::size_t features() const noexcept {
    return 1 + path_rates.size() + currents() + hidden();
  }  ///< of phi
  std::size_t parameter_count() const noexcept { return size() + neurons.size() + feedback.size(); }

  /// ln rates, neurons, feedback.
  std::vector<double> parameters() const;
  void set_parameters(const double* parameters);
  /// Neurons from the seed, feedback 0. The rates must be set.
  void initialise(std::size_t hidden, std::uint64_t seed);

  /// Derivatives of the states by unknowns, the parameters first, brought along with the states.
  struct Slopes {
    Slopes(const StateSpaceCell& cell, std::size_t more_unknowns = 0);
    double* motion(std::size_t k) noexcept { return motions.data() + k * step; }

    std::size_t columns, step;               ///< unknowns; from row to row
    AlignedVector<double> motions, scratch;  ///< a row per motion state
    std::vector<double> currents;            ///< each by the logarithm of its own rate
    const JacobianKernel& kernel;
  };

  /// The states: x, y, then u, all standardised. At rest they have settled under the input's
  /// current.
  void rest(const DamperInput& input, std::span<double> state,
            Slopes* slopes = nullptr) const noexcept;
  void advance(const DamperInput& from, const DamperInput& to, double dt, std::span<double> state,
               Slopes* slopes = nullptr) const noexcept;

  /// The states' derivatives by time, as they are for steps without length.
  void flow(const DamperInput& input, std::span<const double> state,
            std::span<double> rates) const noexcept;

  /// Writes the signals that a network reads: v m/s, x, v - y, u (standardised but for v).
  std::size_t signal_count() const noexcept { return 1 + size(); }
  void read(const DamperInput& input, std::span<const double> state,
            double* signals) const noexcept;

 private:
  struct Point;
  void look(double velocity, const double* currents, const double* state, Point& at) const noexcept;
  void step(double h, Point& at, double* state) const noexcept;
  void step_slopes(const Point& at, const double* current_slopes, Slopes& slopes) const noexcept;
};

}  // namespace dashpot
