#include "dashpot/machine/plant_run.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "dashpot/error.h"
#include "dashpot/machine/force_leap.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

void require_linear(const Plant& plant) {
  const auto refuse = [&](const std::string& what, const std::string& right) {
    throw Error("plant " + plant.name, what, right);
  };
  for (const Strut& strut : plant.struts)
    if (strut.friction != 0 || strut.extension_stop != 0 || strut.compression_stop != 0)
      refuse("strut " + strut.name + " has stops or friction",
             "all but the damper must be linear: leave them out");
  if (plant.tyres_may_lift) refuse("its tyres may lift", "all but the damper must be linear");
}

/// Whether a run has forgotten its beginning, and with it what it differs in from another one.
class ComesBack {
 public:
  using Shown = std::vector<std::vector<double>>;

  ComesBack(const Shown* other, Shown& shown)
      : other_(other), shown_(shown), largest_(shown.size()), reach_(shown.size()) {}

  /// To be asked at each sample, once it is shown; then the rest is that of the other.
  bool at(std::size_t sample) {
    if (!other_) return false;
    constexpr double kForgotten = 1e-6;  // of the largest difference
    constexpr double kHardly = 0.1;      // of what is shown; beyond, nothing is taken for forgotten
    constexpr std::size_t kFewest = 200, kShare = 2;
    for (std::size_t s = 0; s < shown_.size(); ++s) {
      const double apart = std::abs(shown_[s][sample] - (*other_)[s][sample]);
      largest_[s] = std::max(largest_[s], apart);
      reach_[s] = std::max(reach_[s], std::abs((*other_)[s][sample]));
      if (apart > kForgotten * largest_[s] || largest_[s] > kHardly * reach_[s])
        apart_until_ = sample + 1;
    }

    // For half as long again as it took, so that no swing of a slow motion passes for its end.
    if (sample < apart_until_ + std::max(kFewest, apart_until_ / kShare)) return false;
    for (std::size_t s = 0; s < shown_.size(); ++s)
      std::copy((*other_)[s].begin() + static_cast<std::ptrdiff_t>(sample),
                (*other_)[s].begin() + static_cast<std::ptrdiff_t>(shown_[s].size()),
                shown_[s].begin() + static_cast<std::ptrdiff_t>(sample));
    return true;
  }

 private:
  const Shown* other_;
  Shown& shown_;
  std::vector<double> largest_, reach_;
  std::size_t apart_until_ = 0;
};

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

std::string unit_of(const PlantSensorPlace& place, const Plant& plant) {
  const std::string unit = unit_of(place.quantity);
  return place.is_of_damper() ? unit : plant.coordinates[place.coordinate].unit + unit.substr(1);
}

std::string unit_of(PlantInput input) {
  constexpr std::array kUnits{"N", "m", "m/s^2"};  // in the order of PlantInput
  return kUnits[static_cast<std::size_t>(input)];
}

bool has_several_roads(const Plant& plant) {
  return std::ranges::any_of(plant.tyres,
                             [](const Tyre& tyre) { return tyre.behind != 0 || tyre.track != 0; });
}

