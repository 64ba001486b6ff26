#pragma once
#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// A plant whose dampers flow as y' = f(t, y), y = [q, q', states of each damper's model]. The
/// coils' currents are known functions of time as long as no command changes.
class PlantEquations {
 public:
  PlantEquations(const PlantForces& forces, const PlantState& start);

  std::size_t size() const noexcept { return size_; }
  std::size_t coordinates() const noexcept { return coordinates_; }
  /// y of a state, which must outlive the calls of rates(): their time counts from its instant.
  void read(const PlantState& state, double* y);
  /// f at `after` seconds from there. Allocates nothing.
  void rates(double after, const double* y, double* dy) noexcept;
  /// Brings the state to `end`, s, where it is y; dy must come from the last call of rates(), at y.
  void write(const double* y, const double* dy, double end, PlantState& state) const;
  /// Forces and accelerations at the last call of rates(), which gave dy, into the state.
  void write_forces(const double* dy, PlantState& state) const;

 private:
  const PlantForces& forces_;
  std::size_t coordinates_, size_;
  const PlantState* state_ = nullptr;
  std::vector<double> currents_, damper_forces_, strut_forces_;
  std::vector<bool> steady_;  ///< whether a coil's current stays as it is
};

}  // namespace dashpot
