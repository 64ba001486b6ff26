#pragma once
#include <memory>
#include <vector>

#include "dashpot/mounted_damper.h"
#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/plants/plant_forces.h"

namespace dashpot {

/// A plant with its dampers at one instant, SI.
struct PlantState {
  double time = 0;
  std::vector<double> x;  ///< [q, q']
  std::vector<DamperState> dampers;
  // Forces at this instant, which the integrator keeps up to date:
  std::vector<double> damper_forces;  ///< N, one per strut
  std::vector<double> strut_forces;   ///< with stop and friction
  std::vector<double> acceleration;   ///< q''
  /// The road under the tyres at this time, s, for whoever asks for it at the same instant.
  std::vector<FootMotion> road;
  double road_time = -1;

  /// Not moving at q = 0, with these dampers.
  static PlantState at_rest(const Plant& plant, const std::vector<MountedDamper>& dampers,
                            const ControlLimits& limits);
};

struct IntegratorOptions {
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-9;
  double longest_step = 0;  ///< s; 0: no limit
  bool controls_error = true;
};

struct StepCounts {
  std::size_t steps = 0, evaluations = 0;  ///< evaluations: of all forces
  std::size_t missed = 0;  ///< steps whose error stayed above the tolerance, short as they were
};

/// A method of integration over stretches of time within which no current jumps and no corner of
/// its course lies.
class StepMethod {
 public:
  virtual ~StepMethod() = default;
  /// Brings the forces up to date: after a new current or a jump of the ground.
  virtual void refresh(PlantState& state) = 0;
  /// Brings the state to `end`, s. False where it is no longer finite.
  virtual bool advance(PlantState& state, double end) = 0;
  const StepCounts& counts() const { return counts_; }

 protected:
  StepCounts counts_;
};

/// Makes a method for a plant that starts from `start`. The forces must outlive it.
using MakeStepMethod = std::unique_ptr<StepMethod>(const PlantForces& forces,
                                                   const IntegratorOptions& options,
                                                   const PlantState& start);

/// The linear part moves exactly (Propagator) under forces that are parabolas within a step, found
/// by iteration: order 4 where forces are smooth, and no damper's own stiffness shortens the step.
/// The error is controlled by taking each step once whole and once in halves. For any damper.
MakeStepMethod make_collocation;

/// Dormand and Prince's method of order 5 (DormandPrince) for motions and the dampers' states, for
/// dampers that flow (DamperModel::flows).
MakeStepMethod make_explicit_steps;

/// RODAS (Hairer, Wanner, Solving Ordinary Differential Equations II, 1996), linearly implicit,
/// order 4 with an error of order 3, for the same dampers: hysteresis that is stiff at high speed
/// asks for no short steps.
MakeStepMethod make_implicit_steps;

/// Of the explicit and the implicit steps whichever costs less, stretch by stretch.
MakeStepMethod make_switching_steps;

}  // namespace dashpot
