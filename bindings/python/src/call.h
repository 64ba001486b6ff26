#pragma once
#include <optional>
#include <string>
#include <type_traits>

#include <pybind11/pybind11.h>

#include "dashpot.h"

// From Python to C: statuses become exceptions, long work is watched.
namespace dashpot_python {

namespace py = pybind11;

/// dashpot.Error and dashpot.NotUsable, made when the module is loaded and kept for good.
struct Exceptions {
  py::handle error, not_usable;
};
inline Exceptions exceptions;

/// Raises what the status stands for.
inline void check(dashpot_status status) {
  if (status == DASHPOT_OK) return;
  if (status == DASHPOT_CANCELLED) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } else {
    const py::handle kind = status == DASHPOT_BAD_INPUT    ? exceptions.error
                            : status == DASHPOT_NOT_USABLE ? exceptions.not_usable
                                                           : py::handle(PyExc_RuntimeError);
    PyErr_SetString(kind.ptr(), dashpot_last_error());
  }
  throw py::error_already_set();
}

/// An argument that is a number, or a text. Raises TypeError at anything else.
template <class Wanted>
Wanted argument(const py::object& value, const char* name) {
  try {
    return value.cast<Wanted>();
  } catch (const py::cast_error&) {
    constexpr const char* kind = std::is_arithmetic_v<Wanted> ? " is no number: " : " is no text: ";
    throw py::type_error(name + (kind + py::repr(value).cast<std::string>()));
  }
}

/// Texts that the library made.
class Text {
 public:
  Text() = default;
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  ~Text() { dashpot_text_free(&text_); }
  char** out() { return &text_; }
  std::string take() const { return text_ ? text_ : ""; }

 private:
  char* text_ = nullptr;
};

/// The owner of a handle of the library.
template <class Handle, void (*give_back)(Handle**)>
class Owner {
 public:
  Owner() = default;
  Owner(Owner&& other) noexcept : handle_(other.handle_) { other.handle_ = nullptr; }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() { give_back(&handle_); }
  Handle** out() { return &handle_; }
  Handle* get() const { return handle_; }

 private:
  Handle* handle_ = nullptr;
};

/// Long work without the GIL: Ctrl-C and exceptions of the progress function stop it.
class Watched {
 public:
  explicit Watched(py::object progress) : progress_(std::move(progress)) {
    monitor_.context = this;
    monitor_.is_cancelled = [](void* self) { return static_cast<Watched*>(self)->ask(); };
    if (!progress_.is_none())
      monitor_.on_progress = [](const char* stage, double fraction, void* self) {
        static_cast<Watched*>(self)->tell(stage, fraction);
      };
  }

  template <class Work>
  void run(Work&& work) {
    dashpot_status status = DASHPOT_OK;
    {
      const py::gil_scoped_release others_may_run;
      status = work(&monitor_);
    }
    if (raised_) throw std::move(*raised_);
    check(status);
  }

 private:
  int ask() noexcept {
    if (raised_) return 1;
    const py::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }

  void tell(const char* stage, double fraction) noexcept {
    if (raised_) return;
    const py::gil_scoped_acquire python;
    try {
      progress_(stage, fraction);
    } catch (py::error_already_set& error) {
      raised_.emplace(std::move(error));
    }
  }

  py::object progress_;
  dashpot_monitor monitor_ = {};
  std::optional<py::error_already_set> raised_;
};

}  // namespace dashpot_python
