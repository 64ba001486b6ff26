#include "dashpot/damper/model_info.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

bool ModelInfo::needs_displacement() const {
  return std::find(inputs.begin(), inputs.end(), "displacement") != inputs.end();
}

void throw_unknown_model(std::string_view name, const std::string& where,
                         const std::vector<std::string>& known,
                         const std::vector<std::string>& more) {
  throw Error(where, "unknown model '" + std::string(name) + "'", suggest(name, known, more));
}

}  // namespace dashpot
