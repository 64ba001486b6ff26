#include "start_model.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/error.h"
#include "dashpot/model_file.h"

namespace dashpot::studio {
namespace {

/// The place of a coefficient, by the name that sliders have; throws Error where there is none.
double& coefficient_of(Dependence& parameters, const LawModel& law, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < parameters.coefficients.size(); ++k)
    for (std::size_t index = 0; index < parameters.coefficients[k].size(); ++index) {
      known.push_back(coefficient_name(law.law().params[k].name, parameters.forms[k], index));
      if (known.back() == name) return parameters.coefficients[k][index];
    }
  throw Error("'" + name + "'", "is no parameter of " + law.name(), suggest(name, known));
}

}  // namespace

std::string start_model(const Project& project, const Value& from, const std::string& law_name) {
  ObjectReader reader(from, "a start");
  const std::string path = reader.string("model");
  const Value& moved = reader.required("parameters");
  reader.finish();

  ModelFile file = load_model(project.inside(path));
  const auto* law = model_as<LawModel>(*file.model);
  if (!law || law->name() != law_name)
    throw Error(path, "is a " + file.model->name(), "a model file of " + law_name);

  // The numbers as they were moved, each finite; the lag is a number of the coil.
  constexpr std::string_view kLag = "lag_rate";
  Dependence parameters = law->parameters();
  double lag_rate = law->lag_rate();
  for (const auto& [name, value] : moved.members()) {
    const double number = value.as_number();
    if (!std::isfinite(number)) throw Error("'" + name + "'", "is not finite");
    (name == kLag ? lag_rate : coefficient_of(parameters, *law, name)) = number;
  }

  // What was judged and measured was the other law; reading it refuses what its table does.
  file.model = std::make_unique<LawModel>(law->law(), parameters, law->drive_unit(), lag_rate);
  file.quality = {};
  file.interval.reset();
  file.dissipation.reset();
  std::string text = format_model(file);
  parse_model(text, path);
  return text;
}

}  // namespace dashpot::studio
