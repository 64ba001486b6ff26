#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include "ride_case.h"

using namespace peer;

namespace {

int derivative(double t, N_Vector y, N_Vector dy, void* equations) {
  static_cast<RideEquations*>(equations)->derivative(t, NV_DATA_S(y), NV_DATA_S(dy));
  return 0;
}

/// It starts anew only where the command changes.
double run(Ride ride, RideTrace* trace, double relative = kRelative) {
  sundials::Context context;
  RideEquations equations(ride, 0);
  N_Vector y = N_VNew_Serial(static_cast<sunindextype>(equations.size()), context), slope = N_VClone(y);
  N_VConst(0, y);
  void* solver = ERKStepCreate(derivative, 0, y, context);
  ERKStepSStolerances(solver, relative, relative * 1e-3);
  ERKStepSetUserData(solver, &equations);
  ERKStepSetTableNum(solver, ARKODE_DORMAND_PRINCE_7_4_5);
  ERKStepSetMaxNumSteps(solver, 100000);
  const double start = cpu_seconds();
  double* const values = NV_DATA_S(y);
  for (std::size_t k = 0;; ++k) {
    if (trace) trace->push_back(equations.sample(values));
    if (k == kSamples10s) break;
    double t = static_cast<double>(k) * kSample;
    const double end = static_cast<double>(k + 1) * kSample;
    equations.derivative(t, values, NV_DATA_S(slope));
    if (equations.control(values, NV_DATA_S(slope))) ERKStepReset(solver, t, y);
    ERKStepSetStopTime(solver, end);
    ERKStepEvolve(solver, end, y, &t, ARK_NORMAL);
  }
  const double seconds = cpu_seconds() - start;
  ERKStepFree(&solver);
  N_VDestroy(slope);
  N_VDestroy(y);
  return seconds;
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
