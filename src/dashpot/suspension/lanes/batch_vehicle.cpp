#include "dashpot/suspension/lanes/batch_vehicle.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/suspension/lanes/ride.h"

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
  if (std::ranges::find(kLaneLaws, model.law().name) == std::end(kLaneLaws))
    return "the law " + model.name() + " has no lanes";
  if (model.law().side_row > 0) return "its rebound and compression differ";
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

}  // namespace

std::span<const std::string_view> lane_laws() { return kLaneLaws; }

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

}  // namespace dashpot
