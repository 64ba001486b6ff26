#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "model.h"
#include "recordings.h"
#include "rides.h"

using namespace dashpot_python;

namespace {

class Ranking : public Owner<dashpot_ranking, dashpot_ranking_free> {
 public:
  size_t count() const { return dashpot_ranking_count(get()); }
  Model model(size_t place) const {
    return Model::make(
        [&](dashpot_model** out) { return dashpot_ranking_model(get(), place, out); });
  }
  std::string report(const std::string& format) const {
    Text text;
    check(dashpot_ranking_report(get(), format.c_str(), text.out()));
    return text.take();
  }
};

py::tuple fit(const Recordings& recordings, const std::string& options, py::object progress) {
  Model model;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_fit(recordings.get(), options.c_str(), monitor, model.out(), report.out());
  });
  model.read_info();
  return py::make_tuple(std::move(model), report.take());
}

Ranking identify(const Recordings& recordings, const std::string& options, py::object progress) {
  Ranking ranking;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_identify(recordings.get(), options.c_str(), monitor, ranking.out());
  });
  return ranking;
}

std::string evaluate(const Model& model, const Recordings& recordings, const std::string& options) {
  Text report;
  dashpot_status status = DASHPOT_OK;
  {
    const py::gil_scoped_release others_may_run;
    status = dashpot_evaluate(model.get(), recordings.get(), options.c_str(), report.out());
  }
  check(status);
  return report.take();
}

Recordings traces(const Model& model, const Recordings& recordings, const std::string& options) {
  Recordings made;
  dashpot_status status = DASHPOT_OK;
  {
    const py::gil_scoped_release others_may_run;
    status = dashpot_traces(model.get(), recordings.get(), options.c_str(), made.out());
  }
  check(status);
  return made;
}

std::string characterise(const Recordings& recordings, const std::string& options) {
  Text text;
  dashpot_status status = DASHPOT_OK;
  {
    const py::gil_scoped_release others_may_run;
    status = dashpot_characterise(recordings.get(), options.c_str(), text.out());
  }
  check(status);
  return text.take();
}

/// `things`: (name, Model or Recordings) each.
std::string compare(const std::vector<std::pair<std::string, py::object>>& things,
                    const std::string& options) {
  std::vector<dashpot_thing> named;
  for (const auto& [name, thing] : things) {
    const bool is_model = py::isinstance<Model>(thing);
    named.push_back({name.c_str(), is_model ? thing.cast<const Model&>().get() : nullptr,
                     is_model ? nullptr : thing.cast<const Recordings&>().get()});
  }
  Text text;
  dashpot_status status = DASHPOT_OK;
  {
    const py::gil_scoped_release others_may_run;
    status = dashpot_compare(named.data(), named.size(), options.c_str(), text.out());
  }
  check(status);
  return text.take();
}

std::string export_files(const Model& model, const std::string& options) {
  Text report;
  dashpot_status status = DASHPOT_OK;
  {
    const py::gil_scoped_release others_may_run;
    status = dashpot_export(model.get(), options.c_str(), report.out());
  }
  check(status);
  return report.take();
}

py::tuple simulate(const std::string& options, py::object progress) {
  Recordings trace;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_simulate(options.c_str(), monitor, trace.out(), report.out());
  });
  return py::make_tuple(std::move(trace), report.take());
}

py::tuple understand_column(const std::string& name) {
  dashpot_column_meaning meaning = {};
  check(dashpot_understand_column(name.c_str(), &meaning));
  return py::make_tuple(meaning.channel, meaning.factor, meaning.shift);
}

/// What a model says of itself, from its info.
template <class Field>
auto reading(Field dashpot_model_info::* field) {
  return [field](const Model& model) { return model.info().*field; };
}

py::dict domain(const Model& model) {
  const dashpot_model_info& info = model.info();
  py::dict ranges;
  ranges["displacement"] = py::make_tuple(info.displacement_min, info.displacement_max);
  ranges["velocity"] = py::make_tuple(info.velocity_min, info.velocity_max);
  ranges["current"] = py::make_tuple(info.current_min, info.current_max);
  return ranges;
}

/// An object that __new__ made would own nothing: such a class has no __new__ of its own.
void only_made_by_dashpot(PyHeapTypeObject* type) {
  type->ht_type.tp_new = [](PyTypeObject* asked, PyObject*, PyObject*) -> PyObject* {
    PyErr_Format(PyExc_TypeError,
                 "%s is not made by itself; load(), published(), identify() ... make one",
                 asked->tp_name);
    return nullptr;
  };
}

