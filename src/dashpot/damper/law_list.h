#pragma once
#include <span>
#include <string>
#include <string_view>

#include "dashpot/damper/law.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// Every force law, in alphabetical order.
std::span<const Law* const> laws();

/// The law of that name. Throws Error(where, "unknown model ...") which says what is known.
const Law& find_law(std::string_view name, const std::string& where = {});

bool is_law(std::string_view name);

ModelInfo info_of(const Law& law);

}  // namespace dashpot
