#include "dashpot/suspension/ride/ride_bound.h"

#include "dashpot/error.h"

namespace dashpot {

ForceRange possible_forces(const Vehicle& vehicle, const StrutMotion& within,
                           const std::string& where) {
  const MountedDamper& damper = vehicle.dampers.front();
  const auto [least, greatest] = std::pair{vehicle.limits.current_min, vehicle.limits.current_max};
  if (!(least < greatest))
    throw Error(where, "nothing drives this damper", "a damper with a range of currents");
  if (damper.model->state_size() > 0)
    throw Error(where,
                vehicle.damper_names.front() +
                    " has a memory: its force has no range by velocity and displacement alone",
                "an ideal damper, or a model without states");
  require_quarter_car(vehicle.set.plant);

  // At the strut, as the simulation mounts it.
  return force_range(where + ": " + vehicle.damper_names.front(),
                     [damper](const DamperInput& strut) {
                       return damper.at_strut(damper.model->force(damper.at_damper(strut), {}));
                     },
                     {.current_min = least,
                      .current_max = greatest,
                      .velocity = within.speed,
                      .displacement = damper.model->needs_displacement() ? within.travel : 0});
}

std::vector<ClairvoyantBound> front_of_ride(const Plant& plant, const GroundMotion& ground,
                                            const ForceRange& range, const RideSquares& reference,
                                            const BoundOptions& options) {
  std::vector<RideIndex> indices;
  for (const double weight : kFrontWeights) indices.push_back(weighted_index(weight, reference));
  return clairvoyant_front(plant, ground, range, indices, options);
}

}  // namespace dashpot
