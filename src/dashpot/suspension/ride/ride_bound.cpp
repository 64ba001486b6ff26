#include "dashpot/suspension/ride/ride_bound.h"

#include "dashpot/error.h"
#include "dashpot/suspension/ground/deterministic.h"

namespace dashpot {

ForceRange possible_forces(const Vehicle& vehicle, double speed, const std::string& where) {
  const MountedDamper& damper = vehicle.dampers.front();
  const auto [least, greatest] = std::pair{vehicle.limits.current_min, vehicle.limits.current_max};
  if (!(least < greatest))
    throw Error(where, "nothing drives this damper", "a damper with a range of currents");
  if (damper.model->state_size() > 0)
    throw Error(
        where,
        vehicle.damper_names.front() + " has a memory: it has no range of forces by velocity alone",
        "an ideal damper, or a model without states");
  // Whether the plant is one of which a bound is known.
  SampledPlant(vehicle.set.plant, *step_ground(0.01, 0), 0.01, 1e-3);
  const double ratio = damper.motion_ratio;
  ForceRange range = model_range(*damper.model, least, greatest, speed * ratio);
  for (double& velocity : range.velocity) velocity /= ratio;
  for (std::vector<double>* forces : {&range.soft, &range.hard})
    for (double& force : *forces) force = damper.at_strut(force);
  return range;
}

std::vector<ClairvoyantBound> front_of_ride(const Plant& plant, const GroundMotion& ground,
                                            const ForceRange& range, const RideSquares& reference,
                                            const BoundOptions& options) {
  std::vector<RideIndex> indices;
  for (const double weight : kFrontWeights) indices.push_back(weighted_index(weight, reference));
  return clairvoyant_front(plant, ground, range, indices, options);
}

}  // namespace dashpot
