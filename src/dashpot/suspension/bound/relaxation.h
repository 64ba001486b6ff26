#pragma once
#include "dashpot/suspension/bound/certificate.h"

namespace dashpot {

/// From which sectors any limits are sought, where the range of forces ends: those that stay all
/// the time, or those that a climb over short blocks has made of them. Which arrives at more cannot
/// be told beforehand.
enum class RelaxationStart { Staying, Short };

/// The index less a course of limits has a minimum over ALL forces,
///   L(F) = integral of [ cost(x, F, t) - q(t; v, F) ] dt,   x' = A x + B F + w(t),   x(0) = 0,
/// which is not above what any F within the limits can reach, because q >= 0 there. The minimum is
/// concave in the coefficients of q: climbing it is what this file does. What the result is worth
/// certified_minimum() says.
struct RelaxationOptions {
  RelaxationStart start = RelaxationStart::Staying;
  std::size_t block = 1;  ///< cells that share a limit in the end
  int iterations = 100;   ///< of L-BFGS, at most, per climb
  double size = 1;        ///< of the index on this road
};

/// Courses of limits on a car whose forces are held over a cell, each with a higher minimum than
/// the one before, and nearer to the edge where there is none; and one of limits that stay. All
/// without the constants, which certified_minimum() finds.
struct Relaxation {
  std::vector<LimitCourse> path;
  LimitCourse constant;
};
Relaxation relax(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                 const RelaxationOptions& options);

/// The same limits over the cells of another sampling of the ride, where `ratio` of its cells make
/// one of before.
LimitCourse on_cells(const LimitCourse& course, std::size_t cells, double ratio);

/// Makes limits smaller, as any positive factor may, whose curvature or constant is above so many
/// times the middle one: a climb drives them up where they matter to nothing, as on a car that
/// stands.
void tame(LimitCourse& course, double factor);

/// share of a, the rest of b; block by block, b having one block only.
LimitCourse mixed(const LimitCourse& a, const LimitCourse& b, double share_of_b, double size_of_b);

}  // namespace dashpot
