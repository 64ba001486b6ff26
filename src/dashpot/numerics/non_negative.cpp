#include "dashpot/numerics/non_negative.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// A x = b among the unknowns `free`, the others 0. A little more on the diagonal keeps
/// columns that say the same apart.
std::vector<double> least_among(std::span<const double> a, std::span<const double> b,
                                const std::vector<std::size_t>& free) {
  constexpr double kApart = 1e-10;
  std::vector<double> part, right, x(free.size());
  for (const std::size_t i : free) {
    for (const std::size_t k : free) part.push_back(a[i * b.size() + k] + (i == k ? kApart : 0));
    right.push_back(b[i]);
  }
  solve_positive_definite(part, right, x);
  return x;
}

/// The unknown that is 0 and with which the most is to be won; b.size() where nothing is.
std::size_t steepest_of(std::span<const double> a, std::span<const double> b,
                        const std::vector<double>& x, const std::vector<std::size_t>& free) {
  constexpr double kNothing = 1e-9;  // of the steepest slope at 0
  double steepest = 0;
  for (const double slope : b) steepest = std::max(steepest, kNothing * std::abs(slope));

  const std::vector<double> there = product(a, x, x.size());
  std::size_t found = b.size();
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (std::ranges::find(free, k) != free.end() || b[k] - there[k] <= steepest) continue;
    steepest = b[k] - there[k];
    found = k;
  }
  return found;
}

}  // namespace

std::vector<double> solve_non_negative(std::span<const double> matrix,
                                       std::span<const double> right) {
  const std::size_t n = right.size();
  assert(matrix.size() == n * n);

  // Each unknown in the size at which the diagonal is 1.
  std::vector<double> scale(n), a(n * n), b(n), x(n);
  for (std::size_t k = 0; k < n; ++k)
    scale[k] = matrix[k * n + k] > 0 ? 1 / std::sqrt(matrix[k * n + k]) : 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) a[i * n + k] = scale[i] * scale[k] * matrix[i * n + k];
    b[i] = scale[i] * right[i];
  }

  // Free one unknown after the other, in so many rounds at most: by rounding one may come and go.
  std::vector<std::size_t> free;
  for (std::size_t round = 0; round < 10 * n; ++round) {
    const std::size_t next = steepest_of(a, b, x, free);
    if (next == n) break;
    free.push_back(next);

    // Go to the least among the free ones, by way of where the first of them meets 0 and stays.
    for (double way = 0; way < 1;) {
      const std::vector<double> least = least_among(a, b, free);
      way = 1;
      for (std::size_t k = 0; k < free.size(); ++k)
        if (least[k] < 0) way = std::min(way, x[free[k]] / (x[free[k]] - least[k]));

      std::vector<std::size_t> still;
      for (std::size_t k = 0; k < free.size(); ++k) {
        double& value = x[free[k]];
        const bool meets = least[k] < 0 && value <= way * (value - least[k]);
        value = meets ? 0 : value + way * (least[k] - value);
        if (!meets) still.push_back(free[k]);
      }
      free = std::move(still);
    }
  }

  for (std::size_t k = 0; k < n; ++k) x[k] *= scale[k];
  return x;
}

}  // namespace dashpot
