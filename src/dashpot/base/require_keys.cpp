#include "dashpot/base/require_keys.h"

#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

void require_keys(const Value& object, const std::string& what,
                  std::initializer_list<std::string_view> keys) {
  std::vector<std::string> missing;
  for (const std::string_view key : keys)
    if (!object.find(key)) missing.push_back("'" + std::string(key) + "'");
  if (!missing.empty()) throw Error(object.where(), what + " needs " + join(missing, ", "));
}

}  // namespace dashpot
