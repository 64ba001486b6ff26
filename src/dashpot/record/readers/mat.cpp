#include "dashpot/record/readers/mat.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <matio.h>
#include <memory>
#include <mutex>

#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/hdf5_guard.h"
#include "dashpot/record/readers/line_source.h"
#include "dashpot/record/readers/mat_guard.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kMostColumns = 64;  // of one matrix: more is an image, not a recording
constexpr int kDeepestVariable = 4;

using MatFile = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

/// One real two-dimensional array, column by column.
struct Array {
  std::string name;
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;

  std::size_t length() const { return std::max(rows, columns); }
  std::size_t width() const { return std::min(rows, columns); }
};

template <class Number>
std::vector<double> to_doubles(const void* data, std::size_t count) {
  const auto* numbers = static_cast<const Number*>(data);
  return {numbers, numbers + count};
}

/// The variable's numbers as double, whatever type they are stored in; integers of 64 bits are
/// rounded.
std::vector<double> numbers_of(const matvar_t& variable, std::size_t count) {
  const void* data = variable.data;

  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return to_doubles<double>(data, count);
    case MAT_C_SINGLE:
      return to_doubles<float>(data, count);
    case MAT_C_INT8:
      return to_doubles<std::int8_t>(data, count);
    case MAT_C_UINT8:
      return to_doubles<std::uint8_t>(data, count);
    case MAT_C_INT16:
      return to_doubles<std::int16_t>(data, count);
    case MAT_C_UINT16:
      return to_doubles<std::uint16_t>(data, count);
    case MAT_C_INT32:
      return to_doubles<std::int32_t>(data, count);
    case MAT_C_UINT32:
      return to_doubles<std::uint32_t>(data, count);
    case MAT_C_INT64:
      return to_doubles<std::int64_t>(data, count);
    case MAT_C_UINT64:
      return to_doubles<std::uint64_t>(data, count);
    default:
      return {};
  }
}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 &&
         !variable.isComplex;
}

/// Collects real arrays, into structures of one element too; names what it passes over.
class Collector {
 public:
  Collector(mat_t* file, std::string path) : file_(file), path_(std::move(path)) {}

  void collect(matvar_t& variable, const std::string& name, int depth) {
    if (variable.rank != 2 || depth > kDeepestVariable)
      return pass_over(name, "not two-dimensional");

    // Go into structures of one element; pass over what is no matrix of real numbers.
    const std::size_t rows = variable.dims[0], columns = variable.dims[1];
    if (variable.class_type == MAT_C_STRUCT && rows == 1 && columns == 1)
      return collect_fields(variable, name, depth);
    if (!is_numeric(variable)) return pass_over(name, "not a real number array");
    if (rows == 0 || columns == 0) return pass_over(name, "empty");

    if (!variable.data && Mat_VarReadDataAll(file_, &variable) != 0) fail(name);
    if (!variable.data) fail(name);
    arrays.push_back({name, rows, columns, numbers_of(variable, rows * columns)});
  }

  std::vector<Array> arrays;
  std::vector<std::string> notes;

 private:
  void collect_fields(matvar_t& variable, const std::string& name, int depth) {
    if (depth == 0 && Mat_VarReadDataAll(file_, &variable) != 0) fail(name);
    char* const* fields = Mat_VarGetStructFieldnames(&variable);
    for (unsigned k = 0; k < Mat_VarGetNumberOfFields(&variable); ++k)
      if (matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, k, 0))
        collect(*field, name + "." + fields[k], depth + 1);
  }
  void pass_over(const std::string& name, const std::string& why) {
    notes.push_back("variable '" + name + "' passed over: " + why);
  }
  [[noreturn]] void fail(const std::string& name) const {
    throw Error(path_, "variable '" + name + "' cannot be read",
                "the file is damaged: copy it again from its source");
  }

  mat_t* file_;
  std::string path_;
};

/// The length that most columns share; of two, the longer.
std::size_t common_length(const std::vector<Array>& arrays) {
  std::map<std::size_t, std::size_t> columns;
  for (const Array& array : arrays)
    if (array.length() > 1 && array.width() <= kMostColumns)
      columns[array.length()] += array.width();
  std::size_t best = 0, most = 0;
  for (const auto& [length, count] : columns)
    if (count >= most) best = length, most = count;
  return best;
}

/// Adds the columns of a matrix, or its rows where it lies on its side. Numbers that are not finite
/// become NaN, the first of them noted.
void add_columns(RawTable& table, const Array& array) {
  const bool by_rows = array.rows < array.columns;
  for (std::size_t c = 0; c < array.width(); ++c) {
    RawColumn column;
    column.name = array.width() == 1 ? array.name : array.name + "(" + std::to_string(c + 1) + ")";
    column.values.reserve(array.length());

    for (std::size_t k = 0; k < array.length(); ++k) {
      double value = array.values[by_rows ? k * array.rows + c : c * array.rows + k];
      if (!std::isfinite(value)) {
        if (!column.bad) column.bad = BadCell{k, std::isnan(value) ? "NaN" : "infinite"};
        value = std::numeric_limits<double>::quiet_NaN();
      }
      column.values.push_back(value);
    }
    table.columns.push_back(std::move(column));
  }
}

/// One table of the arrays that share the commonest length; single numbers beside it, the rest as
/// notes.
RawTable to_table(Collector collector, const std::string& file) {
  RawTable table;
  table.file = file;
  table.notes = std::move(collector.notes);
  const std::size_t length = common_length(collector.arrays);

  for (const Array& array : collector.arrays) {
    if (array.length() == 1) {
      table.scalars.emplace_back(array.name, array.values.front());
    } else if (array.length() == length && array.width() <= kMostColumns) {
      add_columns(table, array);
    } else {
      table.notes.push_back(
          "variable '" + array.name + "' passed over: " + std::to_string(array.rows) + " x " +
          std::to_string(array.columns) + " values, the recording has " + std::to_string(length));
    }
  }

  if (table.columns.empty())
    throw NoTable(file, "holds no arrays of numbers", "a recording has one vector per channel");
  return table;
}

}  // namespace

bool is_mat(const fs::path&, std::string_view extension, std::string_view head) {
  return head.substr(0, 7) == "MATLAB " || extension == ".mat";
}

std::vector<RawTable> read_mat(const fs::path& path) {
  const std::string file = path.string();
  if (path.extension() == ".gz")
    throw Error(file, "is a packed MAT file", "unpack it with gunzip first");

  // Check sizes before the MAT library sees the file, since it believes them.
  const std::lock_guard turn(hdf5_turn());
  const std::string head = read_head(path, kMat73Head);
  if (head.starts_with("MATLAB 7.3")) {
    check_mat73(head, fs::file_size(path), file);
    check_hdf5(open_hdf5(file), file, fs::file_size(path));
  } else {
    check_mat(read_file(path), file);
  }

  static std::once_flag quiet;  // the MAT library prints otherwise
  std::call_once(quiet, [] { Mat_LogInitFunc("dashpot", [](int, char*) {}); });
  const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!mat) throw Error(file, "damaged or cut off MAT file", "copy it again from its source");

  Collector collector(mat.get(), file);
  for (;;) {
    const Variable variable(Mat_VarReadNextInfo(mat.get()), Mat_VarFree);
    if (!variable) break;
    collector.collect(*variable, variable->name ? variable->name : "", 0);
  }
  std::vector<RawTable> tables;
  tables.push_back(to_table(std::move(collector), file));
  return tables;
}

}  // namespace dashpot
