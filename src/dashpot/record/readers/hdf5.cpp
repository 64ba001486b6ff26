#include "dashpot/record/readers/hdf5.h"

#include <map>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/stored_table.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

ArrayWords words_of_dataset(const StoredArray& dataset) {
  return {"dataset", std::to_string(dataset.length())};
}

}  // namespace

bool is_hdf5(const fs::path&, std::string_view extension, std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n") && extension != ".mat";
}

std::vector<RawTable> read_hdf5(const fs::path& path) {
  const std::string file = path.string();
  if (lower(path.extension().string()) == ".gz")
    throw Error(file, "is a packed file of HDF5", "unpack it with gunzip first");
  return hdf5_tables(read_stored_arrays(path, StoredFormat::Hdf5), file);
}

std::vector<RawTable> hdf5_tables(StoredArrays all, const std::string& file) {
  std::map<std::string, StoredArrays> groups;  // by path, "" for the root
  for (StoredArray& array : all.arrays) groups[array.group].arrays.push_back(std::move(array));
  for (StoredNote& note : all.notes) groups[note.group].notes.push_back(std::move(note));

  // A table of each group that holds one.
  std::vector<RawTable> tables;
  std::vector<std::string> notes;
  for (auto& [name, group] : groups) {
    RawTable table = stored_table(file, std::move(group), words_of_dataset);
    if (table.columns.empty()) {
      notes.insert(notes.end(), table.notes.begin(), table.notes.end());
      continue;
    }
    if (!name.empty()) table.part = "group '" + name + "'";
    table.part_name = name;
    table.part_index = tables.size();
    tables.push_back(std::move(table));
  }
  if (tables.empty()) {
    RawTable none;
    none.notes = notes;
    throw NoTable(file, "no group holds arrays of numbers" + none.passed_over(),
                  "a recording has one dataset per channel");
  }
  if (tables.size() == 1) tables.front().part.clear();
  auto& first = tables.front().notes;
  first.insert(first.end(), notes.begin(), notes.end());
  return tables;
}

}  // namespace dashpot
