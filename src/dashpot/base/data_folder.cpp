#include "dashpot/base/data_folder.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace dashpot {

fs::path data_folder(std::string_view kind) {
  const fs::path source = fs::path(DASHPOT_DATA_SOURCE_DIR) / kind;
  return fs::is_directory(source) ? source : fs::path(DASHPOT_DATA_INSTALL_DIR) / kind;
}

std::vector<std::string> data_names(std::string_view kind, std::string_view extension) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(data_folder(kind), missing))
    if (entry.path().extension() == extension) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace dashpot
