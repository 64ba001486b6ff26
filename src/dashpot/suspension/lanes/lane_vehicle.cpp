#include "dashpot/suspension/lanes/lane_vehicle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

constexpr double kLongestSample = 2.5e-3;  // s: what the weighting of ISO 2631-1 can filter

std::string against_plant(const Plant& plant) {
  using Row = std::vector<double>;
  const bool quarter_car = plant.size() == 2 && plant.struts.size() == 1 &&
                           plant.tyres.size() == 1 && plant.ground.empty() &&
                           !plant.struts[0].track && plant.struts[0].row == Row{1, -1} &&
                           plant.struts[0].body_row == Row{1, 0} && plant.tyres[0].row == Row{0, 1};
  return quarter_car ? "" : "the plant is no quarter car";
}

std::string against_network(const NetworkModel& model) {
  if (model.members().size() > 1) return "its network is one of several";
  return model.members()[0].layers.size() > LaneNetwork::kMostLayers
             ? "its network has too many layers"
             : "";
}

std::string against_law(const LawModel& model) {
  const std::span names = lane_law_table();
  if (std::find(names.begin(), names.end(), model.law().name) == names.end())
    return "the law " + model.name() + " has no lanes";
  for (const Form form : model.parameters().forms)
    if (!is_polynomial(form)) return "a parameter follows the current exponentially";
  return "";
}

std::string against_damper(const MountedDamper& damper) {
  if (!std::isinf(damper.driver.rate_max) || damper.driver.period > 0)
    return "its driver limits the current's rate or samples";
  if (damper.motion_ratio != 1) return "its damper moves otherwise than its strut";
  if (damper.force_factor != 1) return "its damper is built otherwise than its model";
  if (const auto* network = model_as<NetworkModel>(*damper.model)) return against_network(*network);
  if (const auto* law = model_as<LawModel>(*damper.model)) return against_law(*law);
  return "the model " + damper.model->name() + " has no lanes";
}

std::string against_ground(const BatchVehicle& vehicle) {
  const std::vector<double> jumps =
      vehicle.setting.ground.jumps(vehicle.setting.plant.tyres[0].behind);
  return std::any_of(jumps.begin(), jumps.end(), [](double t) { return t > 0; }) ? "its road jumps"
                                                                                 : "";
}

/// The plant's own part: M q'' = -K q - C q' - row F + tyre P.
void set_plant(const Plant& plant, QuarterCarNumbers<double>& n) {
  const LinearPlant linear = linear_plant(plant);
  const std::vector<double>& m = linear.mass;
  const double determinant = m[0] * m[3] - m[1] * m[2];
  const double inverse[2][2] = {{m[3] / determinant, -m[1] / determinant},
                                {-m[2] / determinant, m[0] / determinant}};
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

void set_limits(const Plant& plant, QuarterCarNumbers<double>& n) {
  const Tyre& tyre = plant.tyres[0];
  const Strut& strut = plant.struts[0];
  const auto travel = [](double stop) {
    return stop > 0 ? stop : std::numeric_limits<double>::infinity();
  };
  n.tyre_stiffness = tyre.stiffness;
  n.tyre_damping = tyre.damping;
  n.static_load = tyre.static_load;
  n.may_lift = plant.tyres_may_lift ? 1 : 0;
  n.friction = strut.friction;
  n.friction_slope = 1 / strut.friction_speed;
  n.extension_stop = travel(strut.extension_stop);
  n.compression_stop = travel(strut.compression_stop);
  n.stop_stiffness = strut.stop_stiffness;
}

void set_network(const NetworkModel& model, LaneVehicle& lane) {
  const Mlp mlp = on_raw_inputs(model.members()[0]);
  LaneNetwork& shape = lane.shape.network;
  shape.count = mlp.layers.size() - 1;
  for (std::size_t i = 0; i < model.inputs().size(); ++i)
    shape.inputs[i] = model.inputs()[i] == "displacement" ? 0
                      : model.inputs()[i] == "velocity"   ? 1
                                                          : 2;
  for (std::size_t l = 0; l < shape.count; ++l)
    shape.layers[l] = {mlp.layers[l], mlp.layers[l + 1], mlp.activation(l + 1)};
  lane.damper = mlp.parameters;
  lane.damper.push_back(mlp.output_scale);
  lane.damper.push_back(mlp.output_mean + model.offset());
}

void set_law(const LawModel& model, LaneVehicle& lane) {
  constexpr std::size_t kPowers = 4;
  const std::size_t count = model.law().params.size();
  lane.shape.kind = LaneDamperKind::Law;
  const std::span names = lane_law_table();
  lane.shape.law = static_cast<std::size_t>(
      std::find(names.begin(), names.end(), model.law().name) - names.begin());
  lane.damper.assign(kPowers * count, 0);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t power = 0; power < model.parameters().coefficients[k].size(); ++power)
      lane.damper[power * count + k] = model.parameters().coefficients[k][power];
  lane.numbers.model_lag = model.lag_rate();
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

std::span<const std::string_view> lane_laws() { return lane_law_table(); }

double sample_time_of(const BatchVehicle& vehicle) {
  return vehicle.setting.controller ? vehicle.limits.sample_time : 1e-3;
}

std::string reason_against_lanes(const BatchVehicle& vehicle) {
  std::string reason = against_plant(vehicle.setting.plant);
  if (reason.empty()) reason = against_damper(vehicle.setting.dampers.at(0));
  if (reason.empty()) reason = against_ground(vehicle);
  if (reason.empty() && !(sample_time_of(vehicle) <= kLongestSample))
    reason = "its samples are further apart than " + format_number(kLongestSample) + " s";
  return reason;
}

LaneVehicle lane_vehicle(const BatchVehicle& vehicle) {
  const Plant& plant = vehicle.setting.plant;
  const MountedDamper& damper = vehicle.setting.dampers[0];
  LaneVehicle lane{};
  set_plant(plant, lane.numbers);
  set_limits(plant, lane.numbers);
  lane.numbers.driver_lag = damper.driver.lag_rate;
  if (const auto* network = model_as<NetworkModel>(*damper.model))
    set_network(*network, lane);
  else
    set_law(*model_as<LawModel>(*damper.model), lane);
  const Strut& strut = plant.struts[0];
  lane.shape.lags = (lane.numbers.driver_lag > 0) + (lane.numbers.model_lag > 0);
  lane.shape.resists_more = plant.tyres_may_lift || strut.friction > 0 ||
                            strut.extension_stop > 0 || strut.compression_stop > 0;
  lane.shape.controlled = vehicle.setting.controller != nullptr;
  lane.shape.sample_time = sample_time_of(vehicle);
  lane.start = start_of(damper, lane);
  return lane;
}

}  // namespace dashpot
