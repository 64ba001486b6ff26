#include "dashpot/error.h"

namespace dashpot {

static std::string compose(const std::string& where, const std::string& what,
                           const std::string& right) {
  std::string text = where.empty() ? what : where + ": " + what;
  if (!right.empty()) text += "; " + right;
  return text;
}

Error::Error(const std::string& where, const std::string& what, const std::string& right)
    : std::runtime_error(compose(where, what, right)) {}

Interrupted::Interrupted() : std::runtime_error("interrupted") {}

}  // namespace dashpot
