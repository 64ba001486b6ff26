#include "dashpot/export/c/c_model.h"

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/error.h"

namespace dashpot {

CModel c_model(const DamperModel& model, bool settable) {
  if (const auto* law = dynamic_cast<const LawModel*>(&model))
    return c_law(*law, "model", settable);
  if (const auto* network = dynamic_cast<const NetworkModel*>(&model)) return c_network(*network);
  if (const auto* narx = dynamic_cast<const NarxModel*>(&model)) return c_narx(*narx);
  if (const auto* bank = dynamic_cast<const HysteresisNetwork*>(&model))
    return c_hysteresis_network(*bank);
  if (const auto* space = dynamic_cast<const StateSpaceModel*>(&model))
    return c_state_space(*space);
  if (const auto* fuzzy = dynamic_cast<const FuzzyModel*>(&model)) return c_fuzzy(*fuzzy);
  if (const auto* hybrid = dynamic_cast<const HybridModel*>(&model)) return c_hybrid(*hybrid);
  if (const auto* family = dynamic_cast<const FamilyModel*>(&model)) return c_family(*family);
  throw Error(model.name(), "has no C code: it is a model of kind '" + model.kind() + "'",
              "export a model that 'dashpot identify' wrote");
}

}  // namespace dashpot
