#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/machine/plant_step.h"
#include "dashpot/plant.h"

namespace dashpot {

// A linear plant with a damper in each of its struts, run under measured inputs, several steps per
// sample. What is not linear in it are the dampers alone.

class ForceLeap;

/// What moves a plant from outside.
enum class PlantInput {
  Force,              ///< N, on a coordinate
  Ground,             ///< m, height under tyres and under struts that stand on the ground
  GroundAcceleration  ///< m/s^2, where the plant's coordinates are relative to the ground
};

/// One input in use: its kind, of a force the coordinate that it pushes, of a ground the tyre that
/// stands on it (nothing: all of them).
struct PlantInputPlace {
  PlantInput kind = PlantInput::Force;
  std::size_t coordinate = 0;
  std::optional<std::size_t> tyre = {};
};

/// What a sensor on a plant shows.
enum class PlantQuantity {
  Displacement,        ///< m, of a coordinate (relative to ground that shakes)
  Velocity,            ///< m/s, likewise
  Acceleration,        ///< m/s^2, of a coordinate, absolute
  Deflection,          ///< m, of a damper, extension positive
  DeflectionVelocity,  ///< m/s
  DamperForce          ///< N, positive where it resists extension
};

/// A sensor's quantity and, where it is one of a coordinate, which; else whose damper's.
struct PlantSensorPlace {
  PlantQuantity quantity = PlantQuantity::Displacement;
  std::size_t coordinate = 0;
  std::size_t strut = 0;

  bool is_of_damper() const { return quantity >= PlantQuantity::Deflection; }
};

/// The unit of what a sensor of this quantity shows, of a plant whose coordinates are lengths or of
/// any; and of an input.
std::string unit_of(PlantQuantity quantity);
std::string unit_of(const PlantSensorPlace& place, const Plant& plant);
std::string unit_of(PlantInput input);

/// Whether a plant's tyres meet the road at several places, each of which has a height of its own.
bool has_several_roads(const Plant& plant);

/// How plant and damper are brought over a step.
enum class PlantMethod {
  /// The classical Runge-Kutta method for both together: of fourth order, and unstable where the
  /// damper is stiff.
  RungeKutta,
  /// The plant exactly under a force that goes straight over the step, the damper by its own step
  /// along the motion that this makes, and the force at the end such that both agree: of second
  /// order, and stable however stiff the damper is (plant_step.h). Each of several dampers expects
  /// of the others that their forces go on as they did over the step before.
  StraightForce
};

/// The inputs at every instant that the integrator asks for. Each input has a value and a rate
/// there; the drives of the dampers stand beside them.
struct PlantDriving {
  double sample_time = 0;
  std::size_t samples = 0, steps = 1;  ///< steps: of the integrator per sample
  PlantMethod method = PlantMethod::RungeKutta;
  std::vector<std::vector<double>> value, rate;  ///< per input, per point
  std::vector<std::vector<double>> current;      ///< A or V, per damper, per point
  /// s, by Runge-Kutta: in which a force goes over its leap (force_leap.h); 0: at once.
  double leap_time = 0;

  /// Points per sample: Runge-Kutta asks in the middle of each step too.
  std::size_t stride() const { return points_per_sample(steps, method); }
  std::size_t points() const { return (samples - 1) * stride() + 1; }
  static std::size_t points_per_sample(std::size_t steps, PlantMethod method) {
    return method == PlantMethod::RungeKutta ? 2 * steps : steps;
  }
};

/// Runs of which one differs hardly from the other.
struct RunBeside {
  /// Under a force that goes straight: one that keeps its steps in a tangent, or one that follows
  /// it at half the price.
  RunTangent* keep = nullptr;
  const RunTangent* follow = nullptr;
  /// What the other one shows, by a run that differs from it in its beginning alone: once that is
  /// forgotten, the rest is taken from there.
  const std::vector<std::vector<double>>* comes_back_to = nullptr;
};

/// A damper for each strut of a plant, in their order; one may stand in several.
using PlacedDampers = std::span<const DamperModel* const>;

/// Where a damper stands in a plant of n coordinates.
struct DamperPlace {
  std::vector<double> row;        ///< n: its deflection
  std::vector<double> by_force;   ///< n: of its force, by the inverse of the mass
  std::vector<double> on_ground;  ///< per input: what it takes from the deflection
  bool stands_on_ground = false;  ///< some input does
};

/// The plant as numbers: q'' = forcing - C q' - K q - sum of row F, all by the inverse of the mass.
class DrivenPlant {
 public:
  /// A damper is to stand in each strut. Throws Error where the plant is not linear (stops,
  /// friction, a tyre that lifts), where an input does not say under which of several tyres it is,
  /// and where it finds nothing to move.
  DrivenPlant(const Plant& plant, std::span<const PlantInputPlace> inputs);

