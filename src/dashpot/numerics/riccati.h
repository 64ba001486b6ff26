#pragma once
#include <vector>

namespace dashpot {

/// x' = A x + B u with the price x'Q x + 2 x'N u + u'R u. Matrices row by row.
struct RegulatorProblem {
  std::size_t states = 0, inputs = 0;
  std::vector<double> a;  ///< states x states
  std::vector<double> b;  ///< states x inputs
  std::vector<double> q;  ///< states x states, symmetric
  std::vector<double> n;  ///< states x inputs
  std::vector<double> r;  ///< inputs x inputs, positive definite
};

/// K of u = -K x that costs least (inputs x states), from the stable subspace of the Hamiltonian
/// matrix. Throws Error where there is none: a mode on the imaginary axis that the price does not
/// see or the input not reach.
std::vector<double> regulator_gain(const RegulatorProblem& problem);

}  // namespace dashpot
