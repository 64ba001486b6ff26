#include "dashpot/damper/neural/network_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

double DamperInput::* field_of(std::string_view input, const std::string& where) {
  if (input == "displacement") return &DamperInput::displacement;
  if (input == "velocity") return &DamperInput::velocity;
  if (input == "current") return &DamperInput::current;
  throw Error(where, "unknown network input '" + std::string(input) + "'",
              suggest(input, {"displacement", "velocity", "current"}));
}

void require_shape(const Mlp& mlp, std::size_t inputs, const std::string& where) {
  const auto fail = [&](const std::string& what, const std::string& right) {
    throw Error(where, what, right);
  };
  const auto& layers = mlp.layers;
  if (layers.size() < 2 || layers.front() != inputs || layers.back() != 1)
    fail("the layers do not go from " + std::to_string(inputs) + " inputs to one force",
         "write [inputs, neurons, ..., 1]");
  for (const std::size_t width : layers)
    if (width < 1 || width > Mlp::kMaxWidth)
      fail("a layer has " + std::to_string(width) + " neurons", "1 to " + std::to_string(Mlp::kMaxWidth));
  if (!mlp.activations.empty() && mlp.activations.size() + 1 != layers.size())
    fail("has " + std::to_string(mlp.activations.size()) + " activations",
         "write one for each layer behind the inputs");
  if (const std::size_t wanted = Mlp::parameter_count(layers); mlp.parameters.size() != wanted)
    fail("has " + std::to_string(mlp.parameters.size()) + " weights",
         "these layers need " + std::to_string(wanted));
  if (mlp.input_mean.size() != inputs || mlp.input_scale.size() != inputs)
    fail("the input means and scales are not one per input", "");
  const auto positive = [](double scale) { return scale > 0 && std::isfinite(scale); };
  if (!std::all_of(mlp.input_scale.begin(), mlp.input_scale.end(), positive) || !positive(mlp.output_scale))
    fail("a scale is not a positive number", "");
}

std::vector<std::size_t> read_layers(const Value& value) {
  std::vector<std::size_t> layers;
  for (const Value& item : value.items()) {
    const double width = item.as_number();
    if (!(width >= 1 && width <= Mlp::kMaxWidth && width == std::floor(width)))
      throw Error(item.where(), "a layer of " + format_number(width) + " neurons",
                  "write a whole number, 1 to " + std::to_string(Mlp::kMaxWidth));
    layers.push_back(static_cast<std::size_t>(width));
  }
  return layers;
}

void add_network(const Mlp& mlp, Value& value) {
  value.add("layers", Value::array(std::vector<double>(mlp.layers.begin(), mlp.layers.end())));
  if (!mlp.activations.empty()) {
    Value activations = Value::array();
    for (const Activation activation : mlp.activations) activations.push_back(name_of(activation));
    value.add("activations", activations);
  }
  value.add("input_mean", Value::array(mlp.input_mean));
  value.add("input_scale", Value::array(mlp.input_scale));
  value.add("output_mean", mlp.output_mean);
  value.add("output_scale", mlp.output_scale);
  value.add("parameters", Value::array(mlp.parameters));
}

Mlp read_network(ObjectReader& reader) {
  Mlp mlp;
  mlp.layers = read_layers(reader.required("layers"));
  if (const Value* activations = reader.optional("activations"))
    for (const Value& item : activations->items())
      mlp.activations.push_back(activation_named(item.as_string(), item.where()));
  mlp.input_mean = reader.required("input_mean").as_numbers();
  mlp.input_scale = reader.required("input_scale").as_numbers();
  mlp.output_mean = reader.number("output_mean");
  mlp.output_scale = reader.number("output_scale");
  mlp.parameters = reader.required("parameters").as_numbers();
  return mlp;
}

}  // namespace

NetworkModel::NetworkModel(std::string name, std::vector<std::string> inputs, std::vector<Mlp> members,
                           double offset)
    : name_(std::move(name)), inputs_(std::move(inputs)), members_(std::move(members)), offset_(offset) {
  for (const std::string& input : inputs_) fields_.push_back(field_of(input, name_));
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
  if (members_.size() == 1) {
    add_network(members_.front(), value);
  } else {
    Value members = Value::array();
    for (const Mlp& member : members_) {
      Value one = Value::object({});
      add_network(member, one);
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
    field_of(item.as_string(), item.where());
    inputs.push_back(item.as_string());
  }
  std::vector<Mlp> networks;
  if (const Value* members = reader.optional("members")) {
    for (const Value& item : members->items()) {
      ObjectReader member(item, "a member");
      networks.push_back(read_network(member));
      member.finish();
      require_shape(networks.back(), inputs.size(), item.where());
    }
    if (networks.empty()) throw Error(members->where(), "has no members", "a network at least");
  } else {
    networks.push_back(read_network(reader));
    require_shape(networks.back(), inputs.size(), value.where());
  }
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<NetworkModel>(std::move(name), std::move(inputs), std::move(networks), offset);
}

}  // namespace dashpot
