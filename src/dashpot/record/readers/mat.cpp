#include "dashpot/record/readers/mat.h"

#include "dashpot/error.h"
#include "dashpot/record/readers/stored_table.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

ArrayWords words_of_variable(const StoredArray& variable) {
  return {"variable", std::to_string(variable.height) + " x " + std::to_string(variable.width)};
}

}  // namespace

bool is_mat(const fs::path&, std::string_view extension, std::string_view head) {
  return head.substr(0, 7) == "MATLAB " || extension == ".mat";
}

std::vector<RawTable> read_mat(const fs::path& path) {
  const std::string file = path.string();
  if (path.extension() == ".gz")
    throw Error(file, "is a packed MAT file", "unpack it with gunzip first");
  return mat_tables(read_stored_arrays(path, StoredFormat::Mat), file);
}

std::vector<RawTable> mat_tables(StoredArrays all, const std::string& file) {
  RawTable table = stored_table(file, std::move(all), words_of_variable);
  if (table.columns.empty())
    throw NoTable(file, "holds no arrays of numbers" + table.passed_over(),
                  "a recording has one vector per channel");
  std::vector<RawTable> tables;
  tables.push_back(std::move(table));
  return tables;
}

}  // namespace dashpot