  std::size_t size() const { return size_; }
  const std::vector<DamperPlace>& dampers() const { return dampers_; }

  /// Coordinates, velocities and the states of these dampers, one for each strut, with these at
  /// rest under what drives them first; the states of one follow those of the other.
  std::vector<double> at_rest(PlacedDampers dampers, const PlantDriving& driving) const;
  /// Runs the plant with these dampers from `state` (q, q', states of each damper) over the first
  /// so many samples; `state` is then that at the last of them. Per sensor `shown` gets the
  /// samples. False where one of them is not finite. By Runge-Kutta each damper must be one that
  /// flows. Where it comes back to another run, `state` is that at which it was left.
  bool run(PlacedDampers dampers, const PlantDriving& driving, std::size_t samples,
           std::span<const PlantSensorPlace> sensors, std::span<double> state,
           std::vector<std::vector<double>>& shown, const RunBeside& beside = {}) const;
  /// Brings the states of each damper over the sample before the first one, at the velocity of
  /// that: what a sharp hysteresis forgets at once is then no leap within the first step.
  void settle(PlacedDampers dampers, const PlantDriving& driving, std::span<double> state) const;
  /// Stiffness along a damper's way, N/m: of the plant alone; and the mass that it moves, kg: the
  /// means over the dampers.
  double stiffness_along() const;
  double mass_along() const;

  // The numbers themselves, for whoever solves the equations in another way. Matrices are n x n,
  // by the inverse of the mass.
  const std::vector<double>& damping() const { return damping_; }
  const std::vector<double>& stiffness() const { return stiffness_; }
  /// Per input what it pushes by its value and by its rate, and what it adds to an absolute
  /// acceleration, n each.
  const std::vector<std::vector<double>>& by_value() const { return by_value_; }
  const std::vector<std::vector<double>>& by_rate() const { return by_rate_; }
  const std::vector<std::vector<double>>& carried() const { return carried_; }

 private:
  static constexpr std::size_t kMostDampers = 4, kMostCoordinates = 24;
  /// Room for the states of a plant and its dampers, so that stepping allocates nothing.
  static constexpr std::size_t kMostStates =
      2 * kMostCoordinates + kMostDampers * kMostDamperStates;
  using Forces = std::array<double, kMostDampers>;

  bool run_by_runge_kutta(PlacedDampers dampers, const PlantDriving& driving, std::size_t samples,
                          std::span<const PlantSensorPlace> sensors, std::span<double> state,
                          std::vector<std::vector<double>>& shown, const RunBeside& beside) const;
  bool run_under_straight_force(PlacedDampers dampers, const PlantDriving& driving,
                                std::size_t samples, std::span<const PlantSensorPlace> sensors,
                                std::span<double> state, std::vector<std::vector<double>>& shown,
                                const RunBeside& beside) const;
  void accelerations(const PlantDriving& driving, std::size_t point, const double* state,
                     const double* forces, double* out) const;
  bool show(const PlantDriving& driving, std::size_t sample,
            std::span<const PlantSensorPlace> sensors, const double* state,
            const double* acceleration, const double* forces,
            std::vector<std::vector<double>>& shown) const;
  void rates(PlacedDampers dampers, const PlantDriving& driving, std::size_t point,
             const double* state, double* out, Forces& forces,
             std::span<const ForceLeap> leaps) const;
  /// Of each damper.
  std::vector<ForceLeap> leaps_of(PlacedDampers dampers, const PlantDriving& driving) const;
  DamperInput damper_input(std::size_t damper, const PlantDriving& driving, std::size_t point,
                           const double* state) const;

  std::size_t size_ = 0;
  std::vector<double> damping_, stiffness_;  ///< by the inverse of the mass, n x n
  std::vector<DamperPlace> dampers_;
  /// Per input, n: of its value and of its rate.
  std::vector<std::vector<double>> by_value_, by_rate_;
  /// Per input, n: what it adds to an absolute acceleration.
  std::vector<std::vector<double>> carried_;
};

}  // namespace dashpot
