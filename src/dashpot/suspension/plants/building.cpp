#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

enum Row { kStoreys, kMass, kStiffness, kDamping };

/// Storeys of one kind; the benchmarks with their own matrices are data files.
Plant make(std::span<const double> p) {
  const auto n = static_cast<std::size_t>(p[kStoreys]);
  Plant plant;
  for (std::size_t k = 0; k < n; ++k)
    plant.coordinates.push_back({"floor_" + std::to_string(k + 1), "m"});
  plant.mass = diagonal(std::vector<double>(n, p[kMass]));
  plant.damping = plant.stiffness = diagonal(std::vector<double>(n));

  // Each floor on the one below it, the first on the ground.
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> row(n);
    row[k] = 1;
    if (k > 0) row[k - 1] = -1;
    add_along(plant.stiffness, row, p[kStiffness]);
    add_along(plant.damping, row, p[kDamping]);
  }

  // A damper under the first floor; the ground moves all floors.
  std::vector<double> first(n);
  first[0] = 1;
  plant.struts = {{.name = "ground_to_floor_1", .row = first, .body_row = first, .wheel_row = {}}};
  plant.ground.assign(n, 1);
  return plant;
}

}  // namespace

extern const PlantModel kBuilding;
const PlantModel kBuilding{
    .name = "building",
    .title = "Building: storeys in a row, a damper under the first floor",
    .equation = "M x'' + C x' + K x = -row F - M 1 a_ground,  x relative to the ground",
    .source =
        "Dyke, Spencer, Sain and Carlson, Smart Mater. Struct. 5 (1996) 565, for the arrangement",
    .remarks =
        "All storeys alike. The three-storey benchmark with its own matrices is the set "
        "dyke_spencer1996.",
    .parameters = {{"storeys", "1", 3, 1, 50, "from the ground up", true},
                   {"mass", "kg", 98.3, 0.1, 1e9, "of each floor"},
                   {"stiffness", "N/m", 6.84e5, 1, 1e12, "of each storey"},
                   {"damping", "N*s/m", 50, 0, 1e9, "of each storey"}},
    .make = make};

}  // namespace dashpot
