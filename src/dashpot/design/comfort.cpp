#include <cmath>

#include "dashpot/design/design_law.h"
#include "dashpot/design/quantities.h"

namespace dashpot {

double comfort(const OperatedDamper& damper) {
  if (!damper.request || !damper.request->ride) return NAN;
  const DesignRide& ride = *damper.request->ride;
  if (const std::optional<ModelFile> own = damper.model.model_of(damper.description))
    return ridden_comfort(*own, ride);
  return ridden_comfort(law_of_design(damper.description, *damper.request, damper.model).file,
                        ride);
}

}  // namespace dashpot
