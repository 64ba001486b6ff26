#include "dashpot/damper/kinds/narx/presets.h"

#include <array>

namespace dashpot {

ModelInfo NarxPreset::info() const {
  return {name, ModelKind::Narx, title, equation, source, remarks, inputs};
}

std::span<const NarxPreset> narx_presets() {
  static const std::array<NarxPreset, 2> kPresets{{
      {.name = "narx_one_sensor",
       .title = "Recurrent network (NARX), one sensor",
       .equation = "F(t) = w2 . tanh(W1 [v(t), v(t-T), v(t-2T), i(t), i(t-T), i(t-2T), F(t-T), "
                   "F(t-2T)] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks =
           "101 parameters. Trained on the measured force fed back, then in free run over windows "
           "of 10 and 100 steps and over whole records, which start without a measured force, by "
           "Levenberg-Marquardt with exact derivatives; the weight decay is the one with which "
           "short trials predict held-back training data best. T: as many samples as fit into "
           "1 ms, one at least, of the record with the longest sample time; others are resampled "
           "to it. A drive that is steady within each record is read at present only. The model "
           "stands still, and is reported as diverged, where its force is ten standard deviations "
           "from the mean of its training; --network output=bounded rules that out.",
       .inputs = {"velocity", "current"},
       .hidden = {10},
       .delays = 2,
       .feedback = 2},

      {.name = "narx_two_sensors",
       .title = "Recurrent network (NARX), two sensors",
       .equation = "F(t) = w2 . tanh(W1 [x(t), v(t), i(t), F(t-T)] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks = "61 parameters, the recurrent network of the source; trained and judged as "
                  "narx_one_sensor is.",
       .inputs = {"displacement", "velocity", "current"},
       .hidden = {10},
       .feedback = 1},
  }};
  return kPresets;
}

NarxPreset narx_preset(const NetworkPreset& preset) {
  return {.name = preset.name,
          .title = preset.title,
          .equation = preset.equation,
          .source = preset.source,
          .remarks = preset.remarks,
          .inputs = preset.inputs,
          .hidden = preset.hidden};
}

}  // namespace dashpot
