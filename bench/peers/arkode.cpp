#include "arkode_ride.h"

using namespace peer;

namespace {

double run(Ride ride, RideTrace* trace, double relative = kRelative) {
  RideEquations equations(ride, 0);
  return ride_by_arkode<ExplicitArkode<>>(equations, std::vector<double>(equations.size()),
                                        kSamples10s, relative, relative * 1e-3, trace);
}

}  // namespace

int main() {
  std::map<std::string, Task> tasks;
  add_ride_tasks(tasks, [](Ride ride, RideTrace* trace) { return run(ride, trace); });
  for (const Ride ride : {Ride::Network, Ride::BoucWen, Ride::HalfNetwork, Ride::HalfBoucWen})
    tasks[row_of(ride).task + std::string(".reference")] = [ride](int) {
      RideTrace trace;
      const double seconds = run(ride, &trace, 1e-10);
      write_reference(ride, trace);
      return seconds;
    };
  return serve(tasks);
}
