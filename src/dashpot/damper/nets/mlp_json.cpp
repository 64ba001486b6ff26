#include "dashpot/damper/nets/mlp_json.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

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

}  // namespace

void add_mlp(Value& object, const Mlp& mlp) {
  object.add("layers", Value::array(std::vector<double>(mlp.layers.begin(), mlp.layers.end())));
  if (!mlp.activations.empty()) {
    Value activations = Value::array();
    for (const Activation activation : mlp.activations) activations.push_back(name_of(activation));
    object.add("activations", activations);
  }
  object.add("input_mean", Value::array(mlp.input_mean));
  object.add("input_scale", Value::array(mlp.input_scale));
  object.add("output_mean", mlp.output_mean);
  object.add("output_scale", mlp.output_scale);
  object.add("parameters", Value::array(mlp.parameters));
}

Mlp read_mlp(ObjectReader& reader) {
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

void require_shape(const Mlp& mlp, std::size_t inputs, const std::string& where) {
  const auto fail = [&](const std::string& what, const std::string& right) {
    throw Error(where, what, right);
  };

  // Layers, their activations and their weights.
  const auto& layers = mlp.layers;
  if (layers.size() < 2 || layers.front() != inputs || layers.back() != 1)
    fail("the layers do not go from " + std::to_string(inputs) + " inputs to one force",
         "write [inputs, neurons, ..., 1]");
  for (const std::size_t width : layers)
    if (width < 1 || width > Mlp::kMaxWidth)
      fail("a layer has " + std::to_string(width) + " neurons",
           "1 to " + std::to_string(Mlp::kMaxWidth));
  if (!mlp.activations.empty() && mlp.activations.size() + 1 != layers.size())
    fail("has " + std::to_string(mlp.activations.size()) + " activations",
         "write one for each layer behind the inputs");
  if (const std::size_t wanted = Mlp::parameter_count(layers); mlp.parameters.size() != wanted)
    fail("has " + std::to_string(mlp.parameters.size()) + " weights",
         "these layers need " + std::to_string(wanted));

  // Scales.
  if (mlp.input_mean.size() != inputs || mlp.input_scale.size() != inputs)
    fail("the input means and scales are not one per input", "");
  const auto positive = [](double scale) { return scale > 0 && std::isfinite(scale); };
  if (!std::all_of(mlp.input_scale.begin(), mlp.input_scale.end(), positive) ||
      !positive(mlp.output_scale))
    fail("a scale is not a positive number", "");
}

}  // namespace dashpot
