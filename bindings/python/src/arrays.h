#pragma once
#include <vector>

#include <pybind11/numpy.h>

#include "call.h"

// NumPy's arrays where they lie, as columns of the library.
namespace dashpot_python {

using Array = py::array_t<double>;

/// Whether the samples can be read in place: float64, aligned, strides of whole numbers.
inline bool is_in_place(const py::array& array) {
  if (!py::isinstance<Array>(array)) return false;
  if (!(array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_)) return false;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    if (array.strides(axis) % static_cast<py::ssize_t>(sizeof(double)) != 0) return false;
  return true;
}

/// The array itself, or a copy of other numbers as float64. Raises TypeError, which calls it by its
/// name, at what is not real numbers.
inline py::array as_float64(const py::object& values, const char* name) {
  // A kind of array of its own, as one with a mask, says more than its samples.
  if (reinterpret_cast<PyObject*>(Py_TYPE(values.ptr())) ==
      reinterpret_cast<PyObject*>(py::detail::npy_api::get().PyArray_Type_)) {
    auto array = py::reinterpret_borrow<py::array>(values);
    if (is_in_place(array)) return array;
  }
  return py::module_::import("dashpot._arrays").attr("as_float64")(values, name).cast<py::array>();
}

inline ptrdiff_t stride(const py::array& array, py::ssize_t axis) {
  return array.strides(axis) / static_cast<py::ssize_t>(sizeof(double));
}

/// Columns of a motion, each an array of its own, which lives as long as this.
class Columns {
 public:
  /// One value, or one per sample. None: an absent column.
  dashpot_column add(const py::object& values, const char* name) {
    if (values.is_none()) return {nullptr, 0};
    py::array array = as_float64(values, name);
    const auto* data = static_cast<const double*>(array.data());
    if (array.ndim() > 1)
      throw py::value_error(std::string(name) + " has " + std::to_string(array.ndim()) +
                            " dimensions; one value per sample, or one for all");
    ptrdiff_t step = 0;
    if (array.ndim() == 1) {
      take_size(array.shape(0), name);
      step = stride(array, 0);
    }
    arrays_.push_back(std::move(array));
    return {data, step};
  }
  /// Samples of the columns that have one value each; 1 where none has.
  size_t samples() const { return samples_ < 0 ? 1 : static_cast<size_t>(samples_); }

 private:
  void take_size(py::ssize_t size, const char* name) {
    if (samples_ >= 0 && size != samples_)
      throw py::value_error(std::string(name) + " has " + std::to_string(size) +
                            " samples, the columns before it " + std::to_string(samples_));
    samples_ = size;
  }

  std::vector<py::array> arrays_;
  py::ssize_t samples_ = -1;
};

/// X of predict(): rows are samples; 2 columns are velocity and current, 3 have displacement before
/// them, 4 time before that.
inline dashpot_motion motion_of(const py::array& x) {
  const py::ssize_t count = x.ndim() == 2 ? x.shape(1) : 0;
  if (count < 2 || count > 4)
    throw py::value_error(
        "X has the wrong shape: one row per sample, its columns velocity, current; displacement, "
        "velocity, "
        "current; or time, displacement, velocity, current");
  const auto column = [&](py::ssize_t k) {
    return dashpot_column{static_cast<const double*>(x.data()) + k * stride(x, 1), stride(x, 0)};
  };
  dashpot_motion motion = {};
  motion.samples = static_cast<size_t>(x.shape(0));
  motion.current = column(count - 1);
  motion.velocity = column(count - 2);
  if (count >= 3) motion.displacement = column(count - 3);
  if (count == 4) motion.time = column(0);
  return motion;
}

}  // namespace dashpot_python
