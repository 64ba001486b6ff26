#pragma once
#include <array>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/suspension/dampers/law_loop.h"
#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// A hysteresis loop among the dampers' states.
struct FollowedLoop {
  LoopPath<LawLoopKind> path;
  std::size_t damper, place;           ///< the number of the damper, and the place of z in y
  std::optional<std::size_t> series;   ///< the place in y whose rate the loop's speed is less by
  double r = 0, z = NAN;               ///< as last written into a state
  double m = 0, steep = 1, along = 0;  ///< at the last call of rates(): LoopPath's
};

/// A damper that is a law without a lag: its parameters stay as they are while its current does.
struct SteadyLaw {
  const LawModel* law = nullptr;  ///< null: some other model
  double current = NAN;
  std::array<double, kMaxParams> parameters{};
};

/// A plant whose dampers flow as y' = f(t, y), y = [q, q', states of each damper's model]. The
/// coils' currents are known functions of time as long as no command changes.
///
/// Loops that are followed stand in y by their r (LoopPath) in the place of z.
class PlantEquations {
 public:
  PlantEquations(const PlantForces& forces, const PlantState& start);
  /// Follows the loops of all dampers, with the error of these options.
  void follow_loops(const PlantState& start, const IntegratorOptions& options);
  std::vector<FollowedLoop>& loops() noexcept { return loops_; }
  const std::vector<FollowedLoop>& loops() const noexcept { return loops_; }

  std::size_t size() const noexcept { return size_; }
  std::size_t coordinates() const noexcept { return coordinates_; }
  /// y of a state, which must outlive the calls of rates(): their time counts from its instant.
  void read(const PlantState& state, double* y);
  /// f at `after` seconds from there. Allocates nothing.
  void rates(double after, const double* y, double* dy) noexcept;
  /// Brings the state to `end`, s, where it is y; dy must come from the last call of rates(), at y.
  void write(const double* y, const double* dy, double end, PlantState& state);
  /// Forces and accelerations at the last call of rates(), which gave dy, into the state.
  void write_forces(const double* dy, PlantState& state) const;

 private:
  /// rates() of a plant with these sizes.
  template <class Sizes>
  void rates_of(Sizes sizes, double after, const double* y, double* dy) noexcept;

  const PlantForces& forces_;
  std::size_t coordinates_, size_;
  const PlantState* state_ = nullptr;
  std::vector<double> currents_, damper_forces_, strut_forces_, speeds_;
  std::vector<char> steady_;     ///< whether a coil's current stays as it is
  std::vector<SteadyLaw> laws_;  ///< one per damper
  std::vector<FollowedLoop> loops_;
  std::vector<double> states_;  ///< of the dampers at the last call of rates(), loops by their z
};

}  // namespace dashpot
