#pragma once
#include <optional>
#include <vector>

#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/sampled_plant.h"

namespace dashpot {

/// Multipliers of the force limits, 0 or more, constant over `block` cells; block by block, per
/// limit.
struct Multipliers {
  std::size_t block = 1, limits = 1;
  std::vector<double> values;

  /// The multipliers of a cell, one per limit.
  const double* in(std::size_t cell) const { return values.data() + cell / block * limits; }
};

/// The index less the limits, each times its multiplier: min over ALL forces of
///   L(F) = integral of [ cost(x, F, t) - sum_j m_j(t) q_j(v, F) ] dt,   x' = A x + B F + w(t),
///   x(0) = 0.
/// L bounds from below what any F within the limits can reach, because m_j >= 0 and q_j >= 0 there.
/// Its minimum is V(0, 0) of V(t, z) = z' P(t) z, z = [x, 1], where P solves the Riccati equation
/// from P(T) = 0: d/dt V + (integrand of L) = R (F - F*(t, z))^2 with R > 0, so L(F) = V(0, 0) +
/// integral of R (F - F*)^2. Nothing here where P does not stay finite or R is not above 0: then L
/// has no minimum.
std::optional<double> certified_minimum(const SampledPlant& car,
                                        const std::vector<ForceLimit>& limits,
                                        const RideIndex& index, const Multipliers& multipliers);

struct RelaxationOptions {
  std::size_t block = 2;  ///< coarse cells that share multipliers in the end
  int iterations = 40;    ///< of L-BFGS, at most, per climb
};

/// Multipliers for which that minimum is high, and the minimum as a mean over time.
struct Relaxation {
  Multipliers multipliers;  ///< over the cells of `car`
  double bound = 0;
};
/// Multipliers are sought on the cells of `coarse`, where a force is held over a cell, from one for
/// all of the time to shorter and shorter blocks; what they are worth is certified on `car`, the
/// same road in finer cells, for forces that change as they like.
Relaxation relax(const SampledPlant& car, const SampledPlant& coarse,
                 const std::vector<ForceLimit>& limits, const RideIndex& index,
                 const RelaxationOptions& options);

}  // namespace dashpot
