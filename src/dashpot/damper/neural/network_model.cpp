#include "dashpot/damper/neural/network_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/neural/mlp_json.h"

namespace dashpot {
double DamperInput::* input_field(std::string_view input, const std::string& where) {
  if (input == "displacement") return &DamperInput::displacement;
  if (input == "velocity") return &DamperInput::velocity;
  if (input == "current") return &DamperInput::current;
  throw Error(where, "unknown network input '" + std::string(input) + "'",
              suggest(input, {"displacement", "velocity", "current"}));
}

NetworkModel::NetworkModel(std::string name, std::vector<std::string> inputs, Mlp mlp, double offset)
    : name_(std::move(name)), inputs_(std::move(inputs)), mlp_(std::move(mlp)), offset_(offset) {
  for (const std::string& input : inputs_) fields_.push_back(input_field(input, name_));
  require_shape(mlp_, inputs_.size(), name_);
  evaluator_ = std::make_unique<MlpEvaluator<double>>(mlp_);
}

bool NetworkModel::needs_displacement() const noexcept {
  return std::find(inputs_.begin(), inputs_.end(), "displacement") != inputs_.end();
}

double NetworkModel::force(const DamperInput& input, std::span<const double>) const noexcept {
  std::array<double, Mlp::kMaxWidth> raw;
  for (std::size_t k = 0; k < fields_.size(); ++k) raw[k] = input.*fields_[k];
  return evaluator_->evaluate(raw.data()) + offset_;
}

std::unique_ptr<DamperModel> NetworkModel::with_offset(double newton) const {
  return std::make_unique<NetworkModel>(name_, inputs_, mlp_, offset_ + newton);
}

Value NetworkModel::to_json() const {
  Value value = Value::object({{"name", name_}, {"inputs", Value::array(inputs_)}});
  add_mlp(value, mlp_);
  value.add("offset", offset_);
  return value;
}

std::unique_ptr<NetworkModel> network_model_from_json(const Value& value) {
  ObjectReader reader(value, "a network model");
  std::string name = reader.string("name");
  std::vector<std::string> inputs;
  for (const Value& item : reader.required("inputs").items()) {
    input_field(item.as_string(), item.where());
    inputs.push_back(item.as_string());
  }
  Mlp mlp = read_mlp(reader);
  const double offset = reader.number("offset");
  reader.finish();
  require_shape(mlp, inputs.size(), value.where());
  return std::make_unique<NetworkModel>(std::move(name), std::move(inputs), std::move(mlp), offset);
}

}  // namespace dashpot
