#include "dashpot/model_kind.h"

#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

std::string_view name_of(ModelKind kind) {
  return kind == ModelKind::Other ? "other" : row_of<kModelKindNames>(kind).name;
}

ModelKind parse_model_kind(std::string_view name, const std::string& where) {
  std::vector<std::string> known;
  for (const ModelKindName& row : kModelKindNames) {
    if (name == row.name || (name == row.former && !name.empty())) return row.kind;
    known.emplace_back(row.name);
  }
  throw Error(where, "unknown kind '" + std::string(name) + "'", suggest(name, known));
}

}  // namespace dashpot
