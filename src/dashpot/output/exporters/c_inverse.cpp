#include "dashpot/output/exporters/c_inverse.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/switching.h"
#include "dashpot/output/exporters/c_model.h"
#include "dashpot/output/exporters/export_run.h"

namespace dashpot {
namespace {

constexpr std::size_t kTestSteps = 200;

constexpr const char* kHeader = R"(/* The current for a wanted force: @title@.
 *
 * Displacement m and velocity m/s, extension positive; force N, positive when it resists extension; current @unit@,
 * @low@ ... @high@. C99 with math.h: no heap, no files, no variables outside a damper_model. Made by Dashpot @version@:
 *   @command@
 * MISRA C:2012, deviations: @deviations@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_STATE_SIZE @size@ /* numbers in the state@unused@ */
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, between two calls of damper_step */

)";

constexpr const char* kTest =
    R"(/* Steps through a run and compares the current with the one that Dashpot @version@ computed in double precision.
 * Returns 0 when they agree within @tolerance@ of the range of currents wherever the current makes a difference. */
#include "@prefix@.h"

#include <math.h>
#include <stdio.h>

#define STEPS @steps@

/* wanted force N, displacement m, velocity m/s, present current, measured force N; current to command; 1 where the
 * current makes a difference */
static const double kRun[STEPS][7] = {
@rows@};

int main(void) {
  damper_model model;
  const damper_input start = {kRun[0][0], kRun[0][1], kRun[0][2], kRun[0][3], kRun[0][4]};
  double largest = 0.0;
  int k;
  damper_reset(&model, &start);
  for (k = 0; k < STEPS; ++k) {
    const damper_input input = {kRun[k][0], kRun[k][1], kRun[k][2], kRun[k][3], kRun[k][4]};
    const double difference = fabs(damper_step(&model, &input) - kRun[k][5]);
    if (!(difference <= @range@)) {
      return 2;
    }
    largest = fmax(largest, difference * kRun[k][6]);
  }
  printf("largest difference %g, range %g\n", (double)largest, (double)@range@);
  return (largest <= @tolerance@ * @range@) ? 0 : 1;
}
)";

/// Forces that are wanted and measured along a run.
struct Wishes {
  std::vector<double> wanted, measured;
};

/// How large the forces are where no model says it.
double force_scale(const InverseModel& inverse) {
  if (const auto* rule = dynamic_cast<const SwitchingInverse*>(&inverse)) return rule->force_max();
  const auto* model = dynamic_cast<const HistoryNetwork*>(&inverse);
  const std::vector<Tap>& taps = model->network().taps;
  for (std::size_t k = 0; k < taps.size(); ++k)
    if (taps[k].signal == Tap::Signal::Force) return model->network().mlp.input_scale[k];
  return 1000;
}

/// With a model what it gives at the run's currents, at times beyond reach.
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

/// Whether the force depends on the current by more than a tenth of what it does at most: elsewhere no
/// current is better than another, and rounding decides.
bool matters(const InverseModel& inverse, const InverseInput& input, std::span<double> state) {
  const Observer* observer = observer_of(inverse);
  if (!observer) return true;
  const InverseLimits& limits = inverse.limits();
  const double effect = std::abs(observer->force(limits.current_max, input, state) -
                                 observer->force(limits.current_min, input, state));
  return effect > 0.1 * observer->current_effect();
}

std::string rows_of(const ExportedInverse& exported) {
  const InverseModel& inverse = exported.model;
  const std::vector<DamperInput> run = export_run(exported.domain, inverse.limits().sample_time, kTestSteps);
  const Wishes wishes = wishes_along(inverse, run);
  std::vector<double> state(inverse.state_size());
  std::string rows;
  double current = run[0].current;  // in the coil
  for (std::size_t k = 0; k < run.size(); ++k) {
    const DamperInput& now = run[k];
    if (k == 0) inverse.rest({now.displacement, 0, current}, state);
    const InverseInput input{wishes.wanted[k], now.displacement, now.velocity, current, wishes.measured[k]};
    const double command = inverse.command(input, state);
    rows += "    " +
            c_numbers(std::vector{input.wanted, input.displacement, input.velocity, input.current,
                                  input.measured, command, matters(inverse, input, state) ? 1.0 : 0.0}) +
            ",\n";
    current += (inverse.limits().lag_rate > 0 ? 0.2 : 1) * (command - current);
  }
  return rows;
}

}  // namespace

std::vector<ExportedFile> write_c_inverse(const ExportedInverse& inverse, const ExportOptions& options) {
  const InverseLimits& limits = inverse.model.limits();
  const std::string prefix = c_name(options.name.empty() ? inverse.model.name() + "_inverse" : options.name);
  const std::string code = with_texts(
      "typedef struct DamperInput {\n  double displacement, velocity, current;\n} DamperInput;\n"
      "typedef damper_input InverseInput;\n\n" +
      c_inverse(inverse.model, options.c_precision()).code);
  require_free_names(prefix, code);
  const std::size_t size = inverse.model.state_size();
  const std::vector<std::pair<std::string, std::string>> values{
      {"prefix", prefix},
      {"title", inverse.title},
      {"unit", inverse.drive_unit},
      {"low", format_number(limits.current_min)},
      {"high", format_number(limits.current_max)},
      {"range", c_number(limits.current_max - limits.current_min)},
      {"version", options.version},
      {"size", std::to_string(std::max<std::size_t>(1, size))},
      {"deviations", std::string(c_deviations())},
      {"unused", size == 0 ? ": one that is not used" : ""},
      {"sample_time", c_number(limits.sample_time)},
      {"steps", std::to_string(kTestSteps)},
      {"tolerance", options.c_precision() == CPrecision::Double ? "1e-12" : "1e-5"},
      {"rows", rows_of(inverse)}};
  const auto finished = [&](const std::string& text) {
    return filled(with_prefix(in_precision(filled(text, values), options.c_precision()), prefix),
                  {{"command", in_comment(options.command)}});
  };
  return {{prefix + ".h", finished(kHeader + std::string(c_text("inverse_api.h")) + kCHeaderEnd)},
          {prefix + ".c", finished("#include \"@prefix@.h\"\n\n#include <math.h>\n\n" + code +
                                   std::string(c_text("inverse_api.c")))},
          {prefix + "_test.c", finished(kTest)}};
}

std::vector<ExportedFile> write_c_inverse(const InverseFile& inverse, const ExportOptions& options) {
  const InverseNetwork& network = inverse.network;
  const double sample_time = options.sample_time > 0 ? options.sample_time : network.spacing;
  const HistoryNetwork model(network, {network.current_min, network.current_max, sample_time, 0});
  return write_c_inverse({.model = model,
                          .title = "the inverse network " + network.name,
                          .drive_unit = inverse.drive_unit,
                          .domain = inverse.domain},
                         options);
}

}  // namespace dashpot
