#include "dashpot/suspension/lanes/batch_vehicle.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/suspension/lanes/lane_damper.h"

namespace dashpot {
namespace {

constexpr double kLongestSample = 2.5e-3;  // s: what the weighting of ISO 2631-1 can filter

std::string against_plant(const Plant& plant) {
  const auto stands_on_ground = [](const Strut& strut) { return strut.track.has_value(); };
  if (plant.tyres.empty() || !plant.ground.empty()) return "the plant is no vehicle on tyres";
  if (plant.struts.empty()) return "the plant has no place for a damper";
  if (std::ranges::any_of(plant.struts, stands_on_ground))
    return "a strut of the plant stands on the moving ground";
  if (plant.size() > kMostLaneCoordinates || plant.struts.size() > kMostLaneCorners ||
      plant.tyres.size() > kMostLaneCorners)
    return "the plant has more coordinates, struts or tyres than a full car";
  return "";
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

/// Each damper, and whether all are of one kind.
std::string against_dampers(const std::vector<MountedDamper>& dampers) {
  for (const MountedDamper& damper : dampers)
    if (const std::string reason = against_damper(damper); !reason.empty()) return reason;
  const auto differs = [first = lane_damper_shape(dampers[0])](const MountedDamper& damper) {
    return lane_damper_shape(damper) != first;
  };
  return std::any_of(dampers.begin() + 1, dampers.end(), differs)
             ? "its dampers are of different kinds"
             : "";
}

std::string against_ground(const BatchVehicle& vehicle) {
  for (const Tyre& tyre : vehicle.setting.plant.tyres)
    for (const double jump : vehicle.setting.ground.jumps(tyre.behind))
      if (jump > 0) return "its road jumps";
  return "";
}

}  // namespace

double sample_time_of(const BatchVehicle& vehicle) {
  return vehicle.setting.controller ? vehicle.limits.sample_time : 1e-3;
}

std::string reason_against_lanes(const BatchVehicle& vehicle) {
  std::string reason = against_plant(vehicle.setting.plant);
  if (reason.empty()) reason = against_dampers(vehicle.setting.dampers);
  if (reason.empty()) reason = against_ground(vehicle);
  if (reason.empty() && !(sample_time_of(vehicle) <= kLongestSample))
    reason = "its samples are further apart than " + format_number(kLongestSample) + " s";
  return reason;
}

}  // namespace dashpot
