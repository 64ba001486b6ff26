#include "dashpot/numerics/latin_hypercube.h"

#include <utility>

#include "dashpot/base/random.h"

namespace dashpot {

std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t dimensions,
                                                 std::uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<double>> drawn(points, std::vector<double>(dimensions));
  std::vector<std::size_t> order(points);

  // The parts of a dimension in an order of its own, and a place within each.
  for (std::size_t d = 0; d < dimensions; ++d) {
    for (std::size_t k = 0; k < points; ++k) order[k] = k;
    for (std::size_t k = points; k > 1; --k) std::swap(order[k - 1], order[random.index(k)]);
    for (std::size_t k = 0; k < points; ++k)
      drawn[k][d] =
          (static_cast<double>(order[k]) + random.uniform()) / static_cast<double>(points);
  }
  return drawn;
}

}  // namespace dashpot
