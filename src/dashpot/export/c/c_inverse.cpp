#include "dashpot/export/c/c_inverse.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/switching.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/export_run.h"

namespace dashpot {
namespace {

constexpr std::size_t kInverseTestSteps = 200;

constexpr const char* kInverseAbout =
    "Displacement m and velocity m/s, extension positive; force N, positive when it resists "
    "extension; current @unit@, @low@ ... @high@.";

constexpr const char* kInverseHeader = R"(/* The current for a wanted force: @title@.
 *
 * @about@
 *
 *   damper_model model;
 *   damper_reset(&model, &input);
 *   for (;;) current = damper_step(&model, &input);
 *
 * C99 with math.h: no heap, no files, no variables outside a damper_model.
 * Made by Dashpot @version@:
 *   @command@
 * MISRA C:2012, deviations: @deviations@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_STATE_SIZE @size@ /* numbers in the state@unused@ */
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, between two calls of damper_step */

)";

constexpr const char* kBegin = R"(#include "@prefix@.h"

#include <math.h>

typedef struct DamperInput {
  double displacement, velocity, current;
} DamperInput;
typedef damper_input InverseInput;

)";

/// Forces that are wanted and measured along a run.
struct Wishes {
  std::vector<double> wanted, measured;
};

/// The size of the forces, N, where no model gives it.
double force_scale(const InverseModel& inverse) {
  if (const auto* rule = dynamic_cast<const SwitchingInverse*>(&inverse)) return rule->force_max();
  const auto* model = dynamic_cast<const HistoryNetwork*>(&inverse);
  const std::vector<Tap>& taps = model->network().taps;
  for (std::size_t k = 0; k < taps.size(); ++k)
    if (taps[k].signal == Tap::Signal::Force) return model->network().mlp.input_scale[k];
  return 1000;
}

/// With a model the forces that it gives at the run's currents, scaled so that they are at times
/// out of reach; else sines.
Wishes wishes_along(const InverseModel& inverse, const std::vector<DamperInput>& run) {
  Wishes wishes;
  if (const Observer* observer = observer_of(inverse))
    wishes.wanted = force_along(observer->model(), run, inverse.limits().sample_time);

  for (std::size_t k = 0; k < run.size(); ++k) {
    const double place = static_cast<double>(k);
    if (observer_of(inverse)) {
      wishes.wanted[k] *= 1 + 0.2 * std::sin(0.11 * place);
      wishes.measured.push_back(0);
    } else {
      wishes.wanted.push_back(force_scale(inverse) * std::sin(0.07 * place));
      wishes.measured.push_back(0.8 * force_scale(inverse) * std::sin(0.05 * place + 1));
    }
  }
  return wishes;
}

/// Whether the force depends on the current by more than a tenth of what it does at most: elsewhere
/// no current is better than another, and rounding decides.
bool matters(const InverseModel& inverse, const InverseInput& input, std::span<double> state) {
  const Observer* observer = observer_of(inverse);
  if (!observer) return true;
  const InverseLimits& limits = inverse.limits();
  const double effect = std::abs(observer->force(limits.current_max, input, state) -
                                 observer->force(limits.current_min, input, state));
  return effect > 0.1 * observer->current_effect();
}

std::vector<CBlock::Sample> run_of(const ExportedInverse& exported) {
  const InverseModel& inverse = exported.model;
  const std::vector<DamperInput> run =
      export_run(exported.domain, inverse.limits().sample_time, kInverseTestSteps);
  const Wishes wishes = wishes_along(inverse, run);
  std::vector<double> state(inverse.state_size());
  std::vector<CBlock::Sample> samples;
  double current = run[0].current;  // in the coil

  for (std::size_t k = 0; k < run.size(); ++k) {
    const DamperInput& now = run[k];
    if (k == 0) inverse.rest({now.displacement, 0, current}, state);
    const InverseInput input{wishes.wanted[k], now.displacement, now.velocity, current,
                             wishes.measured[k]};
    const double command = inverse.command(input, state);
    samples.push_back(
        {{input.wanted, input.displacement, input.velocity, input.current, input.measured},
         {command},
         matters(inverse, input, state)});

    // The coil follows: at once, or by a fifth of the way in a sample where it lags.
    current += (inverse.limits().lag_rate > 0 ? 0.2 : 1) * (command - current);
  }
  return samples;
}

}  // namespace

CBlock c_inverse_block(const ExportedInverse& inverse, const ExportOptions& options) {
  const InverseLimits& limits = inverse.model.limits();
  const std::string& unit = to_string(inverse.drive_unit);
  const std::size_t size = std::max<std::size_t>(1, inverse.model.state_size());

  // The facts that the header states.
  const std::string measured =
      inverse.model.has_feedback() ? "this scheme needs it" : "this scheme does not look at it";
  const std::string about =
      filled(kInverseAbout, {{"unit", CText::own(unit)},
                             {"low", CText::own(format_number(limits.current_min))},
                             {"high", CText::own(format_number(limits.current_max))}}) +
      (inverse.origin.empty() ? "" : ' ' + inverse.origin);
  const std::vector<std::pair<std::string, CText>> values{
      {"title", c_comment(inverse.title)},
      {"about", c_comment(about)},
      {"version", c_comment(options.version)},
      {"size", CText::own(std::to_string(size))},
      {"deviations", CText::own(std::string(c_deviations()))},
      {"unused", CText::own(inverse.model.state_size() == 0 ? ": one that is not used" : "")},
      {"measured", CText::own(measured)},
      {"sample_time", CText::own(c_number(limits.sample_time))}};

  // The texts, the interface port by port, and the run that checks them.
  return {
      .name = c_name(options.name.empty() ? inverse.model.name() + "_inverse" : options.name),
      .title = inverse.title,
      .about = about,
      .precision = options.c_precision(),
      .header = filled(kInverseHeader + std::string(c_text("inverse_api.h")) + kCHeaderEnd, values),
      .source =
          kBegin + with_texts(c_inverse(inverse.model).code) + std::string(c_text("inverse_api.c")),
      .step = "commands[0] = damper_step(&model, &input);",
      .inputs = {{"wanted", "N", "force wanted, positive when it resists extension", "wanted"},
                 {"displacement", "m", "of the damper, extension positive", "displacement"},
                 {"velocity", "m/s", "of the damper, extension positive", "velocity"},
                 {"current", unit, "in the coil now", "current"},
                 {"measured", "N", "force now: " + measured, "measured"}},
      .commands = {{"command", unit, "to the coil", "commands[0]"}},
      .state_size = size,
      .sample_time = limits.sample_time,
      .range = limits.current_max - limits.current_min,
      .tolerance = options.c_precision() == CPrecision::Double ? 1e-12 : 1e-5,
      .samples = run_of(inverse),
      .version = options.version};
}

CBlock c_inverse_block(const InverseFile& inverse, const ExportOptions& options) {
  const InverseNetwork& network = inverse.network;
  const double sample_time = options.sample_time > 0 ? options.sample_time : network.spacing;
  const HistoryNetwork model(network, {network.current_min, network.current_max, sample_time, 0});
  return c_inverse_block({.model = model,
                          .title = "the inverse network " + network.name,
                          .drive_unit = inverse.drive_unit,
                          .domain = inverse.domain,
                          .origin = known_text(inverse.domain, inverse.drive_unit)},
                         options);
}

}  // namespace dashpot
