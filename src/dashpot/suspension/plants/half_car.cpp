#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

enum Row {
  kMass,
  kInertia,
  kFrontWheel,
  kRearWheel,
  kFrontSpring,
  kRearSpring,
  kFrontDamping,
  kRearDamping,
  kFrontTyre,
  kRearTyre,
  kFrontDistance,
  kRearDistance,
  kLift
};

Plant make(std::span<const double> p) {
  const double a = p[kFrontDistance], b = p[kRearDistance];

  Plant plant;
  plant.coordinates = {{"body", "m"}, {"pitch", "rad"}, {"front_wheel", "m"}, {"rear_wheel", "m"}};
  plant.mass = diagonal({p[kMass], p[kInertia], p[kFrontWheel], p[kRearWheel]});
  plant.damping = plant.stiffness = diagonal({0, 0, 0, 0});

  // Positive pitch lowers the front: a height there is z - a theta, at the rear z + b theta.
  add_suspension(plant, {.name = "front",
                         .body_row = {1, -a, 0, 0},
                         .wheel_row = {0, 0, 1, 0},
                         .stiffness = p[kFrontSpring],
                         .damping = p[kFrontDamping]});
  add_suspension(plant, {.name = "rear",
                         .body_row = {1, b, 0, 0},
                         .wheel_row = {0, 0, 0, 1},
                         .stiffness = p[kRearSpring],
                         .damping = p[kRearDamping]});

  // Each axle carries the body's weight by the lever of the other.
  plant.tyres = {{.name = "front_tyre",
                  .row = {0, 0, 1, 0},
                  .stiffness = p[kFrontTyre],
                  .static_load = (p[kMass] * b / (a + b) + p[kFrontWheel]) * kGravity},
                 {.name = "rear_tyre",
                  .row = {0, 0, 0, 1},
                  .stiffness = p[kRearTyre],
                  .static_load = (p[kMass] * a / (a + b) + p[kRearWheel]) * kGravity,
                  .behind = a + b}};

  plant.points = {{"body_front", {1, -a, 0, 0}}, {"body_rear", {1, b, 0, 0}}};
  plant.tyres_may_lift = p[kLift] != 0;
  return plant;
}

}  // namespace

extern const PlantModel kHalfCar;
const PlantModel kHalfCar{
    .name = "half_car",
    .title = "Half car: body with pitch, two wheels",
    .equation = "e_f = z - a theta - z_uf,  e_r = z + b theta - z_ur;  forces along e at both",
    .source = "a public half-car model",
    .remarks = "theta > 0 lowers the front. The road reaches the rear wheel a + b later.",
    .parameters =
        {{"mass", "kg", 690, 1, 1e6, "of the body"},
         {"inertia", "kg*m^2", 1222, 0.1, 1e7, "of the body in pitch"},
         {"front_wheel_mass", "kg", 40, 0.1, 1e5, ""},
         {"rear_wheel_mass", "kg", 45, 0.1, 1e5, ""},
         {"front_stiffness", "N/m", 17000, 0, 1e9, "of the front spring"},
         {"rear_stiffness", "N/m", 22000, 0, 1e9, "of the rear spring"},
         {"front_damping", "N*s/m", 0, 0, 1e7, "of a linear damper beside the one in place"},
         {"rear_damping", "N*s/m", 0, 0, 1e7, "of a linear damper beside the one in place"},
         {"front_tyre_stiffness", "N/m", 200000, 1, 1e10, ""},
         {"rear_tyre_stiffness", "N/m", 200000, 1, 1e10, ""},
         {"front_distance", "m", 1.3, 0.01, 100, "from the centre of mass to the front axle"},
         {"rear_distance", "m", 1.5, 0.01, 100, "from the centre of mass to the rear axle"},
         {"tyres_may_lift", "1", 0, 0, 1, "1: tyres only push", true}},
    .make = make};

}  // namespace dashpot
