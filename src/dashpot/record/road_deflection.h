#pragma once
#include <cstdint>

#include "dashpot/record/excitation.h"

namespace dashpot {

/// A rough way as the damper of a car feels it.
struct RoadDeflection {
  double amplitude, speed_max;          ///< m, m/s: scaled down where it would go beyond
  double frequency_min, frequency_max;  ///< Hz
  double roughness;                     ///< m^3: G_d at 0.1 cycle/m
  double vehicle_speed;                 ///< m/s
  double damping;                       ///< N*s/m, of the car's passive damper
  double duration;                      ///< s
};

/// Suspension deflection of the one-sensor paper's quarter-car, with a linear damper, on a road of
/// ISO 8608: a sum of sines whose power is that of the deflection, with random frequencies and
/// phases, faded in over a second. Between knots 64 to the shortest period it is a cubic, so that
/// the velocity is exact for it.
PistonMotion road_deflection(const RoadDeflection& road, std::uint64_t seed);

}  // namespace dashpot
