#include "dashpot/design/design_model.h"

#include <array>
#include <optional>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

class PhysicsModel final : public DesignModel {
 public:
  PhysicsModel(std::string name, std::optional<FlowLaw> flow)
      : name_(std::move(name)), flow_(flow) {}
  std::string name() const override { return name_; }
  Appraisal appraise(const DamperDescription& description,
                     const DamperOperation& operation) const override {
    if (!flow_) return {.physics = evaluate_physics(description, operation)};
    DamperDescription other = description;
    other.flow_law = *flow_;
    return {.physics = evaluate_physics(other, operation)};
  }

 private:
  std::string name_;
  std::optional<FlowLaw> flow_;
};

struct NamedModel {
  std::string_view name;
  std::optional<FlowLaw> flow;
};
constexpr std::array kModels{NamedModel{"physics", {}}, NamedModel{"physics:plate", FlowLaw::Plate},
                             NamedModel{"physics:moving_wall", FlowLaw::MovingWall},
                             NamedModel{"physics:paper", FlowLaw::Paper}};

}  // namespace

std::vector<std::string> design_model_names() {
  std::vector<std::string> names;
  for (const NamedModel& model : kModels) names.emplace_back(model.name);
  return names;
}

std::unique_ptr<DesignModel> make_design_model(const std::string& name, const std::string& where,
                                               bool insist) {
  for (const NamedModel& model : kModels)
    if (model.name == name) return std::make_unique<PhysicsModel>(name, model.flow);
  if (name.find_first_of("./") != std::string::npos) return load_family_design_model(name, insist);
  throw Error(where, "unknown model '" + name + "'",
              suggest(name, design_model_names()) + ", or the file of a family's model");
}

}  // namespace dashpot
