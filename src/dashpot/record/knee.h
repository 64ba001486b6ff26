#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "dashpot/numerics/constants.h"

namespace dashpot {

/// A number with its standard error; not a number where it cannot be told.
struct Measured {
  double value = kNoNumber, error = kNoNumber;
  bool is_told() const;
};

/// The course of the force of one direction over speed: a straight line below the knee and another
/// one above it, joined by a hyperbola.
struct KneeFit {
  /// N, size of the force towards which it tends at v -> 0; not a number where the knee lies below
  /// the speeds that could show it.
  Measured at_rest;
  /// N, where the line above the knee meets v = 0, extrapolated: friction and field force
  /// together; at_rest without a knee.
  Measured yield;
  Measured knee;  ///< m/s, where the lines cross; not a number where none is seen
  double slope_below = 0, slope_above = 0;  ///< N*s/m; equal without a knee
  double width = 0;                         ///< m/s, half width of the bend
  double scatter = 0;                       ///< N, rms of the points about it
  std::string why_no_knee = {};             ///< in words; empty where there is one
  bool is_knee_beyond_speeds = false;       ///< there is one, where too few of them show its place
};

/// Fits points of speed (m/s, >= 0) and size of force (N), of equal size. A knee is told where two
/// lines explain the points clearly better than one (F test, 99 %), at least two of distinct speed
/// lie on either side and it is at neither end of these, and the force grows by less than 0.7 times
/// as much above it. With fewer than three points nothing is told. The standard errors take the
/// points to scatter independently.
KneeFit fit_knee(const std::vector<double>& speed, const std::vector<double>& force);

/// The same of points in parts, as those of one cycle of a loop or of one record; ends: behind the
/// last point of each. What the curve leaves is alike within a part, so that the standard errors
/// come from how far the numbers go without one part after the other, or one of ten groups of them
/// (the jackknife). Not known of a single part, nor where the knee comes or goes with one of them.
KneeFit fit_knee_of_parts(const std::vector<double>& speed, const std::vector<double>& force,
                          const std::vector<std::size_t>& ends);

}  // namespace dashpot
