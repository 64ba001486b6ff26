#include "mat_arrays.h"

#include <algorithm>
#include <cstdint>
#include <matio.h>
#include <memory>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/mat_guard.h"
#include "hdf5_guard.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr int kDeepestVariable = 4;

using MatFile = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

/// Hands over the numbers of a matrix, which stand column by column; one that lies on its side is
/// turned.
template <class Number>
void hand_over_numbers(const void* data, const StoredArray& about, StoredWriter& to) {
  const auto* numbers = static_cast<const Number*>(data);
  const bool lies = about.width > about.height;
  const std::size_t step = lies ? 1 : about.height, stride = lies ? about.height : 1;
  for (std::size_t c = 0; c < std::min(about.height, about.width); ++c)
    to.add_column(numbers + c * step, about.length(), stride);
}

/// As double, whatever type they are stored in; integers of 64 bits are rounded.
void hand_over_matrix(const matvar_t& variable, const StoredArray& about, StoredWriter& to) {
  to.begin_array(about);
  if (about.is_wide()) return;
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return hand_over_numbers<double>(variable.data, about, to);
    case MAT_C_SINGLE:
      return hand_over_numbers<float>(variable.data, about, to);
    case MAT_C_INT8:
      return hand_over_numbers<std::int8_t>(variable.data, about, to);
    case MAT_C_UINT8:
      return hand_over_numbers<std::uint8_t>(variable.data, about, to);
    case MAT_C_INT16:
      return hand_over_numbers<std::int16_t>(variable.data, about, to);
    case MAT_C_UINT16:
      return hand_over_numbers<std::uint16_t>(variable.data, about, to);
    case MAT_C_INT32:
      return hand_over_numbers<std::int32_t>(variable.data, about, to);
    case MAT_C_UINT32:
      return hand_over_numbers<std::uint32_t>(variable.data, about, to);
    case MAT_C_INT64:
      return hand_over_numbers<std::int64_t>(variable.data, about, to);
    default:
      return hand_over_numbers<std::uint64_t>(variable.data, about, to);
  }
}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 &&
         !variable.isComplex;
}

/// Why a variable of its class is no array of numbers; "" where it is one.
std::string unread_class(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_STRUCT:
      return "an array of structures; save the fields of each in a file of its own";
    case MAT_C_CELL:
      return "a cell array; save what each cell holds in a file of its own";
    case MAT_C_CHAR:
      return "a text";
    case MAT_C_EMPTY:
    case MAT_C_OBJECT:
    case MAT_C_FUNCTION:
    case MAT_C_OPAQUE:
      return "an object (datetime, duration, table ...), which MATLAB alone reads; save its "
             "numbers, as seconds(t - t(1))";
    default:
      return is_numeric(variable) ? "" : "not a real number array";
  }
}

/// A variable of characters as text, of ASCII alone.
std::string text_of(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || !variable.data) return {};
  const std::size_t count = variable.rank == 2 ? variable.dims[0] * variable.dims[1] : 0;
  const std::size_t width = count > 0 ? variable.nbytes / count : 0;
  std::string text;
  for (std::size_t k = 0; k < count && (width == 1 || width == 2); ++k) {
    const auto* bytes = static_cast<const unsigned char*>(variable.data) + k * width;
    const unsigned code = width == 1 ? bytes[0] : bytes[0] | bytes[1] << 8;
    if (code >= 0x80) return {};
    text += static_cast<char>(code);
  }
  return text;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, lower(name)) != words.end();
}

/// Goes through variables, into structures of one element too; names what it passes over.
class MatWalk {
 public:
  MatWalk(mat_t* file, std::string path, StoredWriter& to)
      : file_(file), path_(std::move(path)), to_(to) {}

  /// `unit`: of its numbers, where something beside them says so.
  void visit(matvar_t& variable, const std::string& name, int depth, const std::string& unit = "") {
    // Go into structures of one element; pass over what is no matrix of real numbers.
    const bool is_flat = variable.rank == 2;
    if (variable.class_type == MAT_C_STRUCT && is_flat && variable.dims[0] == 1 &&
        variable.dims[1] == 1 && depth <= kDeepestVariable)
      return visit_fields(variable, name, depth);
    if (depth > kDeepestVariable) return pass_over(name, "too deep in structures");
    if (const std::string why = unread_class(variable); !why.empty()) return pass_over(name, why);
    if (!is_flat) return pass_over(name, "not two-dimensional");
    const std::size_t rows = variable.dims[0], columns = variable.dims[1];
    if (rows == 0 || columns == 0) return pass_over(name, "empty");

    if (!variable.data && Mat_VarReadDataAll(file_, &variable) != 0) fail(name);
    if (!variable.data) fail(name);
    hand_over_matrix(
        variable, {.group = {}, .name = name, .unit = unit, .height = rows, .width = columns}, to_);
  }

 private:
  void visit_fields(matvar_t& variable, const std::string& name, int depth) {
    if (depth == 0 && Mat_VarReadDataAll(file_, &variable) != 0) fail(name);
    char* const* names = Mat_VarGetStructFieldnames(&variable);
    std::vector<std::pair<std::string_view, matvar_t*>> fields;
    for (unsigned k = 0; k < Mat_VarGetNumberOfFields(&variable); ++k)
      if (matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, k, 0))
        fields.emplace_back(names[k], field);

    // A text beside data is their unit.
    const auto data = std::ranges::find_if(fields, [](const auto& field) {
      return is_one_of(field.first, {"data", "values", "value"}) && is_numeric(*field.second);
    });
    const auto unit = std::ranges::find_if(fields, [](const auto& field) {
      return is_one_of(field.first, {"unit", "units"}) && !text_of(*field.second).empty();
    });
    const bool has_unit = data != fields.end() && unit != fields.end();
    for (auto field = fields.begin(); field != fields.end(); ++field)
      if (!has_unit || field != unit)
        visit(*field->second, name + "." + std::string(field->first), depth + 1,
              has_unit && field == data ? text_of(*unit->second) : "");
  }
  void pass_over(const std::string& name, const std::string& why) {
    const std::string what = name.empty() ? "a variable" : "variable '" + name + "'";
    to_.note({"", what + " passed over: " + why});
  }
  [[noreturn]] void fail(const std::string& name) const {
    throw Error(path_, "variable '" + name + "' cannot be read",
                "the file is damaged: copy it again from its source");
  }

  mat_t* file_;
  std::string path_;
  StoredWriter& to_;
};

}  // namespace

void hand_over_mat(const fs::path& path, StoredWriter& to) {
  // Check sizes before the MAT library sees the file.
  const std::string file = path.string();
  const std::uintmax_t size = fs::file_size(path);
  if (const std::string head = read_head(path, kMat73Head); head.starts_with("MATLAB 7.3")) {
    check_mat73(head, size, file);
    check_hdf5(open_hdf5(file), file, size);
  } else {
    check_mat(read_file(path), file);
  }

  Mat_LogInitFunc("dashpot", [](int, char*) {});  // the MAT library prints otherwise
  const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!mat) throw Error(file, "damaged or cut off MAT file", "copy it again from its source");
  MatWalk walk(mat.get(), file, to);
  while (const Variable variable{Mat_VarReadNextInfo(mat.get()), Mat_VarFree})
    walk.visit(*variable, variable->name ? variable->name : "", 0);
}

}  // namespace dashpot
