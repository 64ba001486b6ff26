#pragma once
#include "dashpot/suspension/lanes/batch.h"
#include "ride_case.h"

// Dashpot's own rides: one vehicle and a batch of 32 in lanes, and one by simulate().
namespace peer {

inline RideTrace trace_of(const dashpot::Record& record, const std::string& wheel = "wheel") {
  RideTrace trace(record.time.size());
  std::size_t c = 0;
  for (const std::string& name :
       {std::string("body"), wheel, std::string("body_velocity"), wheel + "_velocity"}) {
    const std::vector<double>& samples = record.channel(name).samples;
    for (std::size_t k = 0; k < trace.size(); ++k) trace[k][c] = samples[k];
    ++c;
  }
  return trace;
}

class OwnRides {
 public:
  explicit OwnRides(Ride ride, int vehicles)
      : plant_(ride_plant(ride)),
        limits_{.current_max = row_of(ride).drive_max, .sample_time = kSample},
        dampers_(row_of(ride).struts, ride_damper(ride)),
        mix1_(dashpot::make_controller("mix1,crossover=1.9Hz", {limits_, plant_})) {
    for (int k = 0; k < vehicles; ++k) roads_.push_back(dashpot::drive_over(ride_road(k), kSpeed));
    for (const dashpot::GroundPointer& road : roads_)
      vehicles_.push_back({{plant_, dampers_, *road, mix1_.get()}, limits_, {}});
  }

  /// CPU seconds per vehicle; the trace is the first one's.
  double in_lanes(RideTrace* trace) const {
    const double start = cpu_seconds();
    const auto results = simulate_batch(vehicles_, {.duration = kRideSeconds,
                                                    .relative_tolerance = kRelative,
                                                    .absolute_tolerance = kAbsolute,
                                                    .traces = trace != nullptr});
    const double seconds = cpu_seconds() - start;
    if (trace) *trace = trace_of(results[0].trace, wheel());
    return seconds / static_cast<double>(vehicles_.size());
  }
  double by_simulate(RideTrace* trace) const {
    const double start = cpu_seconds();
    const dashpot::Trace result = simulate(vehicles_[0].setting, {.duration = kRideSeconds,
                                                                  .relative_tolerance = kRelative,
                                                                  .absolute_tolerance = kAbsolute,
                                                                  .limits = limits_});
    const double seconds = cpu_seconds() - start;
    if (trace) *trace = trace_of(result.record, wheel());
    return seconds;
  }

 private:
  std::string wheel() const {
    return dampers_.size() == 1 ? "wheel" : plant_.struts[0].name + "_wheel";
  }

  dashpot::Plant plant_;
  dashpot::ControlLimits limits_;
  std::vector<dashpot::MountedDamper> dampers_;
  dashpot::ControllerPointer mix1_;
  std::vector<dashpot::GroundPointer> roads_;
  std::vector<dashpot::BatchVehicle> vehicles_;
};

/// run(rides, trace) gives the seconds of one vehicle.
template <class Run>
void add_own_ride(std::map<std::string, Task>& tasks, Ride ride, const std::string& ending,
                  int vehicles, Run run) {
  const std::string name = row_of(ride).task + ending;
  const auto rides = std::make_shared<std::unique_ptr<OwnRides>>();  // made when they are asked for
  const auto made = [rides, ride, vehicles]() -> const OwnRides& {
    if (!*rides) *rides = std::make_unique<OwnRides>(ride, vehicles);
    return **rides;
  };
  tasks[name] = [made, run](int) { return run(made(), nullptr); };
  tasks[name + ".error"] = [made, run, ride](int) {
    RideTrace trace;
    run(made(), &trace);
    return error_of(ride, trace);
  };
}

inline void add_own_rides(std::map<std::string, Task>& tasks, bool in_lanes) {
  const auto lanes = [](const OwnRides& rides, RideTrace* trace) { return rides.in_lanes(trace); };
  const auto alone = [](const OwnRides& rides, RideTrace* trace) {
    return rides.by_simulate(trace);
  };
  for (const RideRow& row : kRides) {
    if (!in_lanes) {  // beside the batches of cars, too, which have no table of one vehicle
      add_own_ride(tasks, row.ride, row.struts > 1 ? "_batch" : "", 1, alone);
      continue;
    }
    add_own_ride(tasks, row.ride, "", 1, lanes);
    add_own_ride(tasks, row.ride, "_batch", 32, lanes);
  }
}

/// What another language needs to ride the same: a line of numbers for the law or the network, one
/// for the road.
inline void print_ride(Ride ride) {
  const auto line = [](const std::vector<double>& numbers) {
    for (const double value : numbers) std::printf("%.17g ", value);
    std::printf("\n");
  };
  const RideEquations equations(ride, 0);
  line(equations.numbers());
  line(equations.heights());
}

}  // namespace peer
