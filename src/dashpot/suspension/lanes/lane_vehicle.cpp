#include "dashpot/suspension/lanes/lane_vehicle.h"

#include <algorithm>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
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

void set_network(const NetworkModel& model, LaneVehicle& lane) {
  const Mlp mlp = on_raw_inputs(model.members()[0]);
  LaneNetwork& shape = lane.shape.network;
  shape.count = mlp.layers.size() - 1;
  for (std::size_t i = 0; i < model.inputs().size(); ++i)
    shape.inputs[i] = model.inputs()[i] == "displacement" ? LaneInput::Displacement
                      : model.inputs()[i] == "velocity"   ? LaneInput::Velocity
                                                          : LaneInput::Current;
  for (std::size_t l = 0; l < shape.count; ++l)
    shape.layers[l] = {mlp.layers[l], mlp.layers[l + 1], mlp.activation(l + 1)};
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
    set_network(*network, lane);
  else
    set_law(*model_as<LawModel>(*damper.model), lane);

  // The shape, by which vehicles are grouped.
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
