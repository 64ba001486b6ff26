#include "dashpot/machine/plant_run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/error.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

/// Room for the states of a plant and its damper, so that stepping allocates nothing.
constexpr std::size_t kMostStates = 64;

void require_linear(const Plant& plant) {
  const auto refuse = [&](const std::string& what, const std::string& right) {
    throw Error("plant " + plant.name, what, right);
  };
  for (const Strut& strut : plant.struts)
    if (strut.friction != 0 || strut.extension_stop != 0 || strut.compression_stop != 0)
      refuse("strut " + strut.name + " has stops or friction",
             "all but the damper must be linear: leave them out");
  if (plant.tyres_may_lift) refuse("its tyres may lift", "all but the damper must be linear");
  for (const Tyre& tyre : plant.tyres)
    if (tyre.behind != 0 || tyre.track != 0)
      refuse("its tyres meet the road at several places", "a plant of one axle on one track");
}

}  // namespace

std::string unit_of(PlantQuantity quantity) {
  switch (quantity) {
    case PlantQuantity::Displacement:
    case PlantQuantity::Deflection:
      return "m";
    case PlantQuantity::Velocity:
    case PlantQuantity::DeflectionVelocity:
      return "m/s";
    case PlantQuantity::Acceleration:
      return "m/s^2";
    case PlantQuantity::DamperForce:
      break;
  }
  return "N";
}

std::string unit_of(PlantInput input) {
  constexpr std::array kUnits{"N", "m", "m/s^2"};  // in the order of PlantInput
  return kUnits[static_cast<std::size_t>(input)];
}

DrivenPlant::DrivenPlant(const Plant& plant, std::size_t strut,
                         std::span<const PlantInputPlace> inputs)
    : size_(plant.size()) {
  require_linear(plant);
  if (2 * size_ + 16 > kMostStates)
    throw Error("plant " + plant.name, "has " + std::to_string(size_) + " coordinates",
                "at most " + std::to_string((kMostStates - 16) / 2));

  // Mass, damping and stiffness with the tyres on, by the inverse of the mass.
  const LinearPlant linear = linear_plant(plant);
  damping_ = solve_columns(linear.mass, linear.damping, size_);
  stiffness_ = solve_columns(linear.mass, linear.stiffness, size_);
  const Strut& place = plant.struts[strut];
  row_ = place.row;
  by_force_ = solve(linear.mass, row_);

  // What each input pushes: a coordinate, the tyres, or all that moves with the ground.
  for (const PlantInputPlace& input : inputs) {
    std::vector<double> value(size_), rate(size_), carried(size_);
    on_ground_.push_back(0);
    if (input.kind == PlantInput::Force) value[input.coordinate] = 1;
    if (input.kind == PlantInput::Ground) {
      for (const Tyre& tyre : plant.tyres)
        for (std::size_t k = 0; k < size_; ++k) {
          value[k] += tyre.row[k] * tyre.stiffness;
          rate[k] += tyre.row[k] * tyre.damping;
        }
      if (place.track) on_ground_.back() = 1;
    }
    if (input.kind == PlantInput::GroundAcceleration) {
      if (plant.ground.empty())
        throw Error("plant " + plant.name, "is not one that shakes with its ground",
                    "give it the ground's height, not its acceleration");
      carried = plant.ground;
      for (std::size_t i = 0; i < size_; ++i)
        for (std::size_t k = 0; k < size_; ++k)
          value[i] -= linear.mass[i * size_ + k] * plant.ground[k];
    }
    if (input.kind == PlantInput::Ground && plant.tyres.empty() && !place.track)
      throw Error("plant " + plant.name, "has no tyre on the ground",
                  "give it the ground's acceleration, not its height");
    by_value_.push_back(solve(linear.mass, value));
    by_rate_.push_back(solve(linear.mass, rate));
    carried_.push_back(std::move(carried));
  }
}

DamperInput DrivenPlant::damper_input(const PlantDriving& driving, std::size_t point,
                                      const double* state) const {
  DamperInput at{along(row_, state), along(row_, state + size_), driving.current[point]};
  for (std::size_t u = 0; u < on_ground_.size(); ++u) {
    at.displacement -= on_ground_[u] * driving.value[u][point];
    at.velocity -= on_ground_[u] * driving.rate[u][point];
  }
  return at;
}

void DrivenPlant::accelerations(const PlantDriving& driving, std::size_t point, const double* state,
                                double force, double* out) const {
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = -by_force_[i] * force;
    for (std::size_t k = 0; k < size_; ++k)
      sum -= damping_[i * size_ + k] * state[size_ + k] + stiffness_[i * size_ + k] * state[k];
    for (std::size_t u = 0; u < by_value_.size(); ++u)
      sum += by_value_[u][i] * driving.value[u][point] + by_rate_[u][i] * driving.rate[u][point];
    out[i] = sum;
  }
}

/// The rates of all states at a point in time; returns the damper's force.
double DrivenPlant::rates(const DamperModel& damper, const PlantDriving& driving, std::size_t point,
                          const double* state, double* out) const {
  const std::size_t own = damper.state_size();
  const double force = damper.flow(damper_input(driving, point, state), {state + 2 * size_, own},
                                   {out + 2 * size_, own});
  std::copy_n(state + size_, size_, out);
  accelerations(driving, point, state, force, out + size_);
  return force;
}

void DrivenPlant::settle(const DamperModel& damper, const PlantDriving& driving,
                         std::span<double> state) const {
  const DamperInput first = damper_input(driving, 0, state.data());
  DamperInput before = first;
  before.displacement -= driving.sample_time * first.velocity;
  damper.advance(before, first, driving.sample_time, state.subspan(2 * size_));
}

