#pragma once
#include <optional>
#include <vector>

#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/sampled_plant.h"

namespace dashpot {

/// Multipliers of the force limits, 0 or more, constant over `block` cells; block by block, per limit.
struct Multipliers {
  std::size_t block = 1, limits = 1;
  std::vector<double> values;

  double at(std::size_t cell, std::size_t limit) const { return values[cell / block * limits + limit]; }
};

/// The index less the limits, each times its multiplier: min over ALL forces of
///   L(F) = integral of [ price(x, F, t) - sum_j m_j(t) q_j(v, F) ] dt,   x' = A x + B F + w(t), x(0) = 0.
/// L bounds from below what any F within the limits can reach, because m_j >= 0 and q_j >= 0 there. Its
/// minimum is V(0, 0) of V(t, z) = z' P(t) z, z = [x, 1], where P solves the Riccati equation from P(T) = 0:
/// d/dt V + (integrand of L) = R (F - F*(t, z))^2 with R > 0, so L(F) = V(0, 0) + integral of R (F - F*)^2.
/// Nothing here where P does not stay finite or R is not above 0: then L has no minimum.
std::optional<double> certified_minimum(const SampledPlant& car, const std::vector<ForceLimit>& limits,
                                        const RideIndex& index, const Multipliers& multipliers);

/// Multipliers for which that minimum is high.
struct Relaxation {
  Multipliers multipliers;
  double bound = 0;  ///< certified_minimum over the duration: a mean
  /// Per cell the force that is best under the multipliers, over [q, q', 1]: where an optimum may begin.
  std::vector<SmallMatrix<1, 5>> law;
};

struct RelaxationOptions {
  std::size_t block = 10;  ///< cells that share multipliers
  int iterations = 80;     ///< of L-BFGS, at most, per stage
};

Relaxation relax(const SampledPlant& car, const std::vector<ForceLimit>& limits, const RideIndex& index,
                 const RelaxationOptions& options, const Multipliers* start = nullptr);

}  // namespace dashpot