DrivenPlant::DrivenPlant(const Plant& plant, std::span<const PlantInputPlace> inputs)
    : size_(plant.size()) {
  require_linear(plant);
  if (size_ > kMostCoordinates)
    throw Error("plant " + plant.name, "has " + std::to_string(size_) + " coordinates",
                "at most " + std::to_string(kMostCoordinates));
  assert(!plant.struts.empty() && plant.struts.size() <= kMostDampers);

  // Mass, damping and stiffness with the tyres on, by the inverse of the mass.
  const LinearPlant linear = linear_plant(plant);
  damping_ = solve_columns(linear.mass, linear.damping, size_);
  stiffness_ = solve_columns(linear.mass, linear.stiffness, size_);
  for (const Strut& strut : plant.struts)
    dampers_.push_back({strut.row, solve(linear.mass, strut.row), {}, false});

  // What each input pushes: a coordinate, the tyres, or all that moves with the ground.
  for (const PlantInputPlace& input : inputs) {
    std::vector<double> value(size_), rate(size_), carried(size_);
    for (std::size_t d = 0; d < dampers_.size(); ++d) {
      const bool stands = input.kind == PlantInput::Ground && plant.struts[d].track;
      dampers_[d].on_ground.push_back(stands ? 1 : 0);
      dampers_[d].stands_on_ground |= stands;
    }
    if (input.kind == PlantInput::Force) value[input.coordinate] = 1;
    if (input.kind == PlantInput::Ground) {
      if (!input.tyre && has_several_roads(plant))
        throw Error("plant " + plant.name, "its tyres meet the road at several places",
                    "an input under each of them");
      for (std::size_t w = 0; w < plant.tyres.size(); ++w) {
        const Tyre& tyre = plant.tyres[w];
        if (input.tyre && *input.tyre != w) continue;
        for (std::size_t k = 0; k < size_; ++k) {
          value[k] += tyre.row[k] * tyre.stiffness;
          rate[k] += tyre.row[k] * tyre.damping;
        }
      }
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
    if (input.kind == PlantInput::Ground && plant.tyres.empty() &&
        std::ranges::none_of(plant.struts, [](const Strut& one) { return one.track.has_value(); }))
      throw Error("plant " + plant.name, "has no tyre on the ground",
                  "give it the ground's acceleration, not its height");
    by_value_.push_back(solve(linear.mass, value));
    by_rate_.push_back(solve(linear.mass, rate));
    carried_.push_back(std::move(carried));
  }
}

std::vector<double> DrivenPlant::at_rest(PlacedDampers dampers, const PlantDriving& driving) const {
  assert(dampers.size() == dampers_.size() && driving.current.size() == dampers_.size());
  std::vector<double> state(2 * size_);
  for (std::size_t d = 0; d < dampers.size(); ++d) {
    std::vector<double> own(dampers[d]->state_size());
    dampers[d]->rest({0, 0, driving.current[d].front()}, own);
    state.insert(state.end(), own.begin(), own.end());
  }
  return state;
}

DamperInput DrivenPlant::damper_input(std::size_t damper, const PlantDriving& driving,
                                      std::size_t point, const double* state) const {
  const DamperPlace& place = dampers_[damper];
  DamperInput at{along(place.row, state), along(place.row, state + size_),
                 driving.current[damper][point]};
  for (std::size_t u = 0; place.stands_on_ground && u < place.on_ground.size(); ++u) {
    at.displacement -= place.on_ground[u] * driving.value[u][point];
    at.velocity -= place.on_ground[u] * driving.rate[u][point];
  }
  return at;
}

void DrivenPlant::accelerations(const PlantDriving& driving, std::size_t point, const double* state,
                                const double* forces, double* out) const {
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = -dampers_[0].by_force[i] * forces[0];
    for (std::size_t d = 1; d < dampers_.size(); ++d) sum -= dampers_[d].by_force[i] * forces[d];
    for (std::size_t k = 0; k < size_; ++k)
      sum -= damping_[i * size_ + k] * state[size_ + k] + stiffness_[i * size_ + k] * state[k];
    for (std::size_t u = 0; u < by_value_.size(); ++u)
      sum += by_value_[u][i] * driving.value[u][point] + by_rate_[u][i] * driving.rate[u][point];
    out[i] = sum;
  }
}

/// The rates of all states at a point in time, and the forces of the dampers, which go over
/// their leaps in a line.
void DrivenPlant::rates(PlacedDampers dampers, const PlantDriving& driving, std::size_t point,
                        const double* state, double* out, Forces& forces,
                        std::span<const ForceLeap> leaps) const {
  std::size_t first = 2 * size_;
  for (std::size_t d = 0; d < dampers_.size(); ++d) {
    const std::size_t own = dampers[d]->state_size();
    const DamperInput at = damper_input(d, driving, point, state);
    forces[d] = dampers[d]->flow(at, {state + first, own}, {out + first, own}) -
                leaps[d].beyond_line(at, {state + first, own});
    first += own;
  }
  std::copy_n(state + size_, size_, out);
  accelerations(driving, point, state, forces.data(), out + size_);
}

