#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/damper/nets/mlp_evaluator.h"

namespace dashpot {

/// One input of an inverse network: a signal, some steps ago.
struct Tap {
  enum class Signal { Displacement, Velocity, Force, Current };
  Signal signal;
  int delay = 0;  ///< in steps of InverseNetwork::spacing; a current, its own answer, is at least
                  ///< one step old
  bool operator==(const Tap&) const = default;
};

/// "displacement", "velocity", "force" (the wanted one) or "current" (its own answer).
std::string_view name_of(Tap::Signal signal);
/// Throws Error with the names that there are.
Tap::Signal tap_signal_named(std::string_view name, const std::string& where);

/// A network from motion, wanted force and its own past currents to the current, and the domain
/// that it was taught over. Plain data; HistoryNetwork runs it.
struct InverseNetwork {
  static constexpr int kMostDelay = 100;

  std::string name;       ///< of its preset
  std::vector<Tap> taps;  ///< the network's inputs, in its order
  double spacing = 5e-3;  ///< s between two delays
  double current_min = 0,
         current_max = 1;  ///< A or V, where it was taught: it answers nothing beyond
  double rate_max = 0;     ///< A/s, of its answer; 0: none
  Mlp mlp;

  bool feeds_back() const;
  /// Samples between two delays. Throws Error where they are not a whole number within 5 %.
  std::size_t stride(double sample_time) const;
};

/// Throws Error(where, ...) on taps, numbers or a shape that no network can have.
void require_usable(const InverseNetwork& network, const std::string& where);

/// An InverseNetwork at work, in free run on its own past answers. Its state holds the four signals
/// of so many past samples, newest first: kSignals numbers a row. Never NaN: input that is not
/// finite is not looked at, and what overflows gives the least current.
class HistoryNetwork final : public InverseModel {
 public:
  /// Throws Error where the network is not usable, the sample time cannot serve its delays, or its
  /// currents are not among the limits.
  HistoryNetwork(InverseNetwork network, const InverseLimits& limits);

  std::string name() const override { return network_.name; }
  std::size_t state_size() const noexcept override { return kSignals * rows_; }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  const InverseNetwork& network() const { return network_; }
  double least() const { return low_; }  ///< A, that it answers
  double most() const { return high_; }  ///< A
  double most_change() const {
    return most_change_;
  }  ///< A, from one answer to the next; may be infinite
  const std::vector<std::size_t>& places() const { return places_; }  ///< in the state, one per tap

 protected:
  double wanted_current(const InverseInput& input, std::span<double> state) const noexcept override;

 private:
  static constexpr std::size_t kSignals = 4;  // in a row of the state, in the order of Tap::Signal

  InverseNetwork network_;
  MlpEvaluator<double> evaluator_;
  std::vector<std::size_t> places_;  // in the state, one per tap
  std::size_t rows_ = 2;             // samples that the state keeps, newest first
  double low_, high_, most_change_;
};

}  // namespace dashpot
