#include "dashpot/machine/more_unknowns.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "dashpot/base/parallel.h"
#include "dashpot/machine/damper_unknowns.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/sensor_unknowns.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {

InPlantSetup with_delays_unknown(InPlantSetup setup) {
  for (PlantSensor& sensor : setup.sensors)
    sensor.finds_delay |= sensor.delay == 0 && !sensor.finds_cutoff;
  return setup;
}

InPlantSetup with_filters_for_delays(InPlantSetup setup, const std::vector<std::size_t>& sensors,
                                     const std::vector<FittedParameter>& nuisances) {
  for (const std::size_t s : sensors) {
    PlantSensor& sensor = setup.sensors[s];
    sensor.filter = as_late_as(lags_found(nuisances, sensor.channel).delay->value);
    sensor.finds_cutoff = CutoffRange{};
    sensor.finds_delay = false;
    sensor.delay = 0;
  }
  return setup;
}

namespace {

/// Residuals at the end of a fit, and what each unknown changes of them.
struct Linear {
  using Columns = std::vector<std::vector<double>>;
  std::vector<double> residuals;
  Columns columns;
};

/// With the columns of the unknowns from `first` on alone; nothing where the plant diverges.
std::optional<Linear> linear_at(const LeastSquaresProblem& problem, const std::vector<double>& x,
                                std::size_t first = 0) {
  Linear at{.residuals = std::vector<double>(problem.residuals), .columns = {}};
  at.columns.assign(x.size() - first, at.residuals);
  std::vector<double*> places(first, nullptr);
  for (std::vector<double>& column : at.columns) places.push_back(column.data());
  if (!problem.jacobian(x, at.residuals, places)) return {};
  return at;
}

/// What `more` beside the unknowns of a fit would do, to first order.
struct GainByMore {
  double share = 0;                ///< of the misfit that would go
  std::vector<double> steps = {};  ///< along each of `more`
};
GainByMore gain_by(const Linear& fit, const Linear::Columns& more, int threads) {
  const auto along = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  const auto column = [&](std::size_t k) -> const std::vector<double>& {
    return k < fit.columns.size() ? fit.columns[k] : more[k - fit.columns.size()];
  };

  // What the best step would take off, with so many of the columns, and that step.
  std::vector<double> best;
  const auto gain_of = [&](std::size_t n) {
    std::vector<double> matrix(n * n), slope(n), size(n);
    parallel_for(n, threads, [&](std::size_t i) {
      slope[i] = along(column(i), fit.residuals);
      for (std::size_t k = 0; k < n; ++k) matrix[i * n + k] = along(column(i), column(k));
    });
    constexpr double kTrace = 1e-9;
    for (std::size_t i = 0; i < n; ++i) size[i] = std::sqrt(std::max(matrix[i * (n + 1)], 1e-300));
    for (std::size_t i = 0; i < n; ++i) {
      slope[i] /= size[i];
      for (std::size_t k = 0; k < n; ++k) matrix[i * n + k] /= size[i] * size[k];
      matrix[i * (n + 1)] += kTrace;
    }
    best = solve(matrix, slope);
    const double gain = along(slope, best);
    for (std::size_t i = 0; i < n; ++i) best[i] /= -size[i];
    return gain;
  };
  const std::size_t own = fit.columns.size();
  const double before = gain_of(own), gain = gain_of(own + more.size()) - before;
  return {gain / along(fit.residuals, fit.residuals),
          {best.begin() + static_cast<std::ptrdiff_t>(own), best.end()}};
}

/// The setup of a fit that has ended with the weights of its sensors as their noise.
InPlantSetup weighed(const EndedFit& fit) {
  InPlantSetup setup = fit.setup;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    setup.sensors[s].noise = fit.residuals.scale_of(s);
  return setup;
}

/// What the delays would change that the plant does not state; nothing where it asks for some, or
/// states all.
Linear::Columns columns_of_delays(const EndedFit& fit, const std::vector<double>& residuals,
                                  int threads) {
  constexpr double kLater = 1e-4;  // s
  const InPlantSetup beside = with_delays_unknown(fit.setup);
  const auto asks = [](const PlantSensor& sensor) { return sensor.finds_delay; };
  Linear::Columns columns;
  if (std::ranges::any_of(fit.setup.sensors, asks)) return columns;
  for (std::size_t s = 0; s < beside.sensors.size(); ++s) {
    if (!asks(beside.sensors[s])) continue;
    InPlantSetup late = weighed(fit);
    late.sensors[s].delay = kLater;
    const PlantResiduals shifted(late, fit.cases, fit.law, fit.plant_start, fit.scale);
    columns.push_back(residuals);
    if (!shifted.problem(0, threads).residual(fit.solved.x, columns.back())) return {};
    for (std::size_t i = 0; i < residuals.size(); ++i) columns.back()[i] -= residuals[i];
  }
  return columns;
}

/// Sensors whose delay was found, where the residuals ask for what a filter as late would change
/// rather than for the delay.
std::vector<std::size_t> sensors_as_if_filtered(const EndedFit& fit, const Linear& at,
                                                int threads) {
  constexpr double kLateEnough = 0.5;  // samples
  constexpr double kGain = 0.15, kRather = 0.5;
  std::vector<std::size_t> sensors;
  Linear::Columns columns;
  for (std::size_t k = fit.residuals.first_of_sensors(); k < fit.solved.x.size(); ++k) {
    const SensorUnknown& one = *fit.residuals.of_sensor(k);
    const double delay = fit.residuals.described(k, fit.solved.x).value;
    if (one.of != SensorUnknown::Of::Delay || fit.setup.sensors[one.sensor].filter.cutoff > 0 ||
        fit.setup.sensors[one.sensor].finds_cutoff ||
        delay < kLateEnough * fit.cases.all.front().driving.sample_time)
      continue;

    // How the residuals change on the way from the delay to a filter as late.
    InPlantSetup filtered = weighed(fit);
    filtered.sensors[one.sensor].filter = as_late_as(delay);
    std::vector<double> x = fit.solved.x;
    x[k] = 0;
    const PlantResiduals other(filtered, fit.cases, fit.law, fit.plant_start, fit.scale);
    columns.push_back(at.residuals);
    if (!other.problem(0, threads).residual(x, columns.back())) return {};
    for (std::size_t i = 0; i < at.residuals.size(); ++i) columns.back()[i] -= at.residuals[i];
    sensors.push_back(one.sensor);
  }
  if (sensors.empty()) return {};

  // All the way from the delay to the filter is a step of 1.
  const GainByMore gain = gain_by(at, columns, threads);
  std::vector<std::size_t> filtered;
  for (std::size_t k = 0; k < sensors.size(); ++k)
    if (gain.share > kGain && gain.steps[k] > kRather) filtered.push_back(sensors[k]);
  return filtered;
}

/// What the law's numbers would change if they were not the same in all dampers: those of all
/// kinds but the first.
Linear::Columns columns_of_kinds(const EndedFit& fit, const InPlantSetup& unlike, int threads) {
  InPlantSetup setup = weighed(fit);
  setup.kinds = unlike.kinds;
  const DamperUnknowns law = fit.law.in_kinds(setup.kinds);
  PlantCases cases = fit.cases;
  for (PlantCase& one : cases.all) one.levels.assign(law.kinds(), one.levels.front());
  const PlantResiduals residuals(setup, cases, law, fit.plant_start, fit.scale);

  // Where all are what they are at the end of the fit.
  const std::vector<double>& end = fit.solved.x;
  const std::size_t first = fit.setup.unknown.size(), behind = first + fit.law.size();
  std::vector<double> x(end.begin(), end.begin() + static_cast<std::ptrdiff_t>(first));
  std::ranges::copy(law.alike({end.begin() + static_cast<std::ptrdiff_t>(first),
                               end.begin() + static_cast<std::ptrdiff_t>(behind)}),
                    std::back_inserter(x));
  x.insert(x.end(), end.begin() + static_cast<std::ptrdiff_t>(behind), end.end());
  std::optional<Linear> at = linear_at(residuals.problem(0, threads), x, behind);
  if (!at) return {};
  at->columns.resize(law.size() - fit.law.size());
  return std::move(at->columns);
}

}  // namespace

FitDoubts doubts_of(const EndedFit& fit, const LeastSquaresProblem& whole, int threads) {
  constexpr double kLate = 0.1, kUnlike = 0.05;
  const std::optional<Linear> at = linear_at(whole, fit.solved.x);
  if (!at) return {};
  FitDoubts doubts;
  doubts.is_late =
      gain_by(*at, columns_of_delays(fit, at->residuals, threads), threads).share > kLate;
  doubts.as_if_filtered = sensors_as_if_filtered(fit, *at, threads);
  if (const std::optional<InPlantSetup> unlike = with_unlike_dampers(fit.setup))
    doubts.are_unlike =
        gain_by(*at, columns_of_kinds(fit, *unlike, threads), threads).share > kUnlike;
  return doubts;
}

}  // namespace dashpot
