#include <cmath>

#include "dashpot/design/design_law.h"
#include "dashpot/design/quantities.h"

namespace dashpot {

double comfort(const OperatedDamper& damper) {
  if (!damper.request || !damper.request->ride) return NAN;
  const DesignRide& ride = *damper.request->ride;
  if (const std::optional<ModelFile> own = damper.model.model_of(damper.description))
    return ride.comfort(*own);
  return ride.comfort(law_of_design(damper.description, *damper.request, damper.model).file);
}

}  // namespace dashpot