void DrivenPlant::settle(PlacedDampers dampers, const PlantDriving& driving,
                         std::span<double> state) const {
  std::size_t place = 2 * size_;
  for (std::size_t d = 0; d < dampers_.size(); ++d) {
    const std::size_t own = dampers[d]->state_size();
    const DamperInput first = damper_input(d, driving, 0, state.data());
    DamperInput before = first;
    before.displacement -= driving.sample_time * first.velocity;
    dampers[d]->advance(before, first, driving.sample_time, state.subspan(place, own));
    place += own;
  }
}

double DrivenPlant::mass_along() const {
  double sum = 0;
  for (const DamperPlace& place : dampers_) sum += 1 / along(place.row, place.by_force.data());
  return sum / static_cast<double>(dampers_.size());
}

double DrivenPlant::stiffness_along() const {
  double sum = 0;
  for (const DamperPlace& place : dampers_) {
    std::vector<double> pulled(size_);
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t k = 0; k < size_; ++k)
        pulled[i] += stiffness_[i * size_ + k] * place.by_force[k];
    const double mass = 1 / along(place.row, place.by_force.data());
    sum += mass * mass * along(place.row, pulled.data());
  }
  return sum / static_cast<double>(dampers_.size());
}

/// What the sensors show at a sample; whether all of it is finite.
bool DrivenPlant::show(const PlantDriving& driving, std::size_t sample,
                       std::span<const PlantSensorPlace> sensors, const double* state,
                       const double* acceleration, const double* forces,
                       std::vector<std::vector<double>>& shown) const {
  const std::size_t point = sample * driving.stride();
  bool finite = true;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const std::size_t q = sensors[s].coordinate, strut = sensors[s].strut;
    const auto motion = [&] { return damper_input(strut, driving, point, state); };
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
        value = motion().displacement;
        break;
      case PlantQuantity::DeflectionVelocity:
        value = motion().velocity;
        break;
      case PlantQuantity::DamperForce:
        value = forces[strut];
        break;
    }
    finite &= std::isfinite(value);
    shown[s][sample] = value;
  }
  return finite;
}

bool DrivenPlant::run(PlacedDampers dampers, const PlantDriving& driving, std::size_t samples,
                      std::span<const PlantSensorPlace> sensors, std::span<double> state,
                      std::vector<std::vector<double>>& shown, const RunBeside& beside) const {
  assert(dampers.size() == dampers_.size());
  shown.assign(sensors.size(), std::vector<double>(samples));
  if (driving.method == PlantMethod::RungeKutta)
    return run_by_runge_kutta(dampers, driving, samples, sensors, state, shown, beside);
  return run_under_straight_force(dampers, driving, samples, sensors, state, shown, beside);
}

std::vector<ForceLeap> DrivenPlant::leaps_of(PlacedDampers dampers,
                                             const PlantDriving& driving) const {
  std::vector<ForceLeap> leaps;
  for (std::size_t d = 0; d < dampers_.size(); ++d) {
    const DamperPlace& place = dampers_[d];
    const auto [low, high] = std::ranges::minmax(driving.current[d]);
    leaps.emplace_back(*dampers[d], low, high, driving.leap_time,
                       along(place.row, place.by_force.data()));
  }
  return leaps;
}

bool DrivenPlant::run_by_runge_kutta(PlacedDampers dampers, const PlantDriving& driving,
                                     std::size_t samples, std::span<const PlantSensorPlace> sensors,
                                     std::span<double> state,
                                     std::vector<std::vector<double>>& shown,
                                     const RunBeside& beside) const {
  using States = std::array<double, kMostStates>;
  const std::size_t count = state.size();
  const double h = driving.sample_time / static_cast<double>(driving.steps);
  States first, second, third, fourth, between;
  Forces forces, on_the_way;
  const auto moved = [&](const States& rate, double length) {
    for (std::size_t k = 0; k < count; ++k) between[k] = state[k] + length * rate[k];
    return between.data();
  };

  ComesBack comes_back(beside.comes_back_to, shown);
  const std::vector<ForceLeap> leaps = leaps_of(dampers, driving);

  // The inputs are known at the start, middle and end of every step.
  for (std::size_t point = 0, step = 0;; point += 2, ++step) {
    rates(dampers, driving, point, state.data(), first.data(), forces, leaps);
    if (step % driving.steps == 0) {
      const std::size_t sample = step / driving.steps;
      if (!show(driving, sample, sensors, state.data(), first.data() + size_, forces.data(), shown))
        return false;
      if (sample + 1 == samples || comes_back.at(sample)) return true;
    }
    rates(dampers, driving, point + 1, moved(first, h / 2), second.data(), on_the_way, leaps);
    rates(dampers, driving, point + 1, moved(second, h / 2), third.data(), on_the_way, leaps);
    rates(dampers, driving, point + 2, moved(third, h), fourth.data(), on_the_way, leaps);
    for (std::size_t k = 0; k < count; ++k)
      state[k] += h / 6 * (first[k] + 2 * (second[k] + third[k]) + fourth[k]);
  }
}

