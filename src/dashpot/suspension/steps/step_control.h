#pragma once
#include <algorithm>
#include <cmath>
#include <span>

#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// How much longer the next step may be after one of this error, in tolerances: 0.9 error^-power
/// within 0.2 ... 5; power: 1 / order of the error in the step's length.
inline double step_factor(double error, double power) {
  if (error < 1e-4 && power >= 0.2) return 5;  // as most errors are: no need for the power
  return std::isfinite(error) ? std::clamp(0.9 * std::pow(error, -power), 0.2, 5.0) : 0.2;
}

/// Whether a step of length `other` is surely longer than one of length h times step_factor(error,
/// 1/5), told without the power: 0.9^5 = 0.59049.
inline bool is_longer(double other, double h, double error) {
  const double ratio = other / h, square = ratio * ratio;
  return ratio > 0.2 && error * (square * square * ratio) > 0.5905;
}

/// The shortest step within a stretch. Where it misses the tolerance it doubles, to 1/64 of the
/// stretch at most: a force that jumps costs an error, which is counted, and not hours.
class Allowance {
 public:
  explicit Allowance(double stretch) : shortest_(stretch / 4096), longest_(stretch / 64) {}
  double shortest() const { return shortest_; }
  /// The last step of a stretch is what is left of it, which rounding may make a little longer.
  bool is_shortest(double step) const { return step <= (1 + 1e-8) * shortest_; }
  void miss() { shortest_ = std::min(2 * shortest_, longest_); }

 private:
  double shortest_, longest_;
};

/// y = [q, q', states of the dampers] at both ends of a step.
struct StepEnds {
  std::size_t coordinates;
  std::span<const double> from, to;
  double size(std::size_t k) const { return std::max(std::abs(from[k]), std::abs(to[k])); }
};

/// The error of a step, in tolerances; error(k): of component k; size_of(k): what that of a
/// damper's state is measured against. Displacements are measured against the greatest of them, and
/// so are speeds.
template <class Error, class Size>
double error_in_tolerances(const StepEnds& ends, const IntegratorOptions& options, Error error,
                           Size size_of) {
  // Which error is the greatest is chance, so no branch hangs on it; one that is not a number shows
  // in their sum.
  double sum = 0;
  const auto worse = [&](double a, double b) {
    sum += b;
    return b > a ? b : a;
  };
  const auto of = [&](double off, double size) {
    return off / (options.absolute_tolerance + options.relative_tolerance * size);
  };

  // Displacements, then speeds.
  const std::size_t n = ends.coordinates;
  double greatest = 0;
  for (std::size_t part = 0; part < 2; ++part) {
    double size = 0, off = 0;
    for (std::size_t k = part * n; k < (part + 1) * n; ++k) {
      size = std::max({size, std::abs(ends.from[k]), std::abs(ends.to[k])});
      off = worse(off, error(k));
    }
    greatest = worse(greatest, of(off, size));
  }

  // States of the dampers.
  for (std::size_t k = 2 * n; k < ends.from.size(); ++k)
    greatest = worse(greatest, of(error(k), size_of(k)));
  return std::isnan(sum) ? sum : greatest;
}

}  // namespace dashpot
