#pragma once
#include <span>
#include <vector>

#include "dashpot/suspension/plants/linear.h"

namespace dashpot {

/// Exact step of M q'' + C q' + K q = g(t) for a force g that is a parabola through its values at
/// the start, the middle and the end of the step. x = [q, q'].
class Propagator {
 public:
  /// step: s, above 0.
  Propagator(const LinearPlant& plant, double step);

  double step() const noexcept { return step_; }
  /// x at the middle and at the end; g N, one per coordinate. Allocates nothing.
  void middle(std::span<const double> x, const double* const g[3],
              std::span<double> out) const noexcept {
    apply(middle_, x, g, out);
  }
  void end(std::span<const double> x, const double* const g[3],
           std::span<double> out) const noexcept {
    apply(end_, x, g, out);
  }

 private:
  /// Row by row: by x, then by g at the start, the middle and the end.
  using Rows = std::vector<double>;
  void apply(const Rows& rows, std::span<const double> x, const double* const g[3],
             std::span<double> out) const noexcept;

  std::size_t size_;
  double step_;
  Rows middle_, end_;
};

}  // namespace dashpot
