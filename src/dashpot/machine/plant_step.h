#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/lag.h"

namespace dashpot {

// One step of a plant and a damper in it, apart. Over the step the damper's force goes straight,
// so that the linear plant is brought over it exactly; the damper follows the motion that this
// makes by whatever is stable for it. The two meet in one number, the force at the end.

/// The numbers of a linear plant (plant_run.h), n x n and n, by the inverse of its mass.
struct PlantNumbers {
  std::size_t size;  ///< n
  const std::vector<double>&damping, &stiffness;
  std::vector<std::vector<double>> by_force;                  ///< per damper
  const std::vector<std::vector<double>>&by_value, &by_rate;  ///< per input
};

/// The inputs of a plant: per input, its value and rate at each point in time.
struct PlantInputSamples {
  const std::vector<std::vector<double>>&value, &rate;
};

/// A linear plant over a step of one length: q and q' at its end. Each input is the cubic that has
/// the values and rates of both ends.
class PlantStep {
 public:
  PlantStep(const PlantNumbers& plant, double length);

  /// The end, from `state` at `point`, for forces of the dampers that fall straight to 0.
  void end_without_force(const PlantInputSamples& inputs, std::size_t point, const double* state,
                         const double* forces, double* end) const;
  /// What each newton of a damper at the end adds.
  const std::vector<double>& by_end_force(std::size_t damper) const {
    return by_end_force_[damper];
  }

 private:
  template <std::size_t kCount>
  void end_of(const PlantInputSamples& inputs, std::size_t point, const double* state,
              const double* forces, double* end) const;

  std::size_t count_;  ///< of states
  double length_;
  std::vector<double> free_;  ///< count x count, a column per state at the start
  /// Per damper, of a newton at the start and at the end.
  std::vector<std::vector<double>> by_force_, by_end_force_;
  /// Per input, a column for each of 4 coefficients of the cubic, each over its factorial.
  std::vector<std::vector<double>> by_input_;
};

/// What a damper in a plant knows of a step.
struct DamperMotion {
  DamperInput from, to;   ///< to: without a force at the end
  double moves, hastens;  ///< what each newton at the end adds to displacement and velocity
  double force;           ///< at the start
};

/// The most states of a damper that a plant takes: those of three passive networks beside a law,
/// and as many once more.
constexpr std::size_t kMostDamperStates = 128;

/// Where a run arrived at the end of a step, and what each newton that had been presumed there
/// would have changed: of the damper's answer, and of its states.
struct StepTangent {
  double force = 0, answer = 0;
  std::span<const double> states = {};
};

/// The same over all steps of a run, in each damper by damper.
class RunTangent {
 public:
  void add(const StepTangent& step);
  StepTangent at(std::size_t step) const;
  std::size_t size() const { return first_.size(); }

 private:
  std::vector<std::size_t> first_;  ///< of a step among the numbers
  std::vector<double> numbers_;
};

/// A damper's way over steps of one length.
class DamperStep {
 public:
  DamperStep(const DamperModel& damper, double length);

  /// From now on each step is kept in `tangent`, behind those that are there, at two answers of
  /// the damper more; or each step begins beside that of `tangent`, of a run that differs hardly,
  /// so that one answer is enough. There this damper's steps are the first, `every` ones apart.
  void keep(RunTangent& tangent) { kept_ = &tangent; }
  void follow(const RunTangent& tangent, std::size_t first, std::size_t every) {
    followed_ = &tangent;
    step_ = first;
    every_ = every;
  }

  /// The force at the end, at which the damper arrives under the motion that this force makes;
  /// `state` is brought there. Found by the secant method, between bounds where the law resists.
  double end_force(const DamperMotion& motion, std::span<double> state);

 private:
  using States = std::array<double, kMostDamperStates>;
  double answer(const DamperMotion& motion, double force, std::span<const double> state,
                States& end) const;
  void advance(const DamperInput& from, const DamperInput& to, std::span<double> state) const;
  double force_at(const DamperInput& input, std::span<const double> state) const;
  double solve(const DamperMotion& motion, std::span<double> state);
  double solve_beside(const DamperMotion& motion, const StepTangent& tangent,
                      std::span<double> state);
  double keep_tangent(const DamperMotion& motion, double force, std::span<const double> before,
                      std::span<double> state);

  const DamperModel& damper_;
  const LawModel* law_;       ///< null unless it has a step of its own
  bool is_constant_ = false;  ///< the law's parameters are, and stand in `parameters_`
  std::array<double, kMaxParams> parameters_;
  double length_;
  LagWeights half_;     ///< of its coil over half the step
  double before_ = 0;   ///< the force a step ago
  double slope_ = 0;    ///< of the answer over the force that is presumed
  double largest_ = 0;  ///< force so far
  bool is_first_ = true;
  RunTangent* kept_ = nullptr;
  const RunTangent* followed_ = nullptr;
  std::size_t step_ = 0, every_ = 1;
  double beyond_ = 0;  ///< what the step before ended above the one that is followed, N
};

}  // namespace dashpot
