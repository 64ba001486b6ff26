#include "dashpot/suspension/lanes/lane_vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

/// The plant's own part: M q'' = -K q - C q' - row F + tyre P.
void set_plant(const Plant& plant, QuarterCarNumbers<double>& n) {
  const LinearPlant linear = linear_plant(plant);
  const std::vector<double>& m = linear.mass;

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
}

/// Whether no neuron of the first layer exceeds kMostAtRest at any of the driver's currents.
bool is_moderate(const Mlp& mlp, const LaneNetwork& shape, const DriverOptions& driver) {
  const double current = std::max(std::abs(driver.current_min), std::abs(driver.current_max));
  const std::size_t inputs = mlp.layers[0], neurons = mlp.layers[1];
  for (std::size_t n = 0; n < neurons; ++n) {
    double sum = std::abs(mlp.parameters[inputs * neurons + n]);
    for (std::size_t i = 0; i < inputs; ++i)
      if (shape.inputs[i] == LaneInput::Current)
        sum += current * std::abs(mlp.parameters[n * inputs + i]);
    if (!(sum <= kMostAtRest)) return false;
  }
  return true;
}

void set_network(const NetworkModel& model, const DriverOptions& driver, LaneVehicle& lane) {
  const Mlp mlp = on_raw_inputs(model.members()[0]);
  LaneNetwork& shape = lane.shape.network;
  shape.count = mlp.layers.size() - 1;
  for (std::size_t i = 0; i < model.inputs().size(); ++i)
    shape.inputs[i] = model.inputs()[i] == "displacement" ? LaneInput::Displacement
                      : model.inputs()[i] == "velocity"   ? LaneInput::Velocity
                                                          : LaneInput::Current;
  for (std::size_t l = 0; l < shape.count; ++l)
    shape.layers[l] = {mlp.layers[l], mlp.layers[l + 1], mlp.activation(l + 1)};
  lane.shape.moderate = is_moderate(mlp, shape, driver);
  lane.damper = mlp.parameters;
  lane.damper.push_back(mlp.output_scale);
  lane.damper.push_back(mlp.output_mean + model.offset());
}

void set_law(const LawModel& model, LaneVehicle& lane) {
  const std::size_t count = model.law().params.size();
  lane.shape.kind = LaneDamperKind::Law;
  lane.shape.law = static_cast<std::size_t>(std::ranges::find(kLaneLaws, model.law().name) -
                                            std::begin(kLaneLaws));
  lane.damper.assign(kLanePowers * count, 0);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t power = 0; power < model.parameters().coefficients[k].size(); ++power)
      lane.damper[power * count + k] = model.parameters().coefficients[k][power];
  lane.numbers.model_lag = model.lag_rate();
}

/// The place of the vehicle's control law in kLaneControls, where it sees the true signals and its
/// demand leads straight to a current; else kNoLaneControl.
std::size_t control_law_of(const BatchVehicle& vehicle, const ControlDescription& description) {
  const MountedDamper& damper = vehicle.setting.dampers[0];
  if (vehicle.sensors.in_car || damper.inverse || damper.loop.is_closed()) return kNoLaneControl;
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

  // The currents that its two demands lead to.
  const MountedDamper& damper = vehicle.setting.dampers[0];
  CommandPath path(damper, vehicle.limits, 0);
  const auto current = [&](double damping) {
    return std::clamp(path.command({DamperDemand::Kind::Damping, damping}, {}, 0),
                      damper.driver.current_min, damper.driver.current_max);
  };
  const auto [soft, hard] = demands_of(*vehicle.setting.controller);
  lane.control.assign(kLaneControlNumbers, 0);
  if (!description.parameters.empty()) lane.control[kControlParameter] = description.parameters[0];
  lane.control[kSoftCurrent] = current(soft);
  lane.control[kHardCurrent] = current(hard);
}

/// Command, the currents in coil and model, the law's states: after a long rest.
std::vector<double> start_of(const MountedDamper& damper, const LaneVehicle& lane) {
  const double command =
      std::clamp(damper.current, damper.driver.current_min, damper.driver.current_max);
  std::vector<double> state(damper.model->state_size());
  damper.model->rest({0, 0, damper.current}, state);
  double inner = command;
  if (lane.numbers.model_lag > 0) {
    inner = state.back();
    state.pop_back();
  }
  state.insert(state.begin(), {command, command, inner});
  return state;
}

}  // namespace

LaneVehicle lane_vehicle(const BatchVehicle& vehicle) {
  const Plant& plant = vehicle.setting.plant;
  const MountedDamper& damper = vehicle.setting.dampers[0];

  // The plant.
  LaneVehicle lane{};
  set_plant(plant, lane.numbers);
  lane.numbers.tyre = contact_of(plant.tyres[0], plant.tyres_may_lift);
  lane.numbers.strut = resistance_of(plant.struts[0]);
  lane.numbers.friction_slope = 1 / plant.struts[0].friction_speed;
  lane.numbers.driver_lag = damper.driver.lag_rate;

  // The damper.
  if (const auto* network = model_as<NetworkModel>(*damper.model))
    set_network(*network, damper.driver, lane);
  else
    set_law(*model_as<LawModel>(*damper.model), lane);

  // The shape, by which vehicles are grouped.
  const Strut& strut = plant.struts[0];
  lane.shape.lags = (lane.numbers.driver_lag > 0) + (lane.numbers.model_lag > 0);
  lane.shape.resists_more = plant.tyres_may_lift || strut.friction > 0 ||
                            strut.extension_stop > 0 || strut.compression_stop > 0;
  set_control(vehicle, lane);
  lane.shape.sample_time = sample_time_of(vehicle);
  lane.start = start_of(damper, lane);
  return lane;
}

}  // namespace dashpot
