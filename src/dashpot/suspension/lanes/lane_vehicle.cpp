#include "dashpot/suspension/lanes/lane_vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/plants/linear.h"
#include "dashpot/suspension/plants/plant_forces.h"

namespace dashpot {
namespace {

/// Adds numbers one behind the other, as rows of lanes have them.
template <class Numbers>
void add_numbers(const Numbers& numbers, std::vector<double>& all) {
  static_assert(std::is_trivially_copyable_v<Numbers> && sizeof numbers % sizeof(double) == 0);
  const auto* first = reinterpret_cast<const double*>(&numbers);
  all.insert(all.end(), first, first + sizeof numbers / sizeof(double));
}

StrutNumbers<double> strut_numbers(const Strut& strut, const MountedDamper& damper) {
  return {resistance_of(strut), 1 / strut.friction_speed, damper.driver.lag_rate,
          model_lag_of(damper)};
}

/// Whether a plant is body and wheel with a strut between and a tyre below, as QuarterCarNumbers
/// has them.
bool is_quarter_car(const Plant& plant) {
  using Row = std::vector<double>;
  return plant.size() == 2 && plant.struts.size() == 1 && plant.tyres.size() == 1 &&
         plant.struts[0].row == Row{1, -1} && plant.struts[0].body_row == Row{1, 0} &&
         plant.tyres[0].row == Row{0, 1};
}

/// M q'' = -K q - C q' - row F + tyre P.
void set_quarter_car(const Plant& plant, const MountedDamper& damper, LaneVehicle& lane) {
  const LinearPlant linear = linear_plant(plant);
  const std::vector<double>& m = linear.mass;
  QuarterCarNumbers<double> n;

  // The inverse of M.
  const double determinant = m[0] * m[3] - m[1] * m[2];
  const double inverse[2][2] = {{m[3] / determinant, -m[1] / determinant},
                                {-m[2] / determinant, m[0] / determinant}};

  // Its product with each right-hand side.
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      n.by_state[i][k] =
          -(inverse[i][0] * linear.stiffness[k] + inverse[i][1] * linear.stiffness[2 + k]);
      n.by_state[i][2 + k] =
          -(inverse[i][0] * linear.damping[k] + inverse[i][1] * linear.damping[2 + k]);
    }
    n.by_force[i] = inverse[i][1] - inverse[i][0];
    n.by_push[i] = inverse[i][1];
  }
  n.tyre = contact_of(plant.tyres[0], plant.tyres_may_lift);
  n.strut = strut_numbers(plant.struts[0], damper);
  add_numbers(n, lane.numbers);
}

/// Any other plant, by the equations that simulate() has.
void set_equations(const BatchVehicle& vehicle, LaneVehicle& lane) {
  const Plant& plant = vehicle.setting.plant;
  const PlantForces forces(plant, vehicle.setting.ground);
  const std::size_t n = plant.size(), struts = plant.struts.size(), tyres = plant.tyres.size();
  LaneEquations& equations = lane.shape.equations;
  equations.coordinates = n;
  equations.struts = struts;
  equations.tyres = tyres;

  // Row by row what is not 0.
  std::size_t row = 0;
  const auto add = [&](const double* values, std::size_t count, std::size_t first_column) {
    for (std::size_t k = 0; k < count; ++k) {
      if (values[k] == 0) continue;
      equations.columns[lane.numbers.size()] = static_cast<std::uint8_t>(first_column + k);
      lane.numbers.push_back(values[k]);
    }
  };
  const auto end_row = [&] {
    equations.begins[++row] = static_cast<std::uint16_t>(lane.numbers.size());
  };
  for (std::size_t k = 0; k < n; ++k) {
    add(&forces.by_state()[k * 2 * n], 2 * n, 0);
    add(&forces.by_strut()[k * struts], struts, 2 * n);
    add(&forces.by_tyre()[k * tyres], tyres, 2 * n + struts);
    end_row();
  }
  const auto add_row = [&](const std::vector<double>& values) {
    add(values.data(), n, 0);
    end_row();
  };
  for (const Strut& strut : plant.struts) add_row(strut.row);
  for (const Strut& strut : plant.struts) add_row(strut.body_row);
  for (const Tyre& tyre : plant.tyres) add_row(tyre.row);

  // Tyres and struts.
  for (const Tyre& tyre : plant.tyres)
    add_numbers(contact_of(tyre, plant.tyres_may_lift), lane.numbers);
  for (std::size_t s = 0; s < struts; ++s)
    add_numbers(strut_numbers(plant.struts[s], vehicle.setting.dampers[s]), lane.numbers);
}

