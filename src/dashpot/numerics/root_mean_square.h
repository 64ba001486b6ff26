#pragma once
#include <span>

namespace dashpot {

/// 0 of nothing.
double root_mean_square(std::span<const double> x);

}  // namespace dashpot
