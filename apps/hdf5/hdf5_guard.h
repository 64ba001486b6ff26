#pragma once
#include <cstdint>
#include <string>

#include <hdf5.h>

namespace dashpot {

/// A handle of HDF5, closed at its end.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor)

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Throws Error when HDF5 cannot open it. Filters that would be loaded from the disk are switched
/// off for the process.
Hdf5Handle open_hdf5(const std::string& file);

/// Before anything of an open HDF5 file is read: throws Error on numbers that lie in other files,
/// on datasets and chunks that state far more numbers than a file of this size has, on more chunks
/// than its lists have room for, on numbers and chunks that cannot be, and on a file that HDF5
/// cannot list.
void check_hdf5(hid_t opened, const std::string& file, std::uintmax_t file_size);

}  // namespace dashpot