/// The place of the vehicle's control law in kLaneControls, where it sees the true signals and its
/// demands lead straight to currents; else kNoLaneControl.
std::size_t control_law_of(const BatchVehicle& vehicle, const ControlDescription& description) {
  const auto is_indirect = [](const MountedDamper& damper) {
    return damper.inverse || damper.loop.is_closed();
  };
  if (vehicle.sensors.in_car || std::ranges::any_of(vehicle.setting.dampers, is_indirect))
    return kNoLaneControl;
  return static_cast<std::size_t>(std::ranges::find(kLaneControls, description.law) -
                                  std::begin(kLaneControls));
}

/// The least and the greatest damping that a law of two states demands, found by asking for all
/// signs of its signals at slow and at quick motions.
std::array<double, 2> demands_of(const Controller& controller) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const double v : {-1.0, 0.0, 1.0})
    for (const double a : {-1e9, 0.0, 1e9})
      for (const double wheel : {-1.0, 1.0})
        for (const double d : {-1.0, 1.0}) {
          const StrutSignals signals{.body_velocity = v,
                                     .body_acceleration = a,
                                     .wheel_velocity = wheel,
                                     .deflection_velocity = d};
          DamperDemand demand;
          controller.step({&signals, 1}, {}, {}, {&demand, 1});
          range = {std::min(range[0], demand.value), std::max(range[1], demand.value)};
        }
  return range;
}

void set_control(const BatchVehicle& vehicle, LaneVehicle& lane) {
  if (!vehicle.setting.controller) return;
  lane.shape.controlled = true;
  const ControlDescription description = vehicle.setting.controller->description();
  lane.shape.control = control_law_of(vehicle, description);
  if (lane.shape.control == kNoLaneControl) return;

  // The currents that its two demands lead to, strut by strut.
  const auto [soft, hard] = demands_of(*vehicle.setting.controller);
  for (const MountedDamper& damper : vehicle.setting.dampers) {
    CommandPath path(damper, vehicle.limits, 0);
    const auto current = [&](double damping) {
      return std::clamp(path.command({DamperDemand::Kind::Damping, damping}, {}, 0),
                        damper.driver.current_min, damper.driver.current_max);
    };
    std::array<double, kLaneControlNumbers> numbers{};
    if (!description.parameters.empty()) numbers[kControlParameter] = description.parameters[0];
    numbers[kSoftCurrent] = current(soft);
    numbers[kHardCurrent] = current(hard);
    lane.control.insert(lane.control.end(), numbers.begin(), numbers.end());
  }
}

}  // namespace

LaneVehicle lane_vehicle(const BatchVehicle& vehicle) {
  const Plant& plant = vehicle.setting.plant;
  const std::vector<MountedDamper>& dampers = vehicle.setting.dampers;
  LaneVehicle lane{};
  if (is_quarter_car(plant))
    set_quarter_car(plant, dampers[0], lane);
  else
    set_equations(vehicle, lane);

  // The dampers, strut by strut.
  lane.shape.damper = lane_damper_shape(dampers[0]);
  lane.shape.moderate = lane.shape.equations.struts == 0 && is_moderate(dampers[0]);
  for (const MountedDamper& damper : dampers) {
    add_lane_damper(damper, lane.damper);
    add_lane_start(damper, lane.start);
  }

  // The rest of the shape, by which vehicles are grouped.
  lane.shape.resists_more =
      plant.tyres_may_lift || std::ranges::any_of(plant.struts, [](const Strut& strut) {
        return strut.friction > 0 || strut.extension_stop > 0 || strut.compression_stop > 0;
      });
  set_control(vehicle, lane);
  lane.shape.sample_time = sample_time_of(vehicle);
  return lane;
}

}  // namespace dashpot
