#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "dashpot/base/value.h"

namespace dashpot {

/// Errors of a modelled force against a measured one. Several records pool by adding sums.
struct ErrorSums {
  std::size_t n = 0;
  double squared = 0, absolute = 0, largest = 0;   ///< of e = measured - modelled
  double force = 0, force_squared = 0, error = 0;  ///< sums of F, F^2, e
  double force_min = 0, force_max = 0;             ///< N
  void add(double measured, double modelled);
  void add(const ErrorSums& other);
};

/// MODELS.md 11; every figure by its name.
struct Metrics {
  std::size_t samples = 0;
  double rmse = 0;           ///< N
  double rms_half_span = 0;  ///< %, 200 rmse / (Fmax - Fmin): what the one-sensor paper prints
  double rms_span = 0;       ///< %, 100 rmse / (Fmax - Fmin)
  double nrmse_max = 0;      ///< %, 100 rmse / max |F|
  double esr = 0;            ///< %, 100 sum e^2 / sum (F - mean F)^2, a power ratio
  double r2 = 0;             ///< 1 - esr
  double rrse = 0;           ///< sqrt(esr)
  double fit = 0;            ///< %, 100 (1 - rrse)
  double vaf = 0;            ///< %, 100 (1 - var e / var F)
  double mae = 0;            ///< N
  double max_error = 0;      ///< N
};
Metrics metrics(const ErrorSums& sums);
Value to_json(const Metrics& metrics);

/// Energy dissipated, J: integral of F v dt by the trapezoidal rule.
double dissipated_energy(std::span<const double> time, std::span<const double> velocity,
                         std::span<const double> force);

}  // namespace dashpot
