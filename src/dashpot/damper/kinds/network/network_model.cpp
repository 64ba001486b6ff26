#include "dashpot/damper/kinds/network/network_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/nets/mlp_json.h"
#include "dashpot/error.h"

namespace dashpot {

double DamperInput::* input_field(std::string_view input, const std::string& where) {
  if (input == "displacement") return &DamperInput::displacement;
  if (input == "velocity") return &DamperInput::velocity;
  if (input == "current") return &DamperInput::current;
  throw Error(where, "unknown network input '" + std::string(input) + "'",
              suggest(input, {"displacement", "velocity", "current"}));
}

NetworkModel::NetworkModel(std::string name, std::vector<std::string> inputs,
                           std::vector<Mlp> members, double offset)
    : name_(std::move(name)),
      inputs_(std::move(inputs)),
      members_(std::move(members)),
      offset_(offset) {
  for (const std::string& input : inputs_) fields_.push_back(input_field(input, name_));
  if (members_.empty()) throw Error(name_, "has no members", "a network at least");
  for (const Mlp& member : members_) require_shape(member, inputs_.size(), name_);
  ensemble_ = std::make_unique<MlpEnsemble>(members_);
}

std::size_t NetworkModel::parameter_count() const noexcept {
  std::size_t count = 0;
  for (const Mlp& member : members_) count += member.parameters.size();
  return count;
}

bool NetworkModel::needs_displacement() const noexcept {
  return std::find(inputs_.begin(), inputs_.end(), "displacement") != inputs_.end();
}

MlpEnsemble::Answer NetworkModel::answer(const DamperInput& input) const noexcept {
  std::array<double, Mlp::kMaxWidth> raw;
  for (std::size_t k = 0; k < fields_.size(); ++k) raw[k] = input.*fields_[k];
  return ensemble_->evaluate(raw.data());
}

double NetworkModel::force(const DamperInput& input, std::span<const double>) const noexcept {
  return answer(input).mean + offset_;
}

double NetworkModel::spread(const DamperInput& input, std::span<const double>) const noexcept {
  return answer(input).spread;
}

std::unique_ptr<DamperModel> NetworkModel::with_offset(double newton) const {
  return std::make_unique<NetworkModel>(name_, inputs_, members_, offset_ + newton);
}

/// One network stands in the model itself, several in a list.
Value NetworkModel::to_json() const {
  Value value = Value::object({{"name", name_}, {"inputs", Value::array(inputs_)}});

  // One network stands in the model itself, several in a list of members.
  if (members_.size() == 1) {
    add_mlp(value, members_.front());
  } else {
    Value members = Value::array();
    for (const Mlp& member : members_) {
      Value one = Value::object({});
      add_mlp(one, member);
      members.push_back(std::move(one));
    }
    value.add("members", std::move(members));
  }
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

  // One network stands in the model itself, several in a list of members.
  std::vector<Mlp> networks;
  if (const Value* members = reader.optional("members")) {
    for (const Value& item : members->items()) {
      ObjectReader member(item, "a member");
      networks.push_back(read_mlp(member));
      member.finish();
      require_shape(networks.back(), inputs.size(), item.where());
    }
    if (networks.empty()) throw Error(members->where(), "has no members", "a network at least");
  } else {
    networks.push_back(read_mlp(reader));
    require_shape(networks.back(), inputs.size(), value.where());
  }

  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<NetworkModel>(std::move(name), std::move(inputs), std::move(networks),
                                        offset);
}

}  // namespace dashpot
