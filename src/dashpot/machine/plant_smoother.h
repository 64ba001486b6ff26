#pragma once
#include <span>
#include <vector>

#include "dashpot/suspension/observe/plant_observer.h"

namespace dashpot {

/// The samples of a recording as a filter takes them: per sample the measured inputs with the
/// drives behind them, and what each sensor shows.
struct ObservedSamples {
  std::size_t count = 0, inputs = 0, drives = 1, sensors = 0;
  std::vector<double> driven;    ///< count x (inputs + drives)
  std::vector<double> measured;  ///< count x sensors
  /// Where the plant and its roads are at the first sample, velocities to a tenth; empty: nobody
  /// knows.
  std::vector<double> about = {};

  std::span<const double> driven_at(std::size_t k) const {
    return std::span(driven).subspan(k * (inputs + drives), inputs + drives);
  }
  double drive_at(std::size_t k, std::size_t damper) const {
    return driven_at(k)[inputs + (drives > 1 ? damper : 0)];
  }
  std::span<const double> measured_at(std::size_t k) const {
    return std::span(measured).subspan(k * sensors, sensors);
  }
};

/// Estimates and covariances at every sample, and what the filter was told there.
struct ObservedRun {
  std::vector<double> estimates, covariances;  ///< count x kept, count x all x all
  std::vector<ObservedSample> samples;

  PlantObserver::Known at(std::size_t k, const ObserverTables& t) const {
    return {std::span(estimates).subspan(k * t.kept(), t.kept()),
            std::span(covariances).subspan(k * t.all() * t.all(), t.all() * t.all())};
  }
};

/// The filter from the first sample to the last: each estimate knows the samples up to its own.
ObservedRun filtered(const PlantObserver& observer, const ObservedSamples& samples);

/// Lets every estimate of the run know the samples behind it too, in place; memories then go along
/// the motion that it tells.
/// Source: G. J. Bierman, Factorization Methods for Discrete Sequential Estimation, 1977: the
/// smoother of Bryson and Frazier as he modified it, which inverts no covariance.
void smooth(const PlantObserver& observer, const ObservedSamples& samples, ObservedRun& run);

/// Filters and smooths a smoothed run three times more, with tangents along what it told the time
/// before: that goes to the most likely motion. Ends where it diverges.
/// Source: B. M. Bell, The iterated Kalman smoother as a Gauss-Newton method, SIAM Journal on
/// Optimization 4 (1994) 626-636.
void smooth_again(const PlantObserver& observer, const ObservedSamples& samples, ObservedRun& run);

/// Where the plant and its roads are at the first sample, as the first `count` samples tell when
/// they are all known: what ObservedSamples::about takes. So the filter begins where straight lines
/// through the damper's force are right.
std::vector<double> smoothed_start(const PlantObserver& observer, const ObservedSamples& samples,
                                   std::size_t count);

/// What every sensor showed beyond what the samples before had led to expect, and the variance of
/// that, count x sensors each; a variance of 0: the sensor showed no number. Nothing where the
/// filter diverges.
struct Innovations {
  std::vector<double> beyond, variance;
};
Innovations innovations(const PlantObserver& observer, const ObservedSamples& samples);

/// -2 log of the likelihood of the sensors' samples from `first` on, but for a constant: what the
/// uncertainties that fit best make least. Infinite where the filter diverges.
double misfit(const PlantObserver& observer, const ObservedSamples& samples, std::size_t first,
              std::size_t end);

}  // namespace dashpot
