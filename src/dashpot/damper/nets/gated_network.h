#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_input.h"

namespace dashpot {

/// A small network whose output is a polynomial of second order in some of its inputs, the currents
/// u, and of any shape in the others, the motions z:
///
///   F = sum_j (sum_k G_jk c_k(u)) t_j,   t = [1, z, tanh(W [z, u] + b)],   c = [1, u_m, u_m u_n]
///
/// The force grows with a current no faster than its square. Signals stand in one array, motions
/// first. Odd in the motions but for b, the current's part of W and the first row of G. Plain data:
/// at most kMaxSignals signals, kMaxCurrents of them currents.
struct GatedNetwork {
  /// standardised = (raw - mean) / scale, held within low ... high, so that beyond the data the
  /// force stays within a bound. To it the velocity, the first of the motions, adds a straight line
  /// where that takes energy out: c (v - held v), with c = its gain at the held currents, none
  /// below 0. So whatever the weights, a network beyond its data is a bounded force beside a
  /// dashpot, and no plant that is stable without it can grow without end.
  struct Signal {
    double mean = 0, scale = 1;
    double low = -1, high = 1;  ///< standardised
  };
  std::vector<Signal> signals;  ///< motions, then currents
  std::size_t currents = 0;     ///< how many of them are currents
  std::vector<double> neurons;  ///< per neuron: weights of the signals, then b
  std::vector<double> gates;    ///< G, row by row
  double output_scale = 1;

  static constexpr std::size_t kMaxSignals = 32, kMaxCurrents = 4;

  std::size_t motions() const noexcept { return signals.size() - currents; }
  std::size_t neuron_stride() const noexcept { return signals.size() + 1; }
  std::size_t hidden() const noexcept { return neurons.size() / neuron_stride(); }
  std::size_t gate_count() const noexcept {
    return 1 + currents + currents * (currents + 1) / 2;
  }  ///< of c
  std::size_t term_count() const noexcept { return 1 + motions() + hidden(); }
  std::size_t parameter_count() const noexcept {
    return neurons.size() + term_count() * gate_count();
  }

  /// Throws Error(where, ...) when the parts do not fit together or to that many signals.
  void require_sound(std::size_t signal_count, const std::string& where) const;

  /// (raw - mean) / scale of every signal, none held; and held within the ranges.
  void standardise(const double* raw, double* linear) const noexcept {
    for (std::size_t k = 0; k < signals.size(); ++k)
      linear[k] = (raw[k] - signals[k].mean) / signals[k].scale;
  }
  void hold(const double* linear, double* held) const noexcept {
    for (std::size_t k = 0; k < signals.size(); ++k)
      held[k] = std::clamp(linear[k], signals[k].low, signals[k].high);
  }

  /// Output at raw signals, in raw units. Allocates nothing.
  double evaluate(const double* raw) const noexcept;
  /// The same without the line of the velocity.
  double evaluate_held(const double* raw) const noexcept;
  /// Standardised output at standardised signals, none held.
  double output(const double* standardised) const noexcept {
    return sum(standardised, standardised);
  }
  /// The same as evaluate() has it, with all held but the velocity where it goes on.
  double output(const double* linear, const double* held) const noexcept {
    return sum(linear, held);
  }
  /// The same and its derivatives: by `neurons`, then `gates`, parameter_count() numbers, and by
  /// the signals, signals.size() numbers. Both are overwritten. Allocates nothing.
  double differentiate(const double* linear, const double* held, double* by_parameters,
                       double* by_signals) const noexcept;
  double differentiate(const double* standardised, double* by_parameters,
                       double* by_signals) const noexcept {
    return differentiate(standardised, standardised, by_parameters, by_signals);
  }

  /// Neurons from the seed, gates 0. The signals must be set.
  void initialise(std::size_t hidden, std::uint64_t seed);

 private:
  static double continued(double linear, double held, double gain) noexcept;
  double sum(const double* linear, const double* held) const noexcept;
  void fill_gates(const double* currents, double* c) const noexcept;
};

/// The output, in raw units, at the signals that a source of states gives it at this instant.
template <class Source>
double read_by(const GatedNetwork& network, const Source& source, const DamperInput& input,
               std::span<const double> state) noexcept {
  std::array<double, GatedNetwork::kMaxSignals> signals;
  source.read(input, state, signals.data());
  return network.evaluate(signals.data());
}

}  // namespace dashpot
