#pragma once
#include <array>
#include <optional>

#include "dashpot/suspension/bound/certificate.h"

namespace dashpot {

/// Mean squares of [q, q'] on a ride: how far this car moves on this road.
using MotionSquares = std::array<double, 4>;

inline constexpr double kUsualRoom = 3e-5;  ///< of the index: less takes more pieces

/// Proposes to a Certificate the function V(t, x) that makes most of a course of limits, less some
/// room, a share of its size, which gives the proof room for curves and rounding: the solution of
/// the Riccati equation, backwards in time by Runge-Kutta in as short pieces as the certificate
/// asks for. `plant`, `car` and `range`: with the range's spring in the plant. `size`: of the index
/// on this road.
///
/// Returns a proven bound on the integral of the index over the ride; nothing where V does not stay
/// finite or something is not proven.
std::optional<double> certified_minimum(const Plant& plant, const SampledPlant& car,
                                        const ForceRange& range, const RideIndex& index,
                                        const LimitCourse& course, const MotionSquares& motion,
                                        double size, double room = kUsualRoom);

}  // namespace dashpot
