#pragma once
#include <span>

#include "dashpot/damper_model.h"

namespace dashpot {

class LawModel;

/// Brings a law's states and the current in its coil over one step of the simulation, dt long, in
/// as many steps of its own as its rate asks for: classical Runge-Kutta, or the law's own step
/// where that would take many.
void integrate(const LawModel& model, const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) noexcept;

}  // namespace dashpot
