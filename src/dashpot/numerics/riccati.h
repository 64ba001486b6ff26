#pragma once
#include <vector>

namespace dashpot {

/// A linear-quadratic regulator: x' = A x + B u with the cost x'Q x + 2 x'N u + u'R u, integrated
/// over all time. Matrices row by row.
struct RegulatorProblem {
  std::size_t states = 0, inputs = 0;
  std::vector<double> a;  ///< states x states
  std::vector<double> b;  ///< states x inputs
  std::vector<double> q;  ///< states x states, symmetric
  std::vector<double> n;  ///< states x inputs
  std::vector<double> r;  ///< inputs x inputs, positive definite
};

/// The gain K (inputs x states, row by row) of the input u = -K x that costs least, from the stable
/// subspace of the Hamiltonian matrix. Throws Error where there is none: a mode on the imaginary
/// axis that the cost does not see or the input does not reach, or inputs that cost nothing.
std::vector<double> regulator_gain(const RegulatorProblem& problem);

}  // namespace dashpot
