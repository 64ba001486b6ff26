#pragma once
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <hdf5.h>

// A small writer of HDF5 files, for tests and as seeds of fuzzing.

/// A dataset of one or two dimensions, deflated in chunks, with its unit.
inline void write_hdf5_dataset(hid_t group, const char* name, hid_t type, const void* data,
                               hsize_t rows, hsize_t columns, const char* unit) {
  const hsize_t sides[] = {rows, columns};
  const hid_t space = H5Screate_simple(columns > 1 ? 2 : 1, sides, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, columns > 1 ? 2 : 1, sides);
  H5Pset_shuffle(creation);
  H5Pset_deflate(creation, 6);
  const hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  if (std::strlen(unit) > 0) {
    const hid_t text = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
    H5Tset_size(text, std::strlen(unit));
    const hid_t attribute = H5Acreate2(set, "unit", text, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, text, unit);
    H5Aclose(attribute), H5Sclose(one), H5Tclose(text);
  }
  H5Dclose(set), H5Pclose(creation), H5Sclose(space);
}

/// In each group t (s), x (mm, 16 bits), F (two columns of single precision), a number and a text.
inline void write_example_hdf5(const std::filesystem::path& path,
                               const std::vector<std::string>& groups) {
  constexpr hsize_t kRows = 40;
  double t[kRows], seven = 7;
  short x[kRows];
  float force[kRows][2];
  for (hsize_t k = 0; k < kRows; ++k) {
    t[k] = 0.01 * double(k), x[k] = static_cast<short>(k % 7);
    force[k][0] = float(k), force[k][1] = 0.1f;
  }

  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (const std::string& name : groups) {
    const hid_t group = H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    write_hdf5_dataset(group, "t", H5T_NATIVE_DOUBLE, t, kRows, 1, "s");
    write_hdf5_dataset(group, "x", H5T_NATIVE_SHORT, x, kRows, 1, "mm");
    write_hdf5_dataset(group, "F", H5T_NATIVE_FLOAT, force, kRows, 2, "N");
    write_hdf5_dataset(group, "seven", H5T_NATIVE_DOUBLE, &seven, 1, 1, "");
    const hid_t text = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
    H5Tset_size(text, 4);
    const hid_t words =
        H5Dcreate2(group, "words", text, one, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(words, text, H5S_ALL, H5S_ALL, H5P_DEFAULT, "none");
    H5Dclose(words), H5Sclose(one), H5Tclose(text), H5Gclose(group);
  }
  H5Fclose(file);
}

/// Takes the sides of its chunks from the first column of a file: HDF5 1.10.8 divides by them, and
/// ends its process.
inline std::string without_chunk_sides(std::string bytes) {
  const std::string layout("\x03\x02\x02", 3);  // version, in chunks, one dimension and the bytes
  const std::size_t at = bytes.find(layout);
  if (at == std::string::npos) throw std::runtime_error("there is no column in chunks");
  bytes[at + 2] = 0;
  return bytes;
}