bool DrivenPlant::run_under_straight_force(PlacedDampers dampers, const PlantDriving& driving,
                                           std::size_t samples,
                                           std::span<const PlantSensorPlace> sensors,
                                           std::span<double> state,
                                           std::vector<std::vector<double>>& shown,
                                           const RunBeside& beside) const {
  const double h = driving.sample_time / static_cast<double>(driving.steps);
  const std::size_t count = dampers_.size();
  PlantNumbers numbers{size_, damping_, stiffness_, {}, by_value_, by_rate_};
  for (const DamperPlace& place : dampers_) numbers.by_force.push_back(place.by_force);
  const PlantStep plant(numbers, h);

  // Each damper with its states, and what each newton at the end adds to its motion, of every one.
  std::vector<DamperStep> steps;
  std::vector<std::span<double>> states;
  std::array<Forces, kMostDampers> moves, hastens;
  for (std::size_t d = 0, place = 2 * size_; d < count; ++d) {
    steps.emplace_back(*dampers[d], h);
    if (beside.keep) steps[d].keep(*beside.keep);
    if (beside.follow) steps[d].follow(*beside.follow, d, count);
    states.push_back(state.subspan(place, dampers[d]->state_size()));
    place += states.back().size();
    for (std::size_t e = 0; e < count; ++e) {
      moves[d][e] = along(dampers_[d].row, plant.by_end_force(e).data());
      hastens[d][e] = along(dampers_[d].row, plant.by_end_force(e).data() + size_);
    }
  }
  std::array<DamperInput, kMostDampers> from;
  Forces forces, next;
  for (std::size_t d = 0; d < count; ++d) {
    from[d] = damper_input(d, driving, 0, state.data());
    forces[d] = next[d] = dampers[d]->force(from[d], states[d]);
  }

  ComesBack comes_back(beside.comes_back_to, shown);
  std::array<double, kMostStates> end, acceleration;
  for (std::size_t point = 0;; ++point) {
    if (point % driving.steps == 0) {
      const std::size_t sample = point / driving.steps;
      accelerations(driving, point, state.data(), forces.data(), acceleration.data());
      if (!show(driving, sample, sensors, state.data(), acceleration.data(), forces.data(), shown))
        return false;
      if (sample + 1 == samples || comes_back.at(sample)) return true;
    }

    // Where the plant ends without forces at the end; each damper's force there is that which it
    // has after the motion which that force makes, beside what the others are expected to have.
    plant.end_without_force({driving.value, driving.rate}, point, state.data(), forces.data(),
                            end.data());
    for (std::size_t d = 0; d < count; ++d) {
      DamperInput without = damper_input(d, driving, point + 1, end.data());
      for (std::size_t e = 0; e < count; ++e) {
        if (e == d) continue;
        without.displacement += moves[d][e] * next[e];
        without.velocity += hastens[d][e] * next[e];
      }
      next[d] =
          steps[d].end_force({from[d], without, moves[d][d], hastens[d][d], forces[d]}, states[d]);
    }

    for (std::size_t k = 0; k < 2 * size_; ++k) {
      state[k] = end[k];
      for (std::size_t d = 0; d < count; ++d) state[k] += plant.by_end_force(d)[k] * next[d];
    }
    for (std::size_t d = 0; d < count; ++d) {
      from[d] = damper_input(d, driving, point + 1, state.data());
      const double last = forces[d];
      forces[d] = next[d];
      next[d] = 2 * forces[d] - last;
    }
  }
}

}  // namespace dashpot
