#pragma once
#include <map>
#include <span>
#include <vector>

#include "dashpot/suspension/forces.h"
#include "dashpot/suspension/propagator.h"

namespace dashpot {

/// A plant with its dampers at one instant.
struct PlantState {
  double time = 0;
  std::vector<double> x;  ///< [q, q']
  std::vector<DamperState> dampers;
  std::vector<double> strut_forces, g;  ///< at this instant
};

struct IntegratorOptions {
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-9;
  double longest_step = 0;     ///< s; 0: none
  bool controls_error = true;  ///< by taking each step once whole and once in halves
};

/// Brings a plant through smooth stretches of time.
class Integrator {
 public:
  Integrator(const PlantForces& forces, const IntegratorOptions& options, const PlantState& start);

  /// Forces at the state's own instant: after a demand or a jump of the ground.
  void refresh(PlantState& state);
  /// From the state's instant to `end`. False where it is no longer finite.
  bool advance(PlantState& state, double end);

  std::size_t steps() const { return steps_; }
  std::size_t evaluations() const { return evaluations_; }
  bool missed_tolerance() const { return missed_; }  ///< at some instant

 private:
  void evaluate(PlantState& state);
  /// `to` becomes the state h later, by way of `middle`; how far the last iteration moved it, in tolerances.
  double step(const PlantState& from, double h, PlantState& middle, PlantState& to);
  /// In tolerances.
  double distance(const std::vector<double>& a, const std::vector<double>& b) const;
  const Propagator& propagator(double h);
  int coarsest_level(double length) const;

  const PlantForces& forces_;
  IntegratorOptions options_;
  std::map<long long, Propagator> propagators_;
  PlantState middle_, whole_, half_, end_;
  std::vector<double> before_;
  int level_ = 0;  ///< a stretch is cut into 2^level steps
  std::size_t steps_ = 0, evaluations_ = 0;
  bool missed_ = false;
};

}  // namespace dashpot
