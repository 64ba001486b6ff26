#include "dashpot/suspension/lanes/lane_damper.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"

namespace dashpot {
namespace {

std::size_t law_of(const LawModel& model) {
  return static_cast<std::size_t>(std::ranges::find(kLaneLaws, model.law().name) -
                                  std::begin(kLaneLaws));
}

LaneNetwork network_of(const NetworkModel& model) {
  LaneNetwork shape;
  const Mlp& mlp = model.members()[0];
  shape.count = mlp.layers.size() - 1;
  for (std::size_t i = 0; i < model.inputs().size(); ++i)
    shape.inputs[i] = model.inputs()[i] == "displacement" ? LaneInput::Displacement
                      : model.inputs()[i] == "velocity"   ? LaneInput::Velocity
                                                          : LaneInput::Current;
  for (std::size_t l = 0; l < shape.count; ++l)
    shape.layers[l] = {mlp.layers[l], mlp.layers[l + 1], mlp.activation(l + 1)};
  return shape;
}

void add_network(const NetworkModel& model, std::vector<double>& numbers) {
  const Mlp mlp = on_raw_inputs(model.members()[0]);
  numbers.insert(numbers.end(), mlp.parameters.begin(), mlp.parameters.end());
  numbers.push_back(mlp.output_scale);
  numbers.push_back(mlp.output_mean + model.offset());
}

void add_law(const LawModel& model, std::vector<double>& numbers) {
  const std::size_t count = model.law().params.size(), first = numbers.size();
  numbers.resize(first + kLanePowers * count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t power = 0; power < model.parameters().coefficients[k].size(); ++power)
      numbers[first + power * count + k] = model.parameters().coefficients[k][power];
}

}  // namespace

double model_lag_of(const MountedDamper& damper) {
  const auto* law = model_as<LawModel>(*damper.model);
  return law ? law->lag_rate() : 0;
}

LaneDamperShape lane_damper_shape(const MountedDamper& damper) {
  LaneDamperShape shape;
  if (const auto* network = model_as<NetworkModel>(*damper.model)) {
    shape.network = network_of(*network);
  } else {
    shape.kind = LaneDamperKind::Law;
    shape.law = law_of(*model_as<LawModel>(*damper.model));
  }
  shape.lags = (damper.driver.lag_rate > 0) + (model_lag_of(damper) > 0);
  return shape;
}

void add_lane_damper(const MountedDamper& damper, std::vector<double>& numbers) {
  if (const auto* network = model_as<NetworkModel>(*damper.model))
    add_network(*network, numbers);
  else
    add_law(*model_as<LawModel>(*damper.model), numbers);
}

void add_lane_start(const MountedDamper& damper, std::vector<double>& start) {
  const double command =
      std::clamp(damper.current, damper.driver.current_min, damper.driver.current_max);
  std::vector<double> state(damper.model->state_size());
  damper.model->rest({0, 0, damper.current}, state);
  double inner = command;
  if (model_lag_of(damper) > 0) {
    inner = state.back();
    state.pop_back();
  }
  start.insert(start.end(), {command, command, inner});
  start.insert(start.end(), state.begin(), state.end());
}

bool is_moderate(const MountedDamper& damper) {
  const auto* network = model_as<NetworkModel>(*damper.model);
  if (!network) return false;
  const Mlp mlp = on_raw_inputs(network->members()[0]);
  const LaneNetwork shape = network_of(*network);
  const double current =
      std::max(std::abs(damper.driver.current_min), std::abs(damper.driver.current_max));
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

}  // namespace dashpot
