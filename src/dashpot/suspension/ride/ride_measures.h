#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/vehicle.h"

namespace dashpot {

/// One figure of a ride. Less is better in all of them but `current`, which is neither.
struct RideMeasure {
  std::string name;   ///< "body_acceleration"
  std::string title;  ///< "Body acceleration, rms"
  std::string unit;   ///< of the value, as people read it: "mm", "%"
  double value = 0;   ///< NaN where there is none, as the decay ratio without a second peak
};

/// Seconds at the start of a run that do not count: 5 where the ground is alike all along and the
/// run lasts 15 s at least, so that the filters of the weighting have settled; else none.
double usual_discard(const GroundMotion& ground, double duration);

/// What to say of a ride of that many seconds that lasts longer than its road. Empty where it does
/// not.
std::string road_end_note(const GroundMotion& ground, double duration);

/// On tyres: comfort of the first coordinate's motion (ISO 2631-1, Wk), dynamic load and contact of
/// the worst tyre, travel of the worst strut, force and energy of the dampers, current; after a
/// step settling (NaN where the run ends before it), decay and deviation. For a building:
/// displacement, drift and acceleration of each floor.
std::vector<RideMeasure> ride_measures(const Vehicle& vehicle, const GroundMotion& ground,
                                       const Trace& trace, double discard);

/// The one of this name, or NaN.
double measure_named(std::span<const RideMeasure> measures, std::string_view name);

}  // namespace dashpot
