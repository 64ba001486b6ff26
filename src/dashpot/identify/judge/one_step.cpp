#include "dashpot/identify/judge/one_step.h"

#include <cmath>
#include <vector>

#include "dashpot/evaluate.h"
#include "dashpot/record/time_base.h"

namespace dashpot {
namespace {

/// Whether samples of the record lie on each instant of the model's grid.
bool on_grid(const Record& record, double step) {
  if (record.sample_time <= 0) return false;
  const double samples = step / record.sample_time;
  return samples > 0.5 && std::abs(samples - std::round(samples)) < 1e-6;
}

}  // namespace

ErrorSums one_step_errors(const DamperModel& model, const Record& record, DriveUnit drive_unit,
                          double offset) {
  const double step = model.feedback_step();
  if (step == 0) return {};

  // A record that is sampled off the model's grid is resampled onto it, if it is long enough.
  if (!on_grid(record, step)) {
    if (record.time.back() - record.time.front() < 2 * step) return {};
    Record grid = record;
    resample(grid, 1 / step);
    return on_grid(grid, step) ? one_step_errors(model, grid, drive_unit, offset) : ErrorSums{};
  }

  // Step through the record. Score each force before the model is given the measured one.
  const std::vector<DamperInput> inputs = damper_inputs(record, drive_unit);
  const std::vector<double>& force = record.channel("force").samples;
  std::vector<double> state(model.state_size());
  ErrorSums sums;
  model.rest(inputs.front(), state);
  for (std::size_t k = 0; k < inputs.size() && !model.has_diverged(state); ++k) {
    if (k > 0) model.advance(inputs[k - 1], inputs[k], record.time[k] - record.time[k - 1], state);
    if (k >= record.warm_up) sums.add(force[k], model.force(inputs[k], state) + offset);
    model.observe(force[k] - offset, state);
  }
  return sums;
}

}  // namespace dashpot
