#include <array>

#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

enum Row {
  kMass,
  kPitchInertia,
  kRollInertia,
  kWheel,
  kFrontSpring,
  kRearSpring,
  kFrontDamping,
  kRearDamping,
  kTyre,
  kFrontDistance,
  kRearDistance,
  kFrontTrack,
  kRearTrack,
  kLift
};

/// Unit row of one of the seven coordinates.
std::vector<double> unit(std::size_t k) {
  std::vector<double> row(7);
  row[k] = 1;
  return row;
}

Plant make(std::span<const double> p) {
  const double a = p[kFrontDistance], b = p[kRearDistance], g = kGravity;
  const std::array<double, 4> x{a, a, -b, -b};
  const std::array<double, 4> y{p[kFrontTrack] / 2, -p[kFrontTrack] / 2, p[kRearTrack] / 2,
                                -p[kRearTrack] / 2};
  const std::array names{"front_left", "front_right", "rear_left", "rear_right"};

  // Coordinates: the body's three, then one per wheel.
  Plant plant;
  plant.coordinates = {{"body", "m"}, {"pitch", "rad"}, {"roll", "rad"}};
  for (const char* name : names) plant.coordinates.push_back({std::string(name) + "_wheel", "m"});
  plant.mass = diagonal(
      {p[kMass], p[kPitchInertia], p[kRollInertia], p[kWheel], p[kWheel], p[kWheel], p[kWheel]});
  plant.damping = plant.stiffness = diagonal(std::vector<double>(7));

  // Corner by corner; the static load divides the body's weight by the lever of the other axle.
  for (std::size_t k = 0; k < 4; ++k) {
    const bool front = k < 2;
    const std::vector<double> corner{1, -x[k], y[k], 0, 0, 0, 0};
    add_suspension(plant, {.name = names[k],
                           .body_row = corner,
                           .wheel_row = unit(3 + k),
                           .stiffness = p[front ? kFrontSpring : kRearSpring],
                           .damping = p[front ? kFrontDamping : kRearDamping]});
    plant.tyres.push_back(
        {.name = std::string(names[k]) + "_tyre",
         .row = unit(3 + k),
         .stiffness = p[kTyre],
         .static_load = (0.5 * p[kMass] * (front ? b : a) / (a + b) + p[kWheel]) * g,
         .track = k % 2,
         .behind = front ? 0 : a + b});
    plant.points.push_back({"body_" + std::string(names[k]), corner});
  }

  plant.tyres_may_lift = p[kLift] != 0;
  return plant;
}

}  // namespace

extern const PlantModel kFullCar;
const PlantModel kFullCar{
    .name = "full_car",
    .title = "Full car: body with pitch and roll, four wheels",
    .equation =
        "e_i = z - x_i theta + y_i phi - z_ui,  x = (a, a, -b, -b),  y = (t_f, -t_f, t_r, -t_r) / "
        "2",
    .source = "Ikenaga et al. 2000, recalled",
    .remarks =
        "theta > 0 lowers the front, phi > 0 lifts the left. The source's track of 3 m is not a "
        "car's: 1.5 m stands here. Left wheels meet the road's first track, right ones its second.",
    .parameters = {{"mass", "kg", 1500, 1, 1e6, "of the body"},
                   {"pitch_inertia", "kg*m^2", 2160, 0.1, 1e7, "of the body"},
                   {"roll_inertia", "kg*m^2", 460, 0.1, 1e7, "of the body"},
                   {"wheel_mass", "kg", 59, 0.1, 1e5, "of each wheel"},
                   {"front_stiffness", "N/m", 35000, 0, 1e9, "of each front spring"},
                   {"rear_stiffness", "N/m", 38000, 0, 1e9, "of each rear spring"},
                   {"front_damping", "N*s/m", 0, 0, 1e7, "of linear dampers beside those in place"},
                   {"rear_damping", "N*s/m", 0, 0, 1e7, "of linear dampers beside those in place"},
                   {"tyre_stiffness", "N/m", 190000, 1, 1e10, "of each tyre"},
                   {"front_distance", "m", 1.4, 0.01, 100,
                    "from the centre of mass to the front axle"},
                   {"rear_distance", "m", 1.7, 0.01, 100,
                    "from the centre of mass to the rear axle"},
                   {"front_track", "m", 1.5, 0.01, 100, "between the front wheels"},
                   {"rear_track", "m", 1.5, 0.01, 100, "between the rear wheels"},
                   {"tyres_may_lift", "1", 0, 0, 1, "1: tyres only push", true}},
    .make = make};

}  // namespace dashpot
