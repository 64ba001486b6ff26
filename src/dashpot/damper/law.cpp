#include "dashpot/damper/law.h"

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

std::size_t Law::index_of(std::string_view param) const {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < params.size(); ++k) {
    if (params[k].name == param) return k;
    known.emplace_back(params[k].name);
  }
  throw Error(std::string(name), "unknown parameter '" + std::string(param) + "'",
              suggest(param, known));
}

}  // namespace dashpot
