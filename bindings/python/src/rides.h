#pragma once
#include "model.h"
#include "recordings.h"

namespace dashpot_python {

/// What sensors recorded of a plant: what dashpot.identify_in_plant, dashpot.observe and
/// dashpot.watch take.
class Rides : public Owner<dashpot_rides, dashpot_rides_free> {
 public:
  Rides() { check(dashpot_rides_new(out())); }

  size_t count() const { return dashpot_rides_count(get()); }
  void load(const std::string& path) { check(dashpot_rides_load(get(), path.c_str())); }

  /// `table`: name -> array.
  void add(const py::dict& table, double sample_time) {
    Columns arrays;
    const NamedColumns named(table, arrays);
    dashpot_table copied = {};
    copied.samples = arrays.samples();
    copied.sample_time = sample_time;
    copied.columns = named.columns.data();
    copied.column_count = named.columns.size();
    check(dashpot_rides_add(get(), &copied));
  }
};

inline py::tuple identify_in_plant(const Rides& rides, const std::string& plant,
                                   const std::string& options, py::object progress) {
  Model model;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_identify_in_plant(rides.get(), plant.c_str(), options.c_str(), monitor,
                                     model.out(), report.out());
  });
  model.read_info();
  return py::make_tuple(std::move(model), report.take());
}

inline py::tuple observe(const Model& model, const Rides& rides, const std::string& plant,
                         const std::string& options, py::object progress) {
  Recordings estimates;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_observe(model.get(), rides.get(), plant.c_str(), options.c_str(), monitor,
                           estimates.out(), report.out());
  });
  return py::make_tuple(std::move(estimates), report.take());
}

inline std::string watch(const Model& model, const Rides& rides, const std::string& plant,
                         const std::string& options, py::object progress) {
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_watch(model.get(), rides.get(), plant.c_str(), options.c_str(), monitor,
                         report.out());
  });
  return report.take();
}

}  // namespace dashpot_python
