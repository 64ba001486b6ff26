#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/plant_of_matrices.h"

namespace dashpot {
namespace {

enum OscillatorRow { kOscillatorMass, kOscillatorDamping, kOscillatorStiffness };

Plant make_oscillator(std::span<const double> p) {
  Plant plant;
  plant.coordinates = {{"mass", "m"}};
  plant.mass = {p[kOscillatorMass]};
  plant.damping = plant.stiffness = {0};

  // Spring, dashpot and damper all stand on the ground, which may move.
  plant.tyres = {{.name = "support",
                  .row = {1},
                  .stiffness = p[kOscillatorStiffness],
                  .damping = p[kOscillatorDamping],
                  .static_load = p[kOscillatorMass] * kGravity}};
  plant.struts = {
      {.name = "damper", .row = {1}, .body_row = {1}, .wheel_row = {}, .track = std::size_t{0}}};
  return plant;
}

const PlantModel kOscillator{
    .name = "oscillator",
    .title = "Oscillator: a mass on a spring and a dashpot, beside the damper",
    .equation = "m q'' + c (q' - w') + k (q - w) = u - F",
    .source = "mechanics",
    .remarks = "u a force on the mass, w the motion of the ground; either may be absent.",
    .parameters = {{"mass", "kg", 1, 1e-6, 1e9, "that moves"},
                   {"damping", "N*s/m", 0, 0, 1e9, "of the dashpot"},
                   {"stiffness", "N/m", 0, 0, 1e12, "of the spring"}},
    .make = make_oscillator};

}  // namespace

std::vector<std::string> machine_names() {
  std::vector<std::string> names = {std::string(kOfMatrices), std::string(kOscillator.name)};
  for (const PlantModel* model : plant_models()) names.emplace_back(model->name);
  return names;
}

const PlantModel& find_machine(const std::string& name, const std::string& where) {
  if (name == kOscillator.name) return kOscillator;
  if (name == kOfMatrices)
    throw Error(where, "a plant of matrices does not fit on a line",
                "a file with 'plant: matrices' (docs/in-plant.md)");
  for (const PlantModel* model : plant_models())
    if (model->name == name) return *model;
  throw Error(where, "unknown plant '" + name + "'", suggest(name, machine_names()));
}

}  // namespace dashpot
