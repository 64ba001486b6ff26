#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// The x >= 0 with the least x'A x / 2 - b'x, by the active sets of Lawson and Hanson (Solving
/// Least Squares Problems, 1974, chapter 23): with A = J'J and b = J'y that of the least |J x - y|.
/// A is symmetric and positive semidefinite, n x n, row by row; n is the size of b. Columns of J
/// that say the same share what they say.
std::vector<double> solve_non_negative(std::span<const double> matrix,
                                       std::span<const double> right);

}  // namespace dashpot
