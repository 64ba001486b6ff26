#include <cmath>
#include <optional>

#include "dashpot/design/design_law.h"
#include "dashpot/design/quantities.h"

namespace dashpot {

double comfort(const OperatedDamper& damper) {
  if (!damper.request || !damper.request->ride) return NAN;
  std::optional<ModelFile> file = damper.model.model_of(damper.description);
  if (!file) file = law_of_design(damper.description, *damper.request, damper.model).file;

  // Whether it takes energy out is asked of each design, once. In a ride it would be tested for a
  // warning that nobody reads, for most of the time that the ride takes.
  if (!file->dissipation) file->dissipation.emplace();
  return damper.request->ride->comfort(*file);
}

}  // namespace dashpot
