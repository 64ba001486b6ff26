#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "dashpot/suspension/controller.h"

namespace dashpot {

/// A law that looks at each strut for itself and has no memory: damping or force from its signals.
template <class Parameters, DamperDemand (*Law)(const Parameters&, const ControlLimits&, const StrutSignals&)>
class StrutLaw final : public Controller {
 public:
  StrutLaw(const Parameters& parameters, const ControlLimits& limits)
      : parameters_(parameters), limits_(limits) {}
  void step(std::span<const StrutSignals> struts, std::span<const double>, std::span<double>,
            std::span<DamperDemand> demands) const noexcept override {
    for (std::size_t k = 0; k < struts.size(); ++k) demands[k] = Law(parameters_, limits_, struts[k]);
  }

 private:
  Parameters parameters_;
  ControlLimits limits_;
};

template <class Parameters, DamperDemand (*Law)(const Parameters&, const ControlLimits&, const StrutSignals&)>
ControllerPointer make_strut_law(std::span<const double> values, const ControlContext& context) {
  return std::make_unique<StrutLaw<Parameters, Law>>(values_as<Parameters>(values), context.limits);
}

/// The same for laws that cannot be told anything.
struct NoParameters {};
template <DamperDemand (*Law)(const NoParameters&, const ControlLimits&, const StrutSignals&)>
ControllerPointer make_plain(std::span<const double>, const ControlContext& context) {
  return std::make_unique<StrutLaw<NoParameters, Law>>(NoParameters{}, context.limits);
}

inline DamperDemand damping(double value) noexcept { return {DamperDemand::Kind::Damping, value}; }
inline DamperDemand hard_when(bool hard, const ControlLimits& limits) noexcept {
  const double values[] = {limits.damping_min, limits.damping_max};  // no branch: nobody would foresee it
  return damping(values[hard]);
}
/// A force within what damping can give at this speed.
inline DamperDemand dissipating_force(double force, double velocity, const ControlLimits& limits) noexcept {
  const double a = limits.damping_min * velocity, b = limits.damping_max * velocity;
  return {DamperDemand::Kind::Force, std::fmin(std::fmax(force, std::fmin(a, b)), std::fmax(a, b))};
}

/// z''^2 - (2 pi f z')^2: above 0 the body moves faster than at f Hz.
inline double frequency_range(const StrutSignals& s, double crossover) noexcept {
  const double rate = 2 * std::numbers::pi * crossover;
  return s.body_acceleration * s.body_acceleration - rate * rate * s.body_velocity * s.body_velocity;
}

constexpr ParameterRow kCrossover{
    "crossover", "Hz", 1.9,
    0.01,        100,  "between low and high frequencies: 1.5 to 2 times the body's resonance"};

}  // namespace dashpot
