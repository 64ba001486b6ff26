#include "dashpot/damper/kinds/network/presets.h"

#include <array>

namespace dashpot {

ModelInfo NetworkPreset::info() const {
  return {name, ModelKind::Network, title, equation, source, remarks, inputs};
}

std::span<const NetworkPreset> network_presets() {
  static const std::array<NetworkPreset, 2> kPresets{{
      {.name = "mlp_one_sensor",
       .title = "Static network, one sensor",
       .equation = "F = w2 . tanh(W1 [v, i] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks = "41 parameters; no state and no displacement, so no hysteresis. The activation "
                  "is not stated in the source; tanh with a linear output is assumed.",
       .inputs = {"velocity", "current"},
       .hidden = {10}},

      {.name = "mlp_two_sensors",
       .title = "Static network, two sensors",
       .equation = "F = w2 . tanh(W1 [x, v, i] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks = "51 parameters; displacement tells the branches of a loop apart, for motions "
                  "like those it was trained on.",
       .inputs = {"displacement", "velocity", "current"},
       .hidden = {10}},
  }};
  return kPresets;
}

}  // namespace dashpot
