#include "dashpot/machine/beyond_models.h"

#include "dashpot/identify/judge/extrapolation.h"

namespace dashpot {

std::vector<std::string> beyond_models(const ObservedDampers& dampers, const InPlantSetup& setup,
                                       const DamperMotions& motions) {
  constexpr double kFew = 0.01;  // of the samples: a peak or two
  const std::vector<std::string> struts = observer_names(setup).struts;
  std::vector<std::string> beyond;
  for (std::size_t d = 0; d < dampers.size(); ++d) {
    // A model whose file states no motion, as a published one, has no range of it.
    const std::string where = dampers.size() > 1 ? struts[d] + ": " : "";
    for (const Extrapolation& e :
         extrapolations(*dampers[d].model, dampers[d].domain, setup.drive_unit, motions[d]))
      if (e.quantity == drive_channel(setup.drive_unit) || (e.high > e.low && e.share > kFew))
        beyond.push_back(where + describe(e));
  }
  return beyond;
}

}  // namespace dashpot
