#include "dashpot/output/exporters/c_model.h"

#include "dashpot/base/error.h"
#include "dashpot/damper/law_model.h"

namespace dashpot {

CModel c_model(const DamperModel& model) {
  if (const auto* law = dynamic_cast<const LawModel*>(&model)) return c_law(*law, "model");
  throw Error(model.name(), "a model of kind '" + model.kind() + "' has no C code",
              "export a law, a network, ...");
}

std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string place = '@' + name + '@';
    for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += value.size())
      text.replace(at, place.size(), value);
  }
  return text;
}

}  // namespace dashpot
