#include "contributing/kind/line_example_model.h"

#include <array>

namespace dashpot {
namespace {

constexpr std::array kPresets{LineExamplePreset{.name = "line_example",
                                                .title = "Straight line",
                                                .equation = "F = c v + f0",
                                                .source = "made up for CONTRIBUTING.md",
                                                .remarks = "No hysteresis."}};

}  // namespace

Value LineExampleModel::to_json() const {
  return Value::object({{"damping", damping_}, {"offset", offset_}});
}

std::unique_ptr<LineExampleModel> line_example_model_from_json(const Value& value) {
  ObjectReader reader(value, "a straight line");
  const double damping = reader.number("damping"), offset = reader.number("offset");
  reader.finish();
  return std::make_unique<LineExampleModel>(damping, offset);
}

ModelInfo LineExamplePreset::info() const {
  return {name, ModelKind::LineExample, title, equation, source, remarks, {"velocity", "current"}};
}

std::span<const LineExamplePreset> line_example_presets() { return kPresets; }

}  // namespace dashpot
