#include "odeint_ride.h"
#include "ride_case.h"

using namespace peer;
namespace odeint = boost::numeric::odeint;

namespace {

template <std::size_t kSize>
double run_sized(Ride ride, RideTrace* trace) {
  using State = std::array<double, kSize>;
  RideEquations equations(ride, 0);
  const auto system = [&](const State& y, State& dy, double t) {
    equations.derivative(t, y.data(), dy.data());
  };
  const auto on_sample = [&](const State& y, const State& slope) {
    if (trace) trace->push_back(equations.sample(y.data()));
    return equations.control(y.data(), slope.data());
  };
  return ride_by(odeint::make_controlled(kAbsolute, kRelative, odeint::runge_kutta_dopri5<State>()),
                 system, State{}, kSamples10s, kSample, on_sample);
}

}  // namespace

int main() {
  std::map<std::string, Task> tasks;
  add_ride_tasks(tasks, [](Ride ride, RideTrace* trace) {
    if (row_of(ride).struts > 1)
      return row_of(ride).network ? run_sized<8>(ride, trace) : run_sized<14>(ride, trace);
    return row_of(ride).network ? run_sized<4>(ride, trace) : run_sized<7>(ride, trace);
  });
  return serve(tasks);
}
