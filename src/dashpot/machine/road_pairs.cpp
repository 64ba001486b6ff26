#include "dashpot/machine/road_pairs.h"

#include "dashpot/error.h"
#include "dashpot/plant.h"

namespace dashpot {

std::vector<RoadPair> road_pairs(const InPlantSetup& setup) {
  const Plant plant = make_plant(*setup.model, setup.known);
  const auto tyre_of = [&](std::size_t u) {
    const PlantInputPlace& place = setup.inputs[u].place;
    const bool has_own = place.kind == PlantInput::Ground && place.tyre;
    return has_own ? &plant.tyres[*place.tyre] : nullptr;
  };
  const auto refuse = [&](std::size_t u, const std::string& what, const std::string& right) {
    throw Error("plant, inputs", "the road under the " + tyre_of(u)->name + " " + what, right);
  };

  std::vector<RoadPair> pairs;
  for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
    bool has_other = false;
    for (std::size_t v = 0; v < setup.inputs.size() && tyre_of(u); ++v) {
      if (v == u || !tyre_of(v) || tyre_of(v)->behind != tyre_of(u)->behind) continue;
      if (!setup.inputs[u].road) break;

      // Each is looked at from both of its sides, and counts once.
      if (!setup.inputs[v].road)
        refuse(u, "is not measured, and the one beside it is", "a channel for both, or for none");
      if (has_other)
        refuse(u, "is one of three side by side, and nothing measures them",
               "behind: of each axle after the first, or a channel for each road");
      has_other = true;
      if (v > u) pairs.push_back({u, v});
    }
  }
  return pairs;
}

}  // namespace dashpot
