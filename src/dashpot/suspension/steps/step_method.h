#pragma once
#include <memory>
#include <vector>

#include "dashpot/mounted_damper.h"
#include "dashpot/suspension/damper_state.h"
#include "dashpot/suspension/forces.h"

namespace dashpot {

/// A plant with its dampers at one instant.
struct PlantState {
  double time = 0;
  std::vector<double> x;  ///< [q, q']
  std::vector<DamperState> dampers;
  // What acts at this instant, kept by the integrator:
  std::vector<double> damper_forces;  ///< N, one per strut
  std::vector<double> strut_forces;   ///< with stop and friction
  std::vector<double> acceleration;   ///< q''

  /// Not moving at q = 0, with these dampers.
  static PlantState at_rest(const Plant& plant, const std::vector<MountedDamper>& dampers,
                            const ControlLimits& limits);
};

struct IntegratorOptions {
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-9;
  double longest_step = 0;  ///< s; 0: none
  bool controls_error = true;
};

struct StepCounts {
  std::size_t steps = 0, evaluations = 0;  ///< evaluations: of all forces
  std::size_t missed = 0;  ///< steps whose error stayed above the tolerance, short as they were
};

/// A way to go through a stretch of time in which no current jumps and no corner of its course
/// lies.
class StepMethod {
 public:
  virtual ~StepMethod() = default;
  virtual void refresh(PlantState& state) = 0;
  virtual bool advance(PlantState& state, double end) = 0;
  const StepCounts& counts() const { return counts_; }

 protected:
  StepCounts counts_;
};

/// The linear part moves exactly (Propagator) under forces that are parabolas within a step, found
/// by iteration: order 4 where forces are smooth, and no damper's own stiffness shortens the step.
/// The error is controlled by taking each step once whole and once in halves. For any damper.
std::unique_ptr<StepMethod> make_collocation(const PlantForces& forces,
                                             const IntegratorOptions& options,
                                             const PlantState& start);

/// Order 5 with an error of order 4 (Dormand, Prince, J. Comput. Appl. Math. 6 (1980) 19) of
/// motions and of the dampers' states, for dampers that flow (DamperModel::flows).
std::unique_ptr<StepMethod> make_explicit_steps(const PlantForces& forces,
                                                const IntegratorOptions& options,
                                                const PlantState& start);

/// RODAS (Hairer, Wanner, Solving Ordinary Differential Equations II, 1996), linearly implicit,
/// order 4 with an error of order 3, for the same dampers: hysteresis that is stiff at high speed
/// asks for no short steps.
std::unique_ptr<StepMethod> make_implicit_steps(const PlantForces& forces,
                                                const IntegratorOptions& options,
                                                const PlantState& start);

/// The cheaper one of these two at each time.
std::unique_ptr<StepMethod> make_switching_steps(const PlantForces& forces,
                                                 const IntegratorOptions& options,
                                                 const PlantState& start);

}  // namespace dashpot