void bind_model(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  py::class_<Model>(module, "DamperModel",
                    "A damper model: motion and current in, force out. It never changes.\n\n"
                    "SI units; extension positive; the force positive when it resists extension.\n"
                    "Made by load(), published(), identify() or Identifier.fit().",
                    py::custom_type_setup(only_made_by_dashpot))
      .def_static(
          "load", [](const std::filesystem::path& path) { return Model::load(path.string()); },
          arg("path"), "The model of a file that save() or `dashpot identify` wrote.")
      .def_static("from_json", &Model::parse, arg("text"), "The model of such a file's text.")
      .def_static("published", &Model::published, arg("name"),
                  "A parameter set of the literature by its name, as \"spencer1997\".")
      .def(
          "save",
          [](const Model& model, const std::filesystem::path& path) { model.save(path.string()); },
          arg("path"), "Writes a model file (JSON).")
      .def("to_json", &Model::text, "The text of its model file.")
      .def("_parameters", &Model::parameters)
      .def_property_readonly(
          "parameters",
          [](const py::object& self) {
            return py::module_::import("dashpot._looks").attr("parameters")(self);
          },
          "The numbers of a law, a dict by name: value, unit, meaning, and low and high of the 95 "
          "% "
          "interval\n"
          "(None where the file has none of a fit). Empty where the model is no law.")
      .def_property_readonly(
          "covariance",
          [](const py::object& self) {
            return py::module_::import("dashpot._looks").attr("covariance")(self);
          },
          "Their covariance matrix, in the order of `parameters`; None where the file has none.")
      .def(
          "traces",
          [](const py::object& self, const py::object& recordings, const py::kwargs& options) {
            return py::module_::import("dashpot._looks")
                .attr("traces")(self, recordings, **options);
          },
          arg("recordings"),
          "What evaluate() judges, sample by sample: Recordings with \"measured [N]\", \"modelled "
          "[N]\" and\n"
          "\"residual [N]\" beside motion and drive. Options as for evaluate().")
      .def_property_readonly("name", reading(&dashpot_model_info::name), "\"tanh_kwok\"")
      .def_property_readonly("kind", reading(&dashpot_model_info::kind),
                             "\"law\", \"network\", \"narx\" ...")
      .def_property_readonly("title", reading(&dashpot_model_info::title), "For people.")
      .def_property_readonly("drive_unit", reading(&dashpot_model_info::drive_unit),
                             "\"A\", or \"V\": then every current is a voltage.")
      .def_property_readonly("state_size", reading(&dashpot_model_info::state_size),
                             "Numbers in a state array.")
      .def_property_readonly("parameter_count", reading(&dashpot_model_info::parameter_count),
                             "Numbers that were fitted.")
      .def_property_readonly(
          "needs_displacement",
          [](const Model& model) { return model.info().needs_displacement != 0; },
          "Whether velocity and current alone do not do.")
      .def_property_readonly("sample_time", reading(&dashpot_model_info::sample_time),
                             "s between the samples that it was fitted on; 0: mixed or unknown.")
      .def_property_readonly(
          "interval_level", reading(&dashpot_model_info::interval_level),
          "Share of left-out samples that its band claims to hold; 0: it has no band.")
      .def_property_readonly(
          "domain", &domain,
          "Ranges of the data that it was fitted on: displacement m, velocity m/s, current A "
          "(or V). Outside, it extrapolates. All 0: unknown.")
      .def("predict", &Model::predict, arg("X"), arg("sample_time") = none, arg("interval") = false,
           "Force, N, in free run from rest, one per row of X.\n\n"
           "X: a float64 array, read where it lies whatever its strides (other numbers are "
           "copied): columns\n"
           "velocity m/s, current A; or displacement m before them; or time s before that. Or a "
           "DataFrame "
           "whose\n"
           "columns tell by their names what they are (\"velocity [mm/s]\"); the result is then a "
           "Series.\n"
           "sample_time: s between rows without a time; None: that of the fit, with a warning.\n"
           "interval: returns (force, half_width), the model's band being force +- half_width.\n"
           "Raises Error on input that cannot be used, NotUsable where the model diverges.")
      .def("run", &Model::run, arg("velocity"), arg("current"), arg("displacement") = none,
           arg("time") = none, arg("sample_time") = none, arg("state") = none,
           arg("interval") = false,
           "As predict(), from separate columns (m/s, A, m, s), each an array or one value for all "
           "samples.\n\n"
           "state: an array of rest(): the run begins there and leaves its end in it; to go on, "
           "begin with "
           "the\n"
           "last sample again.")
      .def("rest", &Model::rest, arg("displacement") = 0.0, arg("current") = 0.0,
           "A state array: after a long rest at this displacement, m, and current, A.")
      .def("advance", &Model::advance, arg("state"), arg("start"), arg("end"), arg("dt"),
           "Brings the state array dt s further. start, end: (displacement m, velocity m/s, "
           "current A); "
           "linear\n"
           "in between.")
      .def("force", &Model::force, arg("state"), arg("at"),
           "N at (displacement m, velocity m/s, current A).")
      .def(
          "score",
          [](const py::object& self, const py::object& x, const py::object& y,
             const py::object& sample_time) {
            return py::module_::import("dashpot._learn").attr("score")(self, x, y, sample_time);
          },
          arg("X"), arg("y"), arg("sample_time") = none,
          "R2 of predict(X) against the measured force y, N; of lists of recordings: over all "
          "their samples.")
      .def(
          "evaluate",
          [](const py::object& self, const py::object& recordings, const py::kwargs& options) {
            return py::module_::import("dashpot._identify")
                .attr("evaluate")(self, recordings, **options);
          },
          arg("recordings"),
          "The figures of `dashpot evaluate --json`, as a dict. recordings: Recordings, or paths.\n"
          "force_offset: \"record\" (each recording has a free force zero) or \"none\"; threads: 0 "
          "for all.\n"
          "keep_inertia: leave the force as recorded where the model was fitted to forces without "
          "the inertia\n"
          "between load cell and damper, which is taken off here, too.")
      .def(
          "export",
          [](const py::object& self, const py::object& to, const py::object& folder,
             const py::kwargs& options) {
            return py::module_::import("dashpot._export")
                .attr("export")(self, to, folder, **options);
          },
          arg("to"), arg("folder") = "dashpot-export",
          "Writes the model as files for other programs, as `dashpot export` does; returns their "
          "paths.\n\n"
          "to: \"c\", \"fmu2\", \"fmu3\", \"tables\" ..., one or a list; `dashpot help export "
          "--to` "
          "has all.\n"
          "name: of the files and of the functions in them (\"\": the model's). precision: "
          "\"double\" or\n"
          "\"float\", of numbers in C. sample_time: s between two steps (0: that of the model's "
          "data, or 1 "
          "ms).\n"
          "compiler: of C, for the binary in an FMU (\"\": $CC, or cc). sources_only: an FMU "
          "without a "
          "binary.\n"
          "Raises Error where the model cannot become that; then nothing is written.")
      .def("__repr__",
           [](const Model& model) {
             return "<dashpot.DamperModel " + std::string(model.info().name) + ", " +
                    model.info().kind + ", " + std::to_string(model.info().parameter_count) +
                    " parameters>";
           })
      .def("__reduce__", [](const Model& model) {
        return py::make_tuple(py::module_::import("dashpot._looks").attr("from_json"),
                              py::make_tuple(model.text()));
      });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Dashpot's C boundary; use the package dashpot.";
  module.attr("__version__") = dashpot_version();
  static py::exception<void> error(module, "Error", PyExc_ValueError);
  error.doc() = "Input that cannot be used: where, what, what would be right.";
  static py::exception<void> not_usable(module, "NotUsable", PyExc_RuntimeError);
  not_usable.doc() = "It ran, but a model diverged or a fit failed.";
  exceptions = {error, not_usable};

  bind_model(module);
  py::class_<Recordings>(module, "_Recordings", py::custom_type_setup(only_made_by_dashpot))
      .def_static("load", &Recordings::load)
      .def_static("empty", &Recordings::empty)
      .def("__len__", &Recordings::count)
      .def("add", &Recordings::add)
      .def("describe", &Recordings::describe)
      .def("unread", &Recordings::unread)
      .def("suspects", &Recordings::suspects)
      .def("record", &Recordings::record);
  py::class_<Ranking>(module, "_Ranking", py::custom_type_setup(only_made_by_dashpot))
      .def("__len__", &Ranking::count)
      .def("model", &Ranking::model)
      .def("report", &Ranking::report);
  module.def("fit", &fit);
  module.def("identify", &identify);
  module.def("evaluate", &evaluate);
  module.def("traces", &traces);
  module.def("characterise", &characterise);
  module.def("compare", &compare);
  module.def("export", &export_files);
  module.def("simulate", &simulate);
  py::class_<Rides>(module, "_Rides")
      .def(py::init<>())
      .def("__len__", &Rides::count)
      .def("load", &Rides::load)
      .def("add", &Rides::add);
  module.def("identify_in_plant", &identify_in_plant);
  module.def("evaluate_in_plant", &evaluate_in_plant);
  module.def("observe", &observe);
  module.def("watch", &watch);
  module.def("understand_column", &understand_column);
}
