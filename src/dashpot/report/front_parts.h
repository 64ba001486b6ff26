#pragma once
#include <string>
#include <vector>

#include "dashpot/report/document.h"
#include "dashpot/suspension/bound/bound.h"

// The parts of a page about the limits on a road: a front of comfort against road holding.
namespace dashpot {

/// Root mean squares: body acceleration m/s^2, tyre force N.
struct RideRoots {
  double acceleration = 1, tyre_force = 1;
};

/// The proven bound and the optimum that was reached, over these units.
std::vector<FigureSeries> front_lines(const std::vector<ClairvoyantBound>& front,
                                      const RideRoots& unit);

/// Root of an index: as root mean squares are compared.
double root_of(const RideIndex& index, const RideSquares& squares);
/// "64": how much of what is possible beyond passive a controller reaches, %, of roots of the
/// index; below 0 where it is worse than passive; "-" where next to nothing is possible.
std::string possible_text(const ClairvoyantBound& best, const RideSquares& passive,
                          const RideSquares& controller);

/// "1203": newtons and percents, which need no digits behind the point.
std::string whole_text(double value);

Value squares_json(const RideSquares& squares);
Value front_json(const std::vector<ClairvoyantBound>& front);

}  // namespace dashpot
