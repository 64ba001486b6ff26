#include <array>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using Shape = Membership::Shape;

struct ShapeName {
  Shape shape;
  std::string_view name;
};
constexpr std::array<ShapeName, 3> kShapes{
    {{Shape::Bell, "bell"}, {Shape::Gaussian, "gaussian"}, {Shape::Sigmoid, "sigmoid"}}};

std::string_view name_of(Shape shape) {
  for (const ShapeName& known : kShapes)
    if (known.shape == shape) return known.name;
  return {};
}

Shape read_shape(const Value& value) {
  std::vector<std::string> names;
  for (const ShapeName& known : kShapes) {
    if (known.name == value.as_string()) return known.shape;
    names.emplace_back(known.name);
  }
  throw Error(value.where(), "unknown shape '" + value.as_string() + "'",
              suggest(value.as_string(), names));
}

/// An index; its upper end is known to the model.
std::size_t read_index(const Value& value) {
  constexpr double kMost = 1e6;
  const double index = value.as_number();
  if (!(index >= 0 && index <= kMost && index == std::floor(index)))
    throw Error(value.where(), "is " + format_number(index),
                "write a whole number, counted from 0");
  return static_cast<std::size_t>(index);
}

Value input_to_json(const Sugeno::Input& input, const std::string& name) {
  return Value::object({{"name", name},
                        {"mean", input.mean},
                        {"scale", input.scale},
                        {"low", input.low},
                        {"high", input.high}});
}

Sugeno::Input read_input(const Value& value, std::vector<std::string>& names) {
  ObjectReader reader(value, "an input");
  names.push_back(reader.string("name"));
  const Sugeno::Input input{reader.number("mean"), reader.number("scale"), reader.number("low"),
                            reader.number("high")};
  reader.finish();
  return input;
}

Value membership_to_json(const Membership& m) {
  Value out =
      Value::object({{"shape", name_of(m.shape)}, {"input", m.input}, {"centre", m.centre}});
  if (m.shape != Shape::Sigmoid) out.add("width", m.width);
  if (m.shape != Shape::Gaussian) out.add("slope", m.slope);
  return out;
}

Membership read_membership(const Value& value) {
  ObjectReader reader(value, "a membership");
  Membership m;
  m.shape = read_shape(reader.required("shape"));
  m.input = read_index(reader.required("input"));
  m.centre = reader.number("centre");
  if (m.shape != Shape::Sigmoid) m.width = reader.number("width");
  if (m.shape != Shape::Gaussian) m.slope = reader.number("slope");
  reader.finish();
  return m;
}

}  // namespace

Value FuzzyModel::to_json() const {
  Value inputs = Value::array(), memberships = Value::array(), rules = Value::array();
  for (std::size_t k = 0; k < sugeno_.inputs.size(); ++k)
    inputs.push_back(input_to_json(sugeno_.inputs[k], inputs_.names()[k]));
  for (const Membership& m : sugeno_.memberships) memberships.push_back(membership_to_json(m));
  for (const std::vector<std::size_t>& rule : sugeno_.rules)
    rules.push_back(Value::array(std::vector<double>(rule.begin(), rule.end())));

  return Value::object({{"name", name_},
                        {"inputs", std::move(inputs)},
                        {"velocity_lag", inputs_.lags().velocity},
                        {"coil_lag", inputs_.lags().coil},
                        {"memberships", std::move(memberships)},
                        {"rules", std::move(rules)},
                        {"consequents", Value::array(sugeno_.consequents)},
                        {"output_mean", sugeno_.output_mean},
                        {"output_scale", sugeno_.output_scale},
                        {"offset", offset_}});
}

std::unique_ptr<FuzzyModel> fuzzy_model_from_json(const Value& value) {
  ObjectReader reader(value, "a fuzzy model");
  std::string name = reader.string("name");
  Sugeno sugeno;
  std::vector<std::string> names;
  for (const Value& item : reader.required("inputs").items())
    sugeno.inputs.push_back(read_input(item, names));

  // The inputs' lags and the sets over them.
  const FuzzyInputs::Lags lags{reader.number("velocity_lag"), reader.number("coil_lag")};
  for (const Value& item : reader.required("memberships").items())
    sugeno.memberships.push_back(read_membership(item));

  // The rules, and the force of each.
  for (const Value& item : reader.required("rules").items()) {
    sugeno.rules.emplace_back();
    for (const Value& index : item.items()) sugeno.rules.back().push_back(read_index(index));
  }
  sugeno.consequents = reader.required("consequents").as_numbers();
  sugeno.output_mean = reader.number("output_mean");
  sugeno.output_scale = reader.number("output_scale");
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<FuzzyModel>(std::move(name),
                                      FuzzyInputs(std::move(names), lags, value.where()),
                                      std::move(sugeno), offset, value.where());
}

}  // namespace dashpot
