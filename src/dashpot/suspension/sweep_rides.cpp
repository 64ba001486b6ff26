#include "dashpot/suspension/sweep_rides.h"

#include <algorithm>
#include <map>

#include "dashpot/base/error.h"
#include "dashpot/suspension/batch.h"
#include "dashpot/suspension/ground_sequences.h"

namespace dashpot {
namespace {

void require_ground(const GroundMotion& ground, const Plant& plant, const SweepRequest& request) {
  if (plant.tyres.empty() && !ground.shakes())
    throw Error(request.source, "'" + request.road + "' moves no building", "earthquake,file=...");
  if (plant.ground.empty() && ground.shakes())
    throw Error(request.source, "'" + request.road + "' shakes buildings, not the " + plant.name, "a road");
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
    for (const std::string& note : examples_.back().notes)
      if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
  }
  require_ground(*make_road(request, first), examples_.front().set.plant, request);
}

/// Dampers that are those of every vehicle are shared: their models are large, and their limits take work.
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
  if (example.controller)
    vehicle.controller = make_controller(words.controller, {vehicle.limits, vehicle.set.plant}, words.where);
  return vehicle;
}

std::vector<SweepStore::Ride> SweepRider::ride(const std::vector<Task>& tasks, const Monitor& monitor) const {
  std::map<std::size_t, GroundPointer> grounds;  // a vehicle's controllers meet the same road
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
  std::vector<BatchResult> results = simulate_batch(batch, {.duration = request_.duration,
                                                            .discard = request_.discard,
                                                            .relative_tolerance = request_.relative_tolerance,
                                                            .traces = true,
                                                            .monitor = {.stop = monitor.stop}});
  std::vector<SweepStore::Ride> rides;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Trace trace{.record = std::move(results[k].trace), .diverged_at = results[k].diverged_at};
    rides.push_back(
        {tasks[k].controller, tasks[k].vehicle, measure_ride(vehicles[k], trace, request_.discard)});
  }
  return rides;
}

}  // namespace dashpot
