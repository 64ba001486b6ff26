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
  constexpr std::size_t kMostDampers = 16;
  dashpot_model* found[kMostDampers];
  std::size_t count = 0;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_identify_dampers_in_plant(rides.get(), plant.c_str(), options.c_str(), monitor,
                                             found, kMostDampers, &count, report.out());
  });
  py::list models;
  for (std::size_t kind = 0; kind < count; ++kind) {
    Model model;
    *model.out() = found[kind];
    model.read_info();
    models.append(std::move(model));
  }
  return py::make_tuple(std::move(models), report.take());
}

/// The dampers of a plant: one model for all, or one for each strut.
class PlacedModels {
 public:
  explicit PlacedModels(const py::object& given) {
    if (!py::isinstance<py::dict>(given)) {
      dampers_ = {{nullptr, py::cast<const Model&>(given).get()}};
      return;
    }
    for (const auto& [strut, model] : py::cast<py::dict>(given))
      placed_.emplace_back(py::cast<std::string>(strut), py::cast<const Model&>(model).get());
    for (const auto& [strut, model] : placed_) dampers_.push_back({strut.c_str(), model});
  }

  /// For a function of C: its dampers with their count.
  const dashpot_placed_model* data() const { return dampers_.data(); }
  size_t size() const { return dampers_.size(); }

 private:
  std::vector<std::pair<std::string, const dashpot_model*>> placed_;
  std::vector<dashpot_placed_model> dampers_;
};

/// `dampers`: a Model, or a dict of them by the names of the struts, which the caller holds.
inline py::tuple observe(const py::object& dampers, const Rides& rides, const std::string& plant,
                         const std::string& options, py::object progress) {
  const PlacedModels placed(dampers);
  Recordings estimates;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_observe_dampers(placed.data(), placed.size(), rides.get(), plant.c_str(),
                                   options.c_str(), monitor, estimates.out(), report.out());
  });
  return py::make_tuple(std::move(estimates), report.take());
}

inline py::tuple evaluate_in_plant(const py::object& dampers, const Rides& rides,
                                   const std::string& plant, const std::string& options,
                                   py::object progress) {
  const PlacedModels placed(dampers);
  Recordings runs;
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_evaluate_in_plant(placed.data(), placed.size(), rides.get(), plant.c_str(),
                                     options.c_str(), monitor, runs.out(), report.out());
  });
  return py::make_tuple(std::move(runs), report.take());
}

inline std::string watch(const py::object& dampers, const Rides& rides, const std::string& plant,
                         const std::string& options, py::object progress) {
  const PlacedModels placed(dampers);
  Text report;
  Watched(std::move(progress)).run([&](const dashpot_monitor* monitor) {
    return dashpot_watch_dampers(placed.data(), placed.size(), rides.get(), plant.c_str(),
                                 options.c_str(), monitor, report.out());
  });
  return report.take();
}

}  // namespace dashpot_python
