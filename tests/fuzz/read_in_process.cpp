#include "hdf5_arrays.h"
#include "mat_arrays.h"
#include "record/readers/arrays_in_process.h"

// In place of the library's stored_child.cpp: no process for each input, and a fault of HDF5, or of
// what calls it, is a finding.
dashpot::StoredArrays dashpot::read_stored_arrays(const std::filesystem::path& path,
                                                  StoredFormat format) {
  return arrays_of(format == StoredFormat::Mat ? hand_over_mat : hand_over_hdf5, path);
}
