#include "dashpot/suspension/sweep/rides.h"

#include <algorithm>
#include <map>
#include <span>

#include "dashpot/error.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/lanes/batch.h"
#include "dashpot/suspension/ride/ride_measures.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostTraces = 16;

void require_ground(const GroundMotion& ground, const Plant& plant, const SweepRequest& request) {
  if (plant.tyres.empty() && !ground.shakes())
    throw Error(request.source, "'" + request.road + "' moves no building", "earthquake,file=...");
  if (plant.ground.empty() && ground.shakes())
    throw Error(request.source, "'" + request.road + "' shakes buildings, not the " + plant.name,
                "a road");
}

GroundPointer make_road(const SweepRequest& request, const SweepDraw& draw) {
  return make_ground(road_words(request, draw), draw.road_seed, request.source);
}

}  // namespace

SweepRider::SweepRider(const SweepRequest& request) : request_(request) {
  const SweepDraw first = draw_vehicle(request, 0);
  for (std::size_t c = 0; c < request.controllers.size(); ++c) {
    VehicleWords words = vehicle_words(request, c, first);
    words.where = request.source + ", " + request.controllers[c].name;
    examples_.push_back(make_vehicle(words));
    for (const auto* texts : {&examples_.back().warnings, &examples_.back().notes})
      for (const std::string& text : *texts)
        if (std::ranges::find(notes_, text) == notes_.end()) notes_.push_back(text);
  }
  const GroundPointer road = make_road(request, first);
  require_ground(*road, examples_.front().set.plant, request);
  if (std::string note = road_end_note(*road, request.duration); !note.empty())
    notes_.push_back(std::move(note));
}

std::optional<DriveUnit> SweepRider::drive() const {
  std::optional<DriveUnit> drive;
  for (const Vehicle& vehicle : examples_) {
    if (!(vehicle.limits.current_min < vehicle.limits.current_max)) continue;  // passive
    if (drive && *drive != vehicle.drive_unit) return std::nullopt;
    drive = vehicle.drive_unit;
  }
  return drive.value_or(DriveUnit::Ampere);
}

std::string SweepRider::foot() const {
  const Plant& plant = examples_.front().set.plant;
  return plant.tyres.empty() ? std::string() : foot_of(plant);
}

/// Dampers that all vehicles have in common are shared: their models are large, and finding their
/// limits takes time.
Vehicle SweepRider::make(const Task& task, const SweepDraw& draw) const {
  const VehicleWords words = vehicle_words(request_, task.controller, draw);
  if (varies_dampers(request_, task.controller)) return make_vehicle(words);

  const Vehicle& example = examples_[task.controller];
  Vehicle vehicle{.set = load_plant(words),
                  .dampers = example.dampers,
                  .damper_names = example.damper_names,
                  .domains = example.domains,
                  .drive_unit = example.drive_unit,
                  .controller_name = words.controller,
                  .limits = example.limits,
                  .sensors = words.sensors};

  // The controller's own parameters may vary.
  if (example.controller)
    vehicle.controller =
        make_controller(words.controller, {vehicle.limits, vehicle.set.plant}, words.where);
  return vehicle;
}

std::vector<SweepStore::Ride> SweepRider::ride(const std::vector<Task>& tasks,
                                               const Monitor& monitor) const {
  // Make the vehicles. All controllers of one meet the same road.
  std::map<std::size_t, GroundPointer> grounds;
  std::vector<Vehicle> vehicles;
  vehicles.reserve(tasks.size());
  std::vector<BatchVehicle> batch;
  for (const Task& task : tasks) {
    const SweepDraw draw = draw_vehicle(request_, task.vehicle);
    GroundPointer& ground = grounds[task.vehicle];
    if (!ground) ground = make_road(request_, draw);
    const Vehicle& vehicle = vehicles.emplace_back(make(task, draw));
    batch.push_back({vehicle.on(*ground), vehicle.limits, vehicle.sensors});
  }

  BatchOptions options{.duration = request_.duration,
                       .discard = request_.discard,
                       .relative_tolerance = request_.relative_tolerance,
                       .monitor = {.stop = monitor.stop}};
  options.traces = std::ranges::any_of(vehicles, needs_trace);

  // Traces take memory, so few vehicles ride at a time where these are needed.
  const std::size_t most = options.traces ? kMostTraces : tasks.size();
  std::vector<SweepStore::Ride> rides;
  for (std::size_t first = 0; first < tasks.size(); first += most) {
    const std::size_t count = std::min(most, tasks.size() - first);
    const std::vector<BatchResult> results =
        simulate_batch(std::span(batch).subspan(first, count), options);
    for (std::size_t k = 0; k < count; ++k) {
      const Task& task = tasks[first + k];
      rides.push_back({task.controller, task.vehicle,
                       measure_ride(vehicles[first + k], results[k], request_.discard)});
    }
  }
  return rides;
}

}  // namespace dashpot
