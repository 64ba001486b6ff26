#include "dashpot/record/readers/hdf5_guard.h"

#include <algorithm>
#include <array>

#include "dashpot/error.h"

namespace dashpot {
namespace {

/// What is wrong with a file of HDF5, found link by link; an exception must not pass through it.
struct Links {
  std::size_t most_values;  ///< of the whole file, as numbers of double precision
  std::size_t values_left = most_values;
  std::size_t links_left = 100000;
  enum class Fault { None, Outside, Bomb } fault = Fault::None;

  herr_t stop(Fault found) {
    fault = found;
    return 1;
  }
};

/// The values of a chunk, which is unpacked as a whole, or 0.
std::size_t values_in_chunk(hid_t creation, std::size_t most) {
  if (creation < 0 || H5Pget_layout(creation) != H5D_CHUNKED) return 0;
  std::array<hsize_t, H5S_MAX_RANK> sides{};
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, sides.data());
  std::size_t values = 1;
  for (int k = 0; k < rank; ++k) {
    const auto side = static_cast<std::size_t>(sides[static_cast<std::size_t>(k)]);
    if (side > most || values > most / std::max<std::size_t>(side, 1)) return most + 1;
    values *= side;
  }
  return values;
}

herr_t look_at_link(hid_t group, const char* name, const H5L_info_t* link, void* data) {
  Links& links = *static_cast<Links*>(data);
  if (links.links_left-- == 0) return links.stop(Links::Fault::Bomb);
  if (link->type == H5L_TYPE_SOFT) return 0;
  if (link->type != H5L_TYPE_HARD) return links.stop(Links::Fault::Outside);
  const Hdf5Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
  if (object < 0 || H5Iget_type(object) != H5I_DATASET) return 0;

  // A dataset can take its numbers from other files, or state more of them than the file has.
  const Hdf5Handle creation(H5Dget_create_plist(object), H5Pclose);
  if (creation >= 0 &&
      (H5Pget_external_count(creation) > 0 || H5Pget_layout(creation) == H5D_VIRTUAL))
    return links.stop(Links::Fault::Outside);
  const Hdf5Handle space(H5Dget_space(object), H5Sclose), type(H5Dget_type(object), H5Tclose);
  const hssize_t count = space < 0 ? 0 : H5Sget_simple_extent_npoints(space);
  const std::size_t width = type < 0 ? 1 : std::max<std::size_t>(H5Tget_size(type) / 8, 1);
  const auto values = static_cast<std::size_t>(std::max<hssize_t>(count, 0));
  if (values > links.values_left / width ||
      values_in_chunk(creation, links.most_values) > links.most_values / width)
    return links.stop(Links::Fault::Bomb);
  links.values_left -= values * width;
  return 0;
}

}  // namespace

std::mutex& hdf5_turn() {
  static std::mutex turn;
  return turn;
}

void check_hdf5(const std::string& file, std::uintmax_t file_size) {
  constexpr std::uintmax_t kAlways = std::uintmax_t{64} << 20, kPerByte = 12;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // HDF5 prints otherwise
  H5PLset_loading_state(0);
  const Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (opened < 0)
    throw Error(file, "is damaged or cut off: HDF5 cannot open it",
                "copy it again from its source");

  Links links{.most_values = std::max(kAlways, kPerByte * file_size) / sizeof(double)};
  const herr_t end = H5Lvisit(opened, H5_INDEX_NAME, H5_ITER_NATIVE, look_at_link, &links);
  if (links.fault == Links::Fault::Bomb)
    throw Error(file, "unpacks to far more than a recording of its size",
                "save it without compression, or its recordings one by one");
  if (links.fault == Links::Fault::Outside)
    throw Error(file, "takes numbers from other files, which Dashpot does not follow",
                "save it as one file");
  if (end < 0)
    throw Error(file, "is damaged or cut off: HDF5 cannot list what it holds",
                "copy it again from its source");
}

}  // namespace dashpot
