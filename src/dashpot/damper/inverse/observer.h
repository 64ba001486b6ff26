#pragma once
#include <functional>
#include <memory>
#include <span>

#include "dashpot/damper/inverse/inverse.h"

namespace dashpot {

/// A model without the lag of its coil: its current is the one in the coil.
struct BareDamper {
  std::unique_ptr<DamperModel> model;
  double lag_rate = 0;  ///< 1/s, what was taken off
};
/// A copy of the model without that lag and without its force offset.
BareDamper without_coil_lag(const DamperModel& model);

/// Follows a damper in free run, and answers what its force would be at another current. All
/// inverses that know a forward model stand on it.
///
/// The state, state_size() numbers of the caller's: the model's own, room of the same size to try,
/// and the last displacement, velocity and current. Immutable after construction.
class Observer {
 public:
  /// The model without its coil's lag; where that still needs time to answer to the current (only
  /// its states feel it), currents are judged by the force at the end of a horizon.
  Observer(const DamperModel& model, const InverseLimits& limits);

  std::size_t state_size() const noexcept;
  void rest(const DamperInput& input, std::span<double> state) const noexcept;
  /// Comes to the present from the last call on. A state that is not finite starts anew, from rest.
  void follow(const InverseInput& input, std::span<double> state) const noexcept;
  /// Force at this current and the present motion; at the end of the horizon when there is one.
  double force(double current, const InverseInput& input, std::span<double> state) const noexcept;

  const DamperModel& model() const { return *model_; }  ///< without its coil's lag
  const InverseLimits& limits() const { return limits_; }
  int steps() const { return steps_; }  ///< of the horizon, each a sample long
  double horizon() const { return steps_ * limits_.sample_time; }  ///< s
  /// What the model does on a sine of 20 mm at 1 Hz, to size tolerances and gains.
  double force_max() const { return force_max_; }  ///< N, the largest |F| at any current
  double current_effect() const {
    return effect_;
  }  ///< N, the largest difference that the current makes

  /// Calls visit(input, state) at instants along that sine, at half the current range.
  void probe(const std::function<void(const InverseInput&, std::span<double>)>& visit) const;

 private:
  double mean_effect() const;

  std::unique_ptr<DamperModel> model_;
  InverseLimits limits_;
  int steps_ = 0;
  double force_max_ = 0, effect_ = 0;
};

}  // namespace dashpot
