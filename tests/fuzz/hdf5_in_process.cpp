#include "dashpot/record/made_file.h"
#include "hdf5_arrays.h"
#include "made_files.h"
#include "mat_arrays.h"
#include "record/readers/arrays_in_process.h"

// In place of the library's stored_child.cpp and made_file.cpp: no process for each input, and a
// fault of HDF5, or of what calls it, is a finding.

dashpot::StoredArrays dashpot::read_stored_arrays(const std::filesystem::path& path,
                                                  StoredFormat format) {
  return arrays_of(format == StoredFormat::Mat ? hand_over_mat : hand_over_hdf5, path);
}

std::string dashpot::made_file(const std::string& how, std::string_view request) {
  return (how == "write-mat" ? mat_file : hdf5_file)(UnpackedBytes(request));
}
