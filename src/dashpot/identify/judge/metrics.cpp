#include <algorithm>
#include <cmath>

#include "dashpot/evaluate.h"

namespace dashpot {

void ErrorSums::add(double measured, double modelled) {
  const double e = measured - modelled;
  force_min = n == 0 ? measured : std::min(force_min, measured);
  force_max = n == 0 ? measured : std::max(force_max, measured);
  ++n;
  squared += e * e;
  absolute += std::abs(e);
  largest = std::max(largest, std::abs(e));
  force += measured;
  force_squared += measured * measured;
  error += e;
}

void ErrorSums::add(const ErrorSums& other) {
  if (other.n == 0) return;
  force_min = n == 0 ? other.force_min : std::min(force_min, other.force_min);
  force_max = n == 0 ? other.force_max : std::max(force_max, other.force_max);
  n += other.n;
  squared += other.squared;
  absolute += other.absolute;
  largest = std::max(largest, other.largest);
  force += other.force;
  force_squared += other.force_squared;
  error += other.error;
}

double ErrorSums::force_variation() const {
  return force_squared - force * force / static_cast<double>(n);
}

Metrics metrics(const ErrorSums& sums) {
  Metrics m;
  m.samples = sums.n;
  if (sums.n == 0) return m;
  const double n = static_cast<double>(sums.n);
  const double span = sums.force_max - sums.force_min;
  const double error_variation = sums.squared - sums.error * sums.error / n;

  // Errors in N, and as shares of the force.
  m.rmse = std::sqrt(sums.squared / n);
  m.rms_span = 100 * m.rmse / span;
  m.rms_half_span = 2 * m.rms_span;
  m.nrmse_max = 100 * m.rmse / std::max(std::abs(sums.force_min), std::abs(sums.force_max));

  // Ratios of power.
  m.esr = 100 * sums.squared / sums.force_variation();
  m.r2 = 1 - m.esr / 100;
  m.rrse = std::sqrt(m.esr / 100);
  m.fit = 100 * (1 - m.rrse);
  m.vaf = 100 * (1 - error_variation / sums.force_variation());

  m.mae = sums.absolute / n;
  m.max_error = sums.largest;
  return m;
}

static Value finite_or_null(double value) { return std::isfinite(value) ? Value(value) : Value(); }

Value to_json(const Metrics& m) {
  return Value::object({{"samples", m.samples},
                        {"rmse_N", finite_or_null(m.rmse)},
                        {"rms_half_span_percent", finite_or_null(m.rms_half_span)},
                        {"rms_span_percent", finite_or_null(m.rms_span)},
                        {"nrmse_max_percent", finite_or_null(m.nrmse_max)},
                        {"esr_percent", finite_or_null(m.esr)},
                        {"r2", finite_or_null(m.r2)},
                        {"rrse", finite_or_null(m.rrse)},
                        {"fit_percent", finite_or_null(m.fit)},
                        {"vaf_percent", finite_or_null(m.vaf)},
                        {"mae_N", finite_or_null(m.mae)},
                        {"max_error_N", finite_or_null(m.max_error)}});
}

double dissipated_energy(std::span<const double> time, std::span<const double> velocity,
                         std::span<const double> force) {
  double energy = 0;
  for (std::size_t k = 1; k < time.size(); ++k)
    energy +=
        0.5 * (force[k] * velocity[k] + force[k - 1] * velocity[k - 1]) * (time[k] - time[k - 1]);
  return energy;
}

}  // namespace dashpot
