#include "dashpot/record/readers/hdf5.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/hdf5_guard.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kMostMatrixColumns = 64, kMostUnitBytes = 64;

/// Numbers of one group that are as long as each other's columns.
struct StoredArray {
  std::string name, unit;
  std::size_t rows = 0, columns = 1;
  std::vector<double> values;  ///< row by row
};

struct StoredGroup {
  std::vector<StoredArray> datasets;
  std::vector<std::string> notes;
};

/// The text of an attribute; "" where there is none, or none that is a text.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(attribute < 0 ? -1 : H5Aget_type(attribute), H5Tclose);
  const Hdf5Handle space(attribute < 0 ? -1 : H5Aget_space(attribute), H5Sclose);
  if (type < 0 || space < 0 || H5Tget_class(type) != H5T_STRING ||
      H5Sget_simple_extent_npoints(space) != 1)
    return {};

  // Of a length of its own, which HDF5 allocates, or of a stated one.
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute, type, &text) < 0 || !text) return {};
    std::string copy(text, strnlen(text, kMostUnitBytes));
    H5free_memory(text);
    return copy;
  }
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || size > kMostUnitBytes) return {};
  std::string text(size, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return {};
  text.resize(std::min(text.find('\0'), text.size()));
  return std::string(trim(text));
}

/// Reads a dataset of numbers into its group; the reason when it is none.
std::string read_dataset(hid_t dataset, StoredArray& out) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t kind = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return "it holds no plain numbers";
  const int rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 2) return "it has " + std::to_string(rank) + " dimensions";

  // One number, a column, or a matrix; one that lies on its side is turned.
  std::array<hsize_t, 2> sides{1, 1};
  if (rank > 0) H5Sget_simple_extent_dims(space, sides.data(), nullptr);
  const std::size_t height = sides[0], width = rank == 2 ? sides[1] : 1;
  if (height == 0 || width == 0) return "it is empty";
  if (std::min(height, width) > kMostMatrixColumns) return "it is a matrix of many columns";
  std::vector<double> values(height * width);
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    return "HDF5 cannot read it: a filter that is not there, or damage";

  out.rows = std::max(height, width), out.columns = std::min(height, width);
  out.values = values;
  if (width > height)
    for (std::size_t r = 0; r < height; ++r)
      for (std::size_t c = 0; c < width; ++c) out.values[c * height + r] = values[r * width + c];
  for (const char* name : {"unit", "units", "Unit", "Units"})
    if (out.unit.empty()) out.unit = text_attribute(dataset, name);
  return {};
}

/// What a walk over all links gathers; an exception must not pass through HDF5.
struct Gathered {
  std::map<std::string, StoredGroup> groups;  ///< by path, "" for the root
  std::exception_ptr failure;
};

herr_t gather(hid_t root, const char* path, const H5L_info_t* link, void* data) {
  Gathered& all = *static_cast<Gathered*>(data);
  try {
    if (link->type != H5L_TYPE_HARD) return 0;
    const Hdf5Handle object(H5Oopen(root, path, H5P_DEFAULT), H5Oclose);
    if (object < 0 || H5Iget_type(object) != H5I_DATASET) return 0;
    const std::string whole(path);
    const std::size_t slash = whole.rfind('/');
    StoredGroup& group = all.groups[slash == std::string::npos ? "" : whole.substr(0, slash)];

    StoredArray dataset;
    dataset.name = whole.substr(slash + 1);  // npos + 1 is 0
    const std::string reason = read_dataset(object, dataset);
    if (reason.empty())
      group.datasets.push_back(std::move(dataset));
    else
      group.notes.push_back("dataset '" + whole + "' passed over: " + reason);
    return 0;
  } catch (...) {
    all.failure = std::current_exception();
    return 1;
  }
}

/// The length that most columns share; of two, the longer.
std::size_t common_rows(const StoredGroup& group) {
  std::map<std::size_t, std::size_t> columns;
  for (const StoredArray& dataset : group.datasets)
    if (dataset.rows > 1) columns[dataset.rows] += dataset.columns;
  std::size_t best = 0, most = 0;
  for (const auto& [rows, count] : columns)
    if (count >= most) best = rows, most = count;
  return best;
}

void add_dataset(RawTable& table, const StoredArray& dataset) {
  for (std::size_t c = 0; c < dataset.columns; ++c) {
    RawColumn column;
    column.name =
        dataset.columns == 1 ? dataset.name : dataset.name + "(" + std::to_string(c + 1) + ")";
    column.unit = dataset.unit;
    column.values.reserve(dataset.rows);
    for (std::size_t k = 0; k < dataset.rows; ++k) {
      double value = dataset.values[k * dataset.columns + c];
      if (!std::isfinite(value)) {
        if (!column.bad) column.bad = BadCell{k, std::isnan(value) ? "NaN" : "infinite"};
        value = std::numeric_limits<double>::quiet_NaN();
      }
      column.values.push_back(value);
    }
    table.columns.push_back(std::move(column));
  }
}

RawTable table_of(const StoredGroup& group, const std::string& file) {
  RawTable table;
  table.file = file;
  table.notes = group.notes;
  const std::size_t rows = common_rows(group);
  for (const StoredArray& dataset : group.datasets) {
    if (dataset.rows == 1)
      table.scalars.emplace_back(dataset.name, dataset.values.front());
    else if (dataset.rows == rows)
      add_dataset(table, dataset);
    else
      table.notes.push_back("dataset '" + dataset.name +
                            "' passed over: " + std::to_string(dataset.rows) +
                            " values, the recording has " + std::to_string(rows));
  }
  return table;
}

}  // namespace

bool is_hdf5(const fs::path&, std::string_view extension, std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n") && extension != ".mat";
}

std::vector<RawTable> read_hdf5(const fs::path& path) {
  const std::string file = path.string();
  if (lower(path.extension().string()) == ".gz")
    throw Error(file, "is a packed file of HDF5", "unpack it with gunzip first");
  const std::lock_guard turn(hdf5_turn());
  const Hdf5Handle opened = open_hdf5(file);
  check_hdf5(opened, file, fs::file_size(path));

  Gathered all;
  H5Lvisit(opened, H5_INDEX_NAME, H5_ITER_NATIVE, gather, &all);
  if (all.failure) std::rethrow_exception(all.failure);

  // A table of each group that holds one.
  std::vector<RawTable> tables;
  std::vector<std::string> notes;
  for (const auto& [name, group] : all.groups) {
    RawTable table = table_of(group, file);
    if (table.columns.empty()) {
      notes.insert(notes.end(), table.notes.begin(), table.notes.end());
      continue;
    }
    if (!name.empty()) table.part = "group '" + name + "'";
    table.part_name = name;
    table.part_index = tables.size();
    tables.push_back(std::move(table));
  }
  if (tables.empty())
    throw NoTable(file, "no group holds arrays of numbers",
                  "a recording has one dataset per channel");
  if (tables.size() == 1) tables.front().part.clear();
  auto& first = tables.front().notes;
  first.insert(first.end(), notes.begin(), notes.end());
  return tables;
}

}  // namespace dashpot
