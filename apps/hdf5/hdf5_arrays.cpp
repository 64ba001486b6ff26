#include "hdf5_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>

#include "dashpot/base/text.h"
#include "hdf5_guard.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kMostUnitBytes = 64;

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

/// An attribute of one number; `missing` where there is none.
double number_attribute(hid_t object, const char* name, double missing) {
  if (H5Aexists(object, name) <= 0) return missing;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const H5T_class_t kind = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  double value = missing;
  if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
    return missing;
  return value;
}

/// What the conventions of netCDF keep in fewer bits, as it was measured, and what was not measured
/// as no number.
void unpack(hid_t dataset, std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"_FillValue", "missing_value"})
    std::ranges::replace(values, number_attribute(dataset, name, kNone), kNone);
  const double scale = number_attribute(dataset, "scale_factor", 1),
               offset = number_attribute(dataset, "add_offset", 0);
  if (scale == 1 && offset == 0) return;
  for (double& value : values) value = scale * value + offset;
}

/// Hands over a dataset of numbers; the reason when it is none.
std::string hand_over_dataset(hid_t dataset, StoredArray& about, StoredWriter& to) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t kind = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  if (kind == H5T_COMPOUND) return "it is a table in one dataset, which is not read";
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return "it holds no plain numbers";
  const int rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 2) return "it has " + std::to_string(rank) + " dimensions";

  // One number, a column, or a matrix.
  std::array<hsize_t, 2> sides{1, 1};
  if (rank > 0) H5Sget_simple_extent_dims(space, sides.data(), nullptr);
  about.height = sides[0], about.width = rank == 2 ? sides[1] : 1;
  if (about.height == 0 || about.width == 0) return "it is empty";
  if (about.is_wide()) return "it is a matrix of many columns";
  std::vector<double> values(about.height * about.width);
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    return "HDF5 cannot read it: a filter that is not there, or damage";
  for (const char* name : {"unit", "units", "Unit", "Units", "UNIT", "UNITS"})
    if (about.unit.empty()) about.unit = text_attribute(dataset, name);
  unpack(dataset, values);

  // Its numbers stand row by row; a matrix that lies on its side is turned.
  to.begin_array(about);
  const bool lies = about.width > about.height;
  const std::size_t step = lies ? about.width : 1, stride = lies ? 1 : about.width;
  for (std::size_t c = 0; c < std::min(about.height, about.width); ++c)
    to.add_column(values.data() + c * step, about.length(), stride);
  return {};
}

/// What a walk over all links needs; an exception must not pass through HDF5.
struct Walked {
  StoredWriter& to;
  std::exception_ptr failure;
};

/// A group, and what its walk needs.
struct WalkedGroup {
  Walked& walked;
  std::string group;
};

/// An attribute of one number says what a dataset of one number would.
herr_t hand_over_attribute(hid_t group, const char* name, const H5A_info_t*, void* data) {
  const WalkedGroup& of = *static_cast<WalkedGroup*>(data);
  try {
    const double value = number_attribute(group, name, std::numeric_limits<double>::quiet_NaN());
    if (!std::isfinite(value)) return 0;
    StoredArray about;
    about.group = of.group;
    about.name = name;
    of.walked.to.begin_array(about);
    of.walked.to.add_column(&value, 1, 1);
    return 0;
  } catch (...) {
    of.walked.failure = std::current_exception();
    return 1;
  }
}

herr_t hand_over_attributes(hid_t group, const std::string& name, Walked& walked) {
  WalkedGroup of{walked, name};
  return H5Aiterate2(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, hand_over_attribute, &of);
}

herr_t hand_over_link(hid_t root, const char* path, const H5L_info_t* link, void* data) {
  Walked& walked = *static_cast<Walked*>(data);
  try {
    if (link->type != H5L_TYPE_HARD) return 0;
    const Hdf5Handle object(H5Oopen(root, path, H5P_DEFAULT), H5Oclose);
    if (object >= 0 && H5Iget_type(object) == H5I_GROUP)
      return hand_over_attributes(object, path, walked);
    if (object < 0 || H5Iget_type(object) != H5I_DATASET) return 0;

    StoredArray about;
    const std::string whole(path);
    const std::size_t slash = whole.rfind('/');
    if (slash != std::string::npos) about.group = whole.substr(0, slash);
    about.name = whole.substr(slash + 1);  // npos + 1 is 0
    const std::string reason = hand_over_dataset(object, about, walked.to);
    if (!reason.empty())
      walked.to.note({about.group, "dataset '" + whole + "' passed over: " + reason});
    return 0;
  } catch (...) {
    walked.failure = std::current_exception();
    return 1;
  }
}

}  // namespace

void hand_over_hdf5(const fs::path& path, StoredWriter& to) {
  const Hdf5Handle opened = open_hdf5(path.string());
  check_hdf5(opened, path.string(), fs::file_size(path));
  Walked walked{to, nullptr};
  hand_over_attributes(opened, "", walked);
  if (!walked.failure) H5Lvisit(opened, H5_INDEX_NAME, H5_ITER_NATIVE, hand_over_link, &walked);
  if (walked.failure) std::rethrow_exception(walked.failure);
}

}  // namespace dashpot
