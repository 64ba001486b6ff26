#include "dashpot/numerics/riccati.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "dashpot/error.h"

namespace dashpot {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const Matrix> map_of(const std::vector<double>& values, std::size_t rows,
                                std::size_t columns) {
  return {values.data(), static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns)};
}

/// [V1; V2]: eigenvectors of the Hamiltonian's eigenvalues left of the imaginary axis.
Eigen::MatrixXcd stable_subspace(const Eigen::MatrixXd& hamiltonian) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(hamiltonian);
  const Eigen::Index n = hamiltonian.rows() / 2;
  Eigen::MatrixXcd stable(2 * n, n);
  Eigen::Index found = 0;
  for (Eigen::Index k = 0; k < 2 * n; ++k)
    if (solver.eigenvalues()[k].real() < 0 && found < n)
      stable.col(found++) = solver.eigenvectors().col(k);
  if (found < n) throw Error("regulator", "a mode is neither damped nor reached by the input");
  return stable;
}

}  // namespace

std::vector<double> regulator_gain(const RegulatorProblem& p) {
  const auto n = static_cast<Eigen::Index>(p.states);
  const Eigen::MatrixXd b = map_of(p.b, p.states, p.inputs),
                        cross = map_of(p.n, p.states, p.inputs);

  // The weights on the inputs must be positive definite with digits to spare, since they are
  // inverted.
  const Eigen::LLT<Eigen::MatrixXd> r(map_of(p.r, p.inputs, p.inputs));
  const Eigen::VectorXd pivots = Eigen::MatrixXd(r.matrixL()).diagonal();
  if (r.info() != Eigen::Success || pivots.minCoeff() < 1e-7 * pivots.maxCoeff())
    throw Error("regulator", "a combination of inputs costs nothing",
                "a weight on the inputs themselves");

  // Remove the cross term: with v = u + R^-1 N'x the weights are Q - N R^-1 N' and R alone.
  const Eigen::MatrixXd a = map_of(p.a, p.states, p.states) - b * r.solve(cross.transpose());
  const Eigen::MatrixXd q = map_of(p.q, p.states, p.states) - cross * r.solve(cross.transpose());

  // The stabilising solution P maps the upper half of the stable subspace onto the lower: P V1 =
  // V2.
  Eigen::MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << a, -b * r.solve(b.transpose()), -q, -a.transpose();
  const Eigen::MatrixXcd stable = stable_subspace(hamiltonian);
  // Columns of a subspace: P V1 = V2.
  const Eigen::MatrixXd cost =
      stable.topRows(n).transpose().partialPivLu().solve(stable.bottomRows(n).transpose()).real();
  const Matrix gain = r.solve(b.transpose() * cost.transpose() + cross.transpose());
  return {gain.data(), gain.data() + gain.size()};
}

}  // namespace dashpot
