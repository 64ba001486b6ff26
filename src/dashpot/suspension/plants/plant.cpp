#include "dashpot/plant.h"

#include <algorithm>
#include <array>

#include "dashpot/base/find_row.h"

namespace dashpot {

extern const PlantModel kBuilding, kFullCar, kHalfCar, kQuarterCar, kSeatedDriver;

namespace {

constexpr std::array kPlants{&kBuilding, &kFullCar, &kHalfCar, &kQuarterCar, &kSeatedDriver};

}  // namespace

std::span<const PlantModel* const> plant_models() { return kPlants; }

const PlantModel& find_plant_model(std::string_view name, const std::string& where) {
  return find_row(kPlants, name, "plant", where);
}

Plant make_plant(const PlantModel& model, const NamedValues& values, const std::string& where) {
  const std::vector<double> numbers = with_values(model.parameters, values, model.name, where);
  Plant plant = model.make(numbers);
  plant.name = model.name;
  plant.title = model.title;
  plant.source = model.source;
  return plant;
}

}  // namespace dashpot
