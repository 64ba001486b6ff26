#include "dashpot/suspension/plant.h"

#include <algorithm>
#include <array>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {

extern const PlantModel kBuilding, kFullCar, kHalfCar, kQuarterCar, kSeatedDriver;

namespace {

constexpr std::array kPlants{&kBuilding, &kFullCar, &kHalfCar, &kQuarterCar, &kSeatedDriver};

std::size_t index_of(const PlantModel& model, const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (const PlantParameter& parameter : model.parameters) {
    if (parameter.name == name) return known.size();
    known.emplace_back(parameter.name);
  }
  throw Error(where, "unknown parameter '" + name + "' of " + std::string(model.name), suggest(name, known));
}

}  // namespace

std::span<const PlantModel* const> plant_models() { return kPlants; }

const PlantModel& find_plant_model(std::string_view name, const std::string& where) {
  std::vector<std::string> known;
  for (const PlantModel* model : kPlants) {
    if (model->name == name) return *model;
    known.emplace_back(model->name);
  }
  throw Error(where, "unknown plant '" + std::string(name) + "'", suggest(name, known));
}

Plant make_plant(const PlantModel& model, const NamedValues& values, const std::string& where) {
  std::vector<double> numbers;
  for (const PlantParameter& parameter : model.parameters) numbers.push_back(parameter.value);
  for (const auto& [name, value] : values) {
    const std::size_t index = index_of(model, name, where);
    const PlantParameter& p = model.parameters[index];
    const std::string unit = p.unit == "1" ? "" : " " + std::string(p.unit);
    if (!(value >= p.lower && value <= p.upper))
      throw Error(where, name + " is " + format_number(value) + unit,
                  format_number(p.lower) + " ... " + format_number(p.upper) + unit);
    numbers[index] = value;
  }
  Plant plant = model.make(numbers);
  plant.name = model.name;
  plant.title = model.title;
  plant.source = model.source;
  return plant;
}

}  // namespace dashpot
