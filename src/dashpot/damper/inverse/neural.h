#pragma once
#include <cstdint>
#include <vector>

#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/damper/neural/mlp.h"

namespace dashpot {

/// One input of a neural inverse: a signal, some steps ago.
struct Tap {
  enum class Signal { Displacement, Velocity, Force, Current };
  Signal signal;
  int delay;  ///< in steps of NeuralOptions::spacing; a current is at least one step old
};

/// How a network is trained to invert a model: on a random motion and a random current.
struct NeuralOptions {
  std::vector<Tap> taps;
  std::size_t hidden = 12;  ///< neurons of the one hidden layer
  double spacing = 5e-3;    ///< s between two delays, rounded to samples
  std::size_t samples = 3000;
  int iterations = 60;
  double amplitude = 0.02;   ///< m, twice the motion's standard deviation
  double motion_band = 3;    ///< Hz, its highest frequency
  double current_band = 10;  ///< Hz, the current's
  std::uint64_t seed = 1;
};

/// A network from motion, wanted force and past currents to the current.
class NeuralInverse final : public InverseModel {
 public:
  /// Trains it. Throws Error on taps that cannot be served, and when the model diverges on the way.
  NeuralInverse(std::string name, const DamperModel& forward, const InverseLimits& limits,
                const NeuralOptions& options);

  std::string name() const override { return name_; }
  std::size_t state_size() const noexcept override { return kSignals * rows_; }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  double training_rmse() const { return training_rmse_; }  ///< A

 protected:
  double wanted_current(const InverseInput& input, std::span<double> state) const noexcept override;

 private:
  static constexpr std::size_t kSignals = 4;

  void push(const double* row, std::span<double> state) const noexcept;
  void gather(std::span<const double> state, double* inputs) const noexcept;
  TrainingSamples record(const DamperModel& bare, const NeuralOptions& options) const;

  std::string name_;
  std::vector<std::size_t> places_;     // in the state, one per tap
  std::size_t spacing_ = 1, rows_ = 1;  // samples; the state keeps so many, newest first
  Mlp mlp_;
  double training_rmse_ = 0;
};

}  // namespace dashpot
