#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

enum Row { kMass, kStiffness = 4, kDamping = 8 };

Plant make(std::span<const double> p) {
  Plant plant;
  plant.coordinates = {{"thigh", "m"}, {"lower_torso", "m"}, {"chest", "m"}, {"head", "m"}};
  plant.mass = diagonal({p[kMass], p[kMass + 1], p[kMass + 2], p[kMass + 3]});
  plant.damping = plant.stiffness = diagonal(std::vector<double>(4));

  // Each part on the one below it.
  for (std::size_t k = 1; k < 4; ++k) {
    std::vector<double> row(4);
    row[k] = 1;
    row[k - 1] = -1;
    add_along(plant.stiffness, row, p[kStiffness + k]);
    add_along(plant.damping, row, p[kDamping + k]);
  }

  // The seat is the foot of the lowest part: what a tyre is to a car.
  const double weight = (p[kMass] + p[kMass + 1] + p[kMass + 2] + p[kMass + 3]) * kGravity;
  plant.tyres = {{.name = "seat",
                  .row = {1, 0, 0, 0},
                  .stiffness = p[kStiffness],
                  .damping = p[kDamping],
                  .static_load = weight}};

  plant.points = {{"head", {0, 0, 0, 1}}};
  plant.struts = {
      {.name = "seat", .row = {1, 0, 0, 0}, .body_row = {1, 0, 0, 0}, .wheel_row = {}, .track = 0}};
  return plant;
}

}  // namespace

extern const PlantModel kSeatedDriver;
const PlantModel kSeatedDriver{
    .name = "seated_driver",
    .title = "Seated driver: thigh, lower torso, chest and head on a seat that moves",
    .equation =
        "seat -- k1, c1 -- thigh -- k2, c2 -- lower torso -- k3, c3 -- chest -- k4, c4 -- head",
    .source = "Boileau and Rakheja 1998, recalled",
    .remarks = "The ground's height is that of the seat's base.",
    .parameters = {{"thigh_mass", "kg", 12.78, 0.1, 1000, ""},
                   {"lower_torso_mass", "kg", 8.62, 0.1, 1000, ""},
                   {"chest_mass", "kg", 28.49, 0.1, 1000, ""},
                   {"head_mass", "kg", 5.31, 0.1, 1000, ""},
                   {"k1", "N/m", 90e3, 1, 1e9, "seat to thigh"},
                   {"k2", "N/m", 162.8e3, 1, 1e9, "thigh to lower torso"},
                   {"k3", "N/m", 183e3, 1, 1e9, "lower torso to chest"},
                   {"k4", "N/m", 310e3, 1, 1e9, "chest to head"},
                   {"c1", "N*s/m", 2064, 0, 1e6, "seat to thigh"},
                   {"c2", "N*s/m", 4585, 0, 1e6, "thigh to lower torso"},
                   {"c3", "N*s/m", 4750, 0, 1e6, "lower torso to chest"},
                   {"c4", "N*s/m", 400, 0, 1e6, "chest to head"}},
    .make = make};

}  // namespace dashpot
