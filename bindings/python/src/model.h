#pragma once
#include "arrays.h"

namespace dashpot_python {

/// A damper model: what dashpot.DamperModel is.
class Model : public Owner<dashpot_model, dashpot_model_free> {
 public:
  static Model load(const std::string& path) {
    return make([&](dashpot_model** out) { return dashpot_model_load(path.c_str(), out); });
  }
  static Model parse(const std::string& text) {
    return make([&](dashpot_model** out) { return dashpot_model_parse(text.c_str(), out); });
  }
  static Model published(const std::string& name) {
    return make([&](dashpot_model** out) { return dashpot_model_published(name.c_str(), out); });
  }
  template <class Call>
  static Model make(Call&& call) {
    Model model;
    check(call(model.out()));
    model.read_info();
    return model;
  }

  const dashpot_model_info& info() const { return info_; }
  void read_info() { check(dashpot_model_get_info(get(), &info_)); }

  void save(const std::string& path) const { check(dashpot_model_save(get(), path.c_str())); }
  std::string text() const {
    Text text;
    check(dashpot_model_text(get(), text.out()));
    return text.take();
  }

  std::string parameters() const {
    Text text;
    check(dashpot_model_parameters(get(), text.out()));
    return text.take();
  }

  py::object predict(const py::object& x, const py::object& sample_time, bool interval) const {
    if (!py::isinstance<py::array>(x) && py::hasattr(x, "columns"))
      return py::module_::import("dashpot._frames").attr("predict")(this, x, sample_time, interval);
    const py::array rows = as_float64(x, "X");
    dashpot_motion motion = motion_of(rows);
    motion.sample_time = seconds(sample_time, motion);
    return respond(motion, interval, nullptr, 0);
  }

  py::object run(const py::object& velocity, const py::object& current,
                 const py::object& displacement, const py::object& time,
                 const py::object& sample_time, const py::object& state, bool interval) const {
    Columns columns;
    dashpot_motion motion = {};
    motion.velocity = columns.add(velocity, "velocity");
    motion.current = columns.add(current, "current");
    motion.displacement = columns.add(displacement, "displacement");
    motion.time = columns.add(time, "time");
    motion.samples = columns.samples();
    motion.sample_time = seconds(sample_time, motion);
    if (state.is_none()) return respond(motion, interval, nullptr, 0);
    const Array kept = state_of(state);
    return respond(motion, interval, const_cast<double*>(kept.data()),
                   static_cast<size_t>(kept.size()));
  }

  Array rest(double displacement, double current) const {
    Array state(static_cast<py::ssize_t>(info_.state_size));
    const dashpot_input input = {displacement, 0, current};
    check(dashpot_rest(get(), &input, state.mutable_data(), info_.state_size));
    return state;
  }

  using Input = std::tuple<double, double, double>;
  void advance(const py::object& state, const Input& from, const Input& to, double dt) const {
    Array kept = state_of(state);
    const dashpot_input a = input_of(from), b = input_of(to);
    check(
        dashpot_advance(get(), &a, &b, dt, kept.mutable_data(), static_cast<size_t>(kept.size())));
  }

  double force(const py::object& state, const Input& at) const {
    const Array kept = state_of(state);
    const dashpot_input input = input_of(at);
    double force = 0;
    check(dashpot_force(get(), &input, kept.data(), static_cast<size_t>(kept.size()), &force));
    return force;
  }

 private:
  static dashpot_input input_of(const Input& input) {
    return {std::get<0>(input), std::get<1>(input), std::get<2>(input)};
  }

  /// s; the model's own where none is said, with a warning where no time tells whether it is that
  /// of these rows.
  double seconds(const py::object& sample_time, const dashpot_motion& motion) const {
    if (!sample_time.is_none()) return argument<double>(sample_time, "sample_time");
    if (info_.sample_time > 0 && motion.samples > 1 && !motion.time.data) {
      const std::string text = "neither a time nor a sample_time: the rows are taken as " +
                               py::repr(py::float_(info_.sample_time)).cast<std::string>() +
                               " s apart, as in the model's fit; sample_time=... says so";
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
    }
    return info_.sample_time;
  }

  /// The caller's array itself: what is written must be seen.
  static Array state_of(const py::object& state) {
    if (!py::isinstance<Array>(state))
      throw py::type_error("state is no float64 array; take that of rest()");
    auto array = py::reinterpret_borrow<Array>(state);
    const bool usable = array.ndim() == 1 &&
                        (array.size() < 2 || array.strides(0) == sizeof(double)) &&
                        array.writeable() && is_in_place(array);
    if (!usable) throw py::value_error("state is no contiguous, writeable array of one dimension");
    return array;
  }

  py::object respond(const dashpot_motion& motion, bool interval, double* state,
                     size_t state_size) const {
    constexpr size_t kWorthOthersRunning = 256;
    Array force(static_cast<py::ssize_t>(motion.samples));
    Array half_width(interval ? static_cast<py::ssize_t>(motion.samples) : 0);
    const dashpot_response response = {
        force.mutable_data(), interval ? half_width.mutable_data() : nullptr, state, state_size};
    dashpot_status status = DASHPOT_OK;
    if (motion.samples < kWorthOthersRunning) {
      status = dashpot_run(get(), &motion, &response);
    } else {
      const py::gil_scoped_release others_may_run;
      status = dashpot_run(get(), &motion, &response);
    }
    check(status);
    if (!interval) return force;
    return py::make_tuple(std::move(force), std::move(half_width));
  }

  dashpot_model_info info_ = {};
};

}  // namespace dashpot_python
