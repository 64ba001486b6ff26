#include "dashpot/base/file.h"
#include "dashpot/base/packed_bytes.h"
#include "dashpot/error.h"
#include "dashpot/record/made_file.h"
#include "dashpot/report/column_table.h"

namespace dashpot {
namespace {

std::string hdf5_bytes(const std::vector<ColumnTable>& tables,
                       const std::vector<std::pair<std::string, std::string>>& attributes) {
  PackedBytes request;
  request.add(attributes.size());
  for (const auto& [name, text] : attributes) request.add(name), request.add(text);
  request.add(tables.size());
  for (const ColumnTable& table : tables) {
    request.add(table.name);
    request.add(table.title);
    request.add(table.columns.size());
    for (const DataColumn& column : table.columns) {
      for (const std::string& text : {column.name, column.unit, column.meaning}) request.add(text);
      request.add(column.numbers);
      request.add(column.texts.size());
      for (const std::string& text : column.texts) request.add(text);
    }
  }

  return made_file("write-hdf5", request.bytes());
}

}  // namespace

void write_hdf5(const std::filesystem::path& path, const std::vector<ColumnTable>& tables,
                const std::vector<std::pair<std::string, std::string>>& attributes) {
  std::string bytes;
  try {
    bytes = hdf5_bytes(tables, attributes);
  } catch (const Error& failure) {
    throw Error(path.string(), std::string("cannot be written: ") + failure.what());
  }
  write_file(path, bytes);
}

void require_hdf5() { hdf5_bytes({}, {}); }

}  // namespace dashpot
