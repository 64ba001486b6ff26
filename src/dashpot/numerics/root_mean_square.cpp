#include "dashpot/numerics/root_mean_square.h"

#include <cmath>

namespace dashpot {

double root_mean_square(std::span<const double> x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return x.empty() ? 0 : std::sqrt(sum / static_cast<double>(x.size()));
}

}  // namespace dashpot