double DrivenPlant::stiffness_along() const {
  std::vector<double> pulled(size_);
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t k = 0; k < size_; ++k) pulled[i] += stiffness_[i * size_ + k] * by_force_[k];
  const double mass = mass_along();
  return mass * mass * along(row_, pulled.data());
}

/// What the sensors show at a sample; whether all of it is finite.
bool DrivenPlant::show(const PlantDriving& driving, std::size_t sample,
                       std::span<const PlantSensorPlace> sensors, const double* state,
                       const double* acceleration, double force,
                       std::vector<std::vector<double>>& shown) const {
  const std::size_t point = sample * driving.stride();
  const DamperInput at = damper_input(driving, point, state);
  bool finite = true;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const std::size_t q = sensors[s].coordinate;
    double value = 0;
    switch (sensors[s].quantity) {
      case PlantQuantity::Displacement:
        value = state[q];
        break;
      case PlantQuantity::Velocity:
        value = state[size_ + q];
        break;
      case PlantQuantity::Acceleration:
        // What an input that changes by leaps carries along comes on top of the state's rate.
        value = acceleration[q];
        for (std::size_t u = 0; u < carried_.size(); ++u)
          value += carried_[u][q] * driving.value[u][point];
        break;
      case PlantQuantity::Deflection:
        value = at.displacement;
        break;
      case PlantQuantity::DeflectionVelocity:
        value = at.velocity;
        break;
      case PlantQuantity::DamperForce:
        value = force;
        break;
    }
    finite &= std::isfinite(value);
    shown[s][sample] = value;
  }
  return finite;
}

bool DrivenPlant::run(const DamperModel& damper, const PlantDriving& driving, std::size_t samples,
                      std::span<const PlantSensorPlace> sensors, std::span<double> state,
                      std::vector<std::vector<double>>& shown, const RunBeside& beside) const {
  shown.assign(sensors.size(), std::vector<double>(samples));
  return driving.method == PlantMethod::RungeKutta
             ? run_by_runge_kutta(damper, driving, samples, sensors, state, shown)
             : run_under_straight_force(damper, driving, samples, sensors, state, shown, beside);
}

bool DrivenPlant::run_by_runge_kutta(const DamperModel& damper, const PlantDriving& driving,
                                     std::size_t samples, std::span<const PlantSensorPlace> sensors,
                                     std::span<double> state,
                                     std::vector<std::vector<double>>& shown) const {
  using States = std::array<double, kMostStates>;
  const std::size_t count = 2 * size_ + damper.state_size();
  const double h = driving.sample_time / static_cast<double>(driving.steps);
  States first, second, third, fourth, between;
  const auto moved = [&](const States& rate, double length) {
    for (std::size_t k = 0; k < count; ++k) between[k] = state[k] + length * rate[k];
    return between.data();
  };

  // The inputs are known at the start, middle and end of every step.
  for (std::size_t point = 0, step = 0;; point += 2, ++step) {
    const double force = rates(damper, driving, point, state.data(), first.data());
    if (step % driving.steps == 0) {
      const std::size_t sample = step / driving.steps;
      if (!show(driving, sample, sensors, state.data(), first.data() + size_, force, shown))
        return false;
      if (sample + 1 == samples) return true;
    }
    rates(damper, driving, point + 1, moved(first, h / 2), second.data());
    rates(damper, driving, point + 1, moved(second, h / 2), third.data());
    rates(damper, driving, point + 2, moved(third, h), fourth.data());
    for (std::size_t k = 0; k < count; ++k)
      state[k] += h / 6 * (first[k] + 2 * (second[k] + third[k]) + fourth[k]);
  }
}

bool DrivenPlant::run_under_straight_force(const DamperModel& damper, const PlantDriving& driving,
                                           std::size_t samples,
                                           std::span<const PlantSensorPlace> sensors,
                                           std::span<double> state,
                                           std::vector<std::vector<double>>& shown,
                                           const RunBeside& beside) const {
  const double h = driving.sample_time / static_cast<double>(driving.steps);
  const PlantStep plant({size_, damping_, stiffness_, by_force_, by_value_, by_rate_}, h);
  DamperStep step(damper, h);
  if (beside.keep) step.keep(*beside.keep);
  if (beside.follow) step.follow(*beside.follow);
  std::array<double, kMostStates> end, acceleration;
  const std::span<double> own = state.subspan(2 * size_);
  DamperInput from = damper_input(driving, 0, state.data());
  double force = damper.force(from, own);

  for (std::size_t point = 0;; ++point) {
    if (point % driving.steps == 0) {
      const std::size_t sample = point / driving.steps;
      accelerations(driving, point, state.data(), force, acceleration.data());
      if (!show(driving, sample, sensors, state.data(), acceleration.data(), force, shown))
        return false;
      if (sample + 1 == samples) return true;
    }

    // Where the plant ends without a force at the end, and what each newton there adds.
    plant.end_without_force({driving.value, driving.rate}, point, state.data(), force, end.data());
    const DamperInput without = damper_input(driving, point + 1, end.data());
    const std::vector<double>& per_newton = plant.by_end_force();
    const double moves = along(row_, per_newton.data());
    const double hastens = along(row_, per_newton.data() + size_);

    // The force that the damper has after the motion which that force makes.
    force = step.end_force({from, without, moves, hastens, force}, own);
    for (std::size_t k = 0; k < 2 * size_; ++k) state[k] = end[k] + per_newton[k] * force;
    from = damper_input(driving, point + 1, state.data());
  }
}

}  // namespace dashpot
