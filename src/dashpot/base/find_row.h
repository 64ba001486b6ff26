#pragma once
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

/// The row of that name in a table of rows, or of pointers to rows, that have one. Throws
/// Error(where, "unknown WHAT 'name'") that names the known ones.
template <class Table>
const auto& find_row(const Table& table, std::string_view name, std::string_view what,
                     const std::string& where) {
  const auto row_of = [](const auto& entry) -> const auto& {
    if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(entry)>>)
      return *entry;
    else
      return entry;
  };

  std::vector<std::string> known;
  for (const auto& entry : table) {
    const auto& row = row_of(entry);
    if (row.name == name) return row;
    known.emplace_back(row.name);
  }
  throw Error(where, "unknown " + std::string(what) + " '" + std::string(name) + "'",
              suggest(name, known));
}

}  // namespace dashpot
