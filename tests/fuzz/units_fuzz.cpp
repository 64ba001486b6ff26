#include "dashpot/base/units.h"
#include "dashpot/record/channel_names.h"
#include "fuzz.h"

void fuzz(const std::string& input) {
  if (const auto unit = dashpot::parse_unit(input))
    if (!(unit->factor > 0) || !std::isfinite(unit->factor) || !std::isfinite(unit->offset)) std::abort();
  dashpot::recognise_channel(input, "");
}
