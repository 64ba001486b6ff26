#pragma once
#include <complex>
#include <span>
#include <string_view>
#include <vector>

#include "dashpot/numerics/filter.h"

namespace dashpot {

/// A frequency weighting of ISO 2631-1: band limits, transition and upward step. Frequencies in Hz;
/// infinity or 0 where a part is missing.
struct Weighting {
  std::string_view name, meaning;
  double f1, f2;          ///< band limits, both of quality 1 / sqrt 2
  double f3, f4, q4;      ///< transition from acceleration to velocity
  double f5, q5, f6, q6;  ///< upward step; f5 = 0: none
};
/// Wb, Wc, Wd, We, Wf, Wj or Wk. Throws Error "unknown weighting 'Wx'; ...".
const Weighting& find_weighting(std::string_view name, const std::string& where = {});

/// H at f Hz.
std::complex<double> weighting_response(const Weighting& weighting, double f);
/// The signal through the filter, from rest. dt s; each part by the bilinear transform, pre-warped
/// at its own frequency. Throws Error where dt is too long for the band: above 1 / (4 f2).
std::vector<double> weigh(const Weighting& weighting, std::span<const double> signal, double dt);

/// That filter as a cascade. Throws Error likewise.
std::vector<Biquad> weighting_filter(const Weighting& weighting, double dt);

/// How an acceleration feels to a rider.
struct RideComfort {
  double rms = 0;           ///< m/s^2, not weighted
  double weighted_rms = 0;  ///< m/s^2, a_w
  double vdv = 0;           ///< m/s^1.75, fourth-power dose
  double mtvv = 0;          ///< m/s^2, greatest running rms over 1 s
  double crest = 0;         ///< greatest weighted magnitude over a_w
  /// "a little uncomfortable": bands that overlap in the standard; recalled.
  std::string_view feeling() const;
};
/// The first `discard` seconds are the filter's own start and do not count.
RideComfort ride_comfort(const Weighting& weighting, std::span<const double> acceleration,
                         double dt, double discard = 5);

}  // namespace dashpot
