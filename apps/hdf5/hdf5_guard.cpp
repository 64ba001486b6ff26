#include "hdf5_guard.h"

#include <algorithm>
#include <array>

#include "dashpot/error.h"
#include "dashpot/record/readers/stored_arrays.h"

namespace dashpot {
namespace {

/// What is wrong with a file of HDF5, found link by link; an exception must not pass through it.
struct Links {
  std::size_t most_values;  ///< of the whole file, as numbers of double precision
  std::size_t chunks_left;  ///< HDF5 keeps some hundred bytes of each in memory
  std::size_t values_left = most_values;
  std::size_t links_left = 100000;
  enum class Fault { None, Outside, Bomb, Damage } fault = Fault::None;

  herr_t stop(Fault found) {
    fault = found;
    return 1;
  }
};

/// A product that stays at one above the most that counts.
std::size_t bounded_product(std::size_t a, std::size_t b, std::size_t most) {
  return a > most / std::max<std::size_t>(b, 1) || b > most ? most + 1 : a * b;
}

/// The values of a chunk, which is unpacked as a whole, and how many chunks there are; or zeros.
struct Chunks {
  std::size_t values = 0, count = 0;
  bool fit = true;  ///< they have as many sides as the dataset, and none longer than it can be
};

Chunks chunks_of(hid_t creation, hid_t space, std::size_t most) {
  if (creation < 0 || space < 0 || H5Pget_layout(creation) != H5D_CHUNKED) return {};
  std::array<hsize_t, H5S_MAX_RANK> sides{}, extent{}, most_extent{};
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, sides.data());
  if (H5Sget_simple_extent_dims(space, extent.data(), most_extent.data()) != rank)
    return {0, 0, false};
  Chunks chunks{1, 1};
  for (std::size_t k = 0; k < static_cast<std::size_t>(std::max(rank, 0)); ++k) {
    // HDF5 makes no such chunk, and would read behind one that unpacks to fewer numbers.
    if (sides[k] > most_extent[k])
      return {0, 0, false};  // without a limit it is the largest number
    const hsize_t side = std::max<hsize_t>(sides[k], 1);
    chunks.values = bounded_product(chunks.values, sides[k], most);
    chunks.count = bounded_product(chunks.count, extent[k] / side + (extent[k] % side != 0), most);
  }
  return chunks;
}

/// Numbers that are wider than there are, or whose bits lie beside them: HDF5 would look for them
/// behind the end of its buffer.
bool cannot_be(hid_t type) {
  const H5T_class_t kind = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return false;
  const std::size_t size = H5Tget_size(type), bits = H5Tget_precision(type);
  const int offset = H5Tget_offset(type);
  if (size > sizeof(long double) || bits == 0 || offset < 0 ||
      bits + static_cast<std::size_t>(offset) > 8 * size)
    return true;

  // Sign, exponent and mantissa.
  if (kind == H5T_INTEGER) return false;
  std::size_t sign = 0, exponent = 0, exponent_bits = 0, mantissa = 0, mantissa_bits = 0;
  return H5Tget_fields(type, &sign, &exponent, &exponent_bits, &mantissa, &mantissa_bits) < 0 ||
         sign >= bits || exponent + exponent_bits > bits || mantissa + mantissa_bits > bits;
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
  const Chunks chunks = chunks_of(creation, space, links.most_values);
  if (!chunks.fit || cannot_be(type)) return links.stop(Links::Fault::Damage);
  if (values > links.values_left / width || chunks.values > links.most_values / width ||
      chunks.count > links.chunks_left)
    return links.stop(Links::Fault::Bomb);
  links.values_left -= values * width;
  links.chunks_left -= chunks.count;
  return 0;
}

}  // namespace

Hdf5Handle open_hdf5(const std::string& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // HDF5 prints otherwise
  H5PLset_loading_state(0);
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (opened < 0)
    throw Error(file, "is damaged or cut off: HDF5 cannot open it",
                "copy it again from its source");
  return {opened, H5Fclose};
}

void check_hdf5(hid_t opened, const std::string& file, std::uintmax_t file_size) {
  constexpr std::uintmax_t kChunksAlways = 100'000, kBytesPerChunk = 8;  // of its list
  Links links{.most_values = most_stored_bytes(file_size) / sizeof(double),
              .chunks_left = std::max(kChunksAlways, file_size / kBytesPerChunk)};
  const herr_t end = H5Lvisit(opened, H5_INDEX_NAME, H5_ITER_NATIVE, look_at_link, &links);
  if (links.fault == Links::Fault::Bomb)
    throw Error(file, "unpacks to far more than a recording of its size",
                "save it without compression, or its recordings one by one");
  if (links.fault == Links::Fault::Outside)
    throw Error(file, "takes numbers from other files, which Dashpot does not follow",
                "save it as one file");
  if (links.fault == Links::Fault::Damage)
    throw Error(file, "is damaged: what a dataset says of its numbers and of its chunks cannot be",
                "copy it again from its source");
  if (end < 0)
    throw Error(file, "is damaged or cut off: HDF5 cannot list what it holds",
                "copy it again from its source");
}

}  // namespace dashpot
