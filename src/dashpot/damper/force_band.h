#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/value.h"

namespace dashpot {

Value to_json(const ForceBand& band);
/// Throws Error naming the key on anything unknown, missing, out of order or not positive.
ForceBand read_force_band(const Value& value);

}  // namespace dashpot
