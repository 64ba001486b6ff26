#pragma once
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/law_unknowns.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

/// The noise that a fitted model leaves in the residuals.
struct Noise {
  double rms = 0;                 ///< N
  std::vector<double> variances;  ///< N^2, of one independent residual in each record
  double independent =
      0;  ///< N, standard deviation of one independent residual: many correlated ones make one
};

/// A law fitted to all records: the unknowns at their best. `model` as LawUnknowns has it.
struct LawSolution {
  LawUnknowns unknowns;
  LeastSquaresReport solved;
  Noise noise;
  std::string steadied;     ///< what was kept from falling over the drive, and its cost; or empty
  std::string sides;        ///< what taking rebound and compression apart brought; or empty
  std::string restriction;  ///< what keeps it from feeding energy in, and its cost; or empty
};
LawSolution solve_law(const Law& law, const std::vector<Record>& training, DriveUnit drive_unit,
                      const IdentifyOptions& options, std::string_view model = {});

FitReport::Status status_of(const LeastSquaresReport& solved);

/// Passes the options' threads and monitor on.
LeastSquaresOptions solver_options(const IdentifyOptions& options, int iterations,
                                   double tolerance);

}  // namespace dashpot
