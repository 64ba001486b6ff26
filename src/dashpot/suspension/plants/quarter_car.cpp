#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

enum Row {
  kSprung,
  kUnsprung,
  kSpring,
  kDamping,
  kTyre,
  kTyreDamping,
  kFriction,
  kExtension,
  kCompression,
  kStop,
  kLift
};

Plant make(std::span<const double> p) {
  Plant plant;
  plant.coordinates = {{"body", "m"}, {"wheel", "m"}};
  plant.mass = diagonal({p[kSprung], p[kUnsprung]});
  plant.damping = plant.stiffness = diagonal({0, 0});

  // The suspension, with all that is not linear in it.
  add_suspension(plant, {.name = "suspension",
                         .body_row = {1, 0},
                         .wheel_row = {0, 1},
                         .stiffness = p[kSpring],
                         .damping = p[kDamping],
                         .friction = p[kFriction],
                         .extension_stop = p[kExtension],
                         .compression_stop = p[kCompression],
                         .stop_stiffness = p[kStop]});

  // The tyre carries both masses at rest.
  plant.tyres = {{.name = "tyre",
                  .row = {0, 1},
                  .stiffness = p[kTyre],
                  .damping = p[kTyreDamping],
                  .static_load = (p[kSprung] + p[kUnsprung]) * kGravity}};
  plant.tyres_may_lift = p[kLift] != 0;
  return plant;
}

}  // namespace

extern const PlantModel kQuarterCar;
const PlantModel kQuarterCar{
    .name = "quarter_car",
    .title = "Quarter car: body and wheel",
    .equation =
        "m_s z_s'' = -k_s (z_s - z_us) - F,\nm_us z_us'' = k_s (z_s - z_us) - k_t (z_us - z_r) + F",
    .source = "the one-sensor paper, equations 3 and 4, table 7",
    .remarks =
        "The paper's tyre pulls as well as it pushes; with tyres_may_lift = 1 it only pushes.",
    .parameters = {{"sprung_mass", "kg", 387, 1, 1e6, "body on this wheel"},
                   {"unsprung_mass", "kg", 139.5, 0.1, 1e5, "wheel and axle"},
                   {"spring_stiffness", "N/m", 37300, 0, 1e9, "of the suspension"},
                   {"suspension_damping", "N*s/m", 0, 0, 1e7,
                    "of a linear damper beside the one in place"},
                   {"tyre_stiffness", "N/m", 295200, 1, 1e10, "of the tyre"},
                   {"tyre_damping", "N*s/m", 0, 0, 1e7, "of the tyre"},
                   {"friction", "N", 0, 0, 1e5, "of the suspension"},
                   {"extension_stop", "m", 0, 0, 10, "travel to the stop; 0: none"},
                   {"compression_stop", "m", 0, 0, 10, "travel to the stop; 0: none"},
                   {"stop_stiffness", "N/m", 1e6, 0, 1e10, "of both stops"},
                   {"tyres_may_lift", "1", 0, 0, 1, "1: the tyre only pushes", true}},
    .make = make};

}  // namespace dashpot
