#include <boost/numeric/odeint.hpp>

#include "ride_case.h"

using namespace peer;
namespace odeint = boost::numeric::odeint;

namespace {

/// The stepper lives through all samples; its last slope is the next one's first but where the command
/// changes.
template <std::size_t kSize>
double run_sized(Ride ride, RideTrace* trace) {
  using State = std::array<double, kSize>;
  RideEquations equations(ride, 0);
  const auto system = [&](const State& y, State& dy, double t) {
    equations.derivative(t, y.data(), dy.data());
  };
  auto stepper = odeint::make_controlled(kAbsolute, kRelative, odeint::runge_kutta_dopri5<State>());
  const double start = cpu_seconds();
  State y{}, slope{};
  double dt = kSample;
  system(y, slope, 0);
  for (std::size_t k = 0;; ++k) {
    if (trace) trace->push_back(equations.sample(y.data()));
    if (k == kSamples10s) break;
    double t = static_cast<double>(k) * kSample;
    const double end = static_cast<double>(k + 1) * kSample;
    if (equations.control(y.data(), slope.data())) system(y, slope, t);
    while (t < end) {
      const bool last = t + dt >= end * (1 - 1e-14);
      double h = last ? end - t : dt;
      const bool taken = stepper.try_step(system, y, slope, t, h) == odeint::success;
      if (!taken || !last) dt = h;
      if (taken && last) {
        t = end;
        dt = std::max(dt, h);
      }
    }
  }
  return cpu_seconds() - start;
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
