#pragma once
#include <string>

#include "dashpot/base/packed_bytes.h"

namespace dashpot {

/// The bytes of a MAT file of version 5, of what mat_bytes hands over; see there. Throws Error when
/// the memory does not take it whole.
std::string mat_file(UnpackedBytes request);

/// The bytes of a file of HDF5, of what write_hdf5 hands over; see there. They are made in memory:
/// a disk that fills up under HDF5 leaves a file that it tries to finish when the program ends, and
/// crashes. Throws Error where one cannot be made.
std::string hdf5_file(UnpackedBytes request);

}  // namespace dashpot
