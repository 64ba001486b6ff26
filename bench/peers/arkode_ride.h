#pragma once
#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "ride_case.h"

namespace peer {

constexpr long kMostSteps = 100000;  // of one sample

template <class Equations>
int arkode_derivative(double t, N_Vector y, N_Vector dy, void* equations) {
  static_cast<Equations*>(equations)->derivative(t, NV_DATA_S(y), NV_DATA_S(dy));
  return 0;
}

/// An explicit method: Dormand and Prince's, or another one that ARKODE has.
template <ARKODE_ERKTableID kMethod = ARKODE_DORMAND_PRINCE_7_4_5>
class ExplicitArkode {
 public:
  template <class Equations>
  ExplicitArkode(Equations& equations, N_Vector y, double relative, double absolute,
                 SUNContext context)
      : solver_(ERKStepCreate(arkode_derivative<Equations>, 0, y, context)) {
    ERKStepSStolerances(solver_, relative, absolute);
    ERKStepSetUserData(solver_, &equations);
    ERKStepSetTableNum(solver_, kMethod);
    ERKStepSetMaxNumSteps(solver_, kMostSteps);
    ERKStepSetErrFile(solver_, nullptr);
  }
  ExplicitArkode(const ExplicitArkode&) = delete;
  ~ExplicitArkode() { ERKStepFree(&solver_); }

  void reset(double t, N_Vector y) { ERKStepReset(solver_, t, y); }
  bool evolve(double& t, double end, N_Vector y) {
    ERKStepSetStopTime(solver_, end);
    return ERKStepEvolve(solver_, end, y, &t, ARK_NORMAL) >= 0;
  }

 private:
  void* solver_;
};

/// An ESDIRK method, its Jacobian by differences and factorised as a dense matrix.
template <ARKODE_DIRKTableID kMethod>
class ImplicitArkode {
 public:
  template <class Equations>
  ImplicitArkode(Equations& equations, N_Vector y, double relative, double absolute,
                 SUNContext context)
      : solver_(ARKStepCreate(nullptr, arkode_derivative<Equations>, 0, y, context)),
        matrix_(SUNDenseMatrix(NV_LENGTH_S(y), NV_LENGTH_S(y), context)),
        factors_(SUNLinSol_Dense(y, matrix_, context)) {
    ARKStepSStolerances(solver_, relative, absolute);
    ARKStepSetUserData(solver_, &equations);
    ARKStepSetTableNum(solver_, kMethod, ARKODE_ERK_NONE);
    ARKStepSetLinearSolver(solver_, factors_, matrix_);
    ARKStepSetMaxNumSteps(solver_, kMostSteps);
    ARKStepSetErrFile(solver_, nullptr);
  }
  ImplicitArkode(const ImplicitArkode&) = delete;
  ~ImplicitArkode() {
    ARKStepFree(&solver_);
    SUNLinSolFree(factors_);
    SUNMatDestroy(matrix_);
  }

  void reset(double t, N_Vector y) { ARKStepReset(solver_, t, y); }
  bool evolve(double& t, double end, N_Vector y) {
    ARKStepSetStopTime(solver_, end);
    return ARKStepEvolve(solver_, end, y, &t, ARK_NORMAL) >= 0;
  }

 private:
  void* solver_;
  SUNMatrix matrix_;
  SUNLinearSolver factors_;
};

/// CPU seconds of a ride from y (n numbers) by one of these. It starts anew only where the command
/// changes. The trace ends where the solver gives up.
template <class Solver, class Equations>
double ride_by_arkode(Equations& equations, const std::vector<double>& from, std::size_t samples,
                      double relative, double absolute, RideTrace* trace) {
  sundials::Context context;
  N_Vector y = N_VNew_Serial(static_cast<sunindextype>(from.size()), context), slope = N_VClone(y);
  double* const values = NV_DATA_S(y);
  std::copy(from.begin(), from.end(), values);
  double seconds = 0;
  {
    Solver solver(equations, y, relative, absolute, context);
    const double start = cpu_seconds();
    for (std::size_t k = 0;; ++k) {
      if (trace) trace->push_back(equations.sample(values));
      if (k == samples) break;
      double t = static_cast<double>(k) * kSample;
      equations.derivative(t, values, NV_DATA_S(slope));
      if (equations.control(values, NV_DATA_S(slope))) solver.reset(t, y);
      if (!solver.evolve(t, static_cast<double>(k + 1) * kSample, y)) break;
    }
    seconds = cpu_seconds() - start;
  }
  N_VDestroy(slope);
  N_VDestroy(y);
  return seconds;
}

}  // namespace peer
