#include "contributing/reader/pairs_example.h"

#include <sstream>

#include "dashpot/base/file.h"

namespace dashpot {

bool is_pairs_example(const std::filesystem::path&, std::string_view, std::string_view head) {
  return head.starts_with("pairs\n");
}

std::vector<RawTable> read_pairs_example(const std::filesystem::path& path) {
  RawTable table;
  table.file = path.string();
  table.columns = {{"time", "s", {}, {}}, {"force", "N", {}, {}}};
  std::istringstream text(read_file(path).substr(6));
  for (double time = 0, force = 0; text >> time >> force;) {
    table.columns[0].values.push_back(time);
    table.columns[1].values.push_back(force);
  }
  if (table.rows() == 0) throw Error(table.file, "has no pair of numbers", "time and force");
  return {table};
}

}  // namespace dashpot
