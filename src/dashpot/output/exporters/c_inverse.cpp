#include "dashpot/output/exporters/c_inverse.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/output/exporters/c_model.h"
#include "dashpot/output/exporters/export_run.h"

namespace dashpot {
namespace {

constexpr std::size_t kTestSteps = 200;

constexpr const char* kHeader = R"(/* The current for a wanted force: the inverse network @name@.
 *
 * Displacement m and velocity m/s, extension positive; force N, positive when it resists extension; current @unit@,
 * @low@ ... @high@. C99 with math.h: no heap, no files, no variables outside a damper_model. Made by Dashpot @version@:
 *   @command@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_STATE_SIZE @size@ /* numbers in the state */
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, between two calls of damper_step */

)";

constexpr const char* kHeaderEnd = R"(
#ifdef __cplusplus
}
#endif

#endif
)";

constexpr const char* kTest =
    R"(/* Steps through a run and compares the current with the one that Dashpot @version@ computed in double precision.
 * Returns 0 when they agree within @tolerance@ of the range of currents. */
#include "@prefix@.h"

#include <math.h>
#include <stdio.h>

#define STEPS @steps@

/* wanted force N, displacement m, velocity m/s, present current, current to command */
static const double kRun[STEPS][5] = {
@rows@};

int main(void) {
  damper_model model;
  const damper_input start = {kRun[0][0], kRun[0][1], kRun[0][2], kRun[0][3]};
  double largest = 0.0;
  int k;
  damper_reset(&model, &start);
  for (k = 0; k < STEPS; ++k) {
    const damper_input input = {kRun[k][0], kRun[k][1], kRun[k][2], kRun[k][3]};
    largest = fmax(largest, fabs(damper_step(&model, &input) - kRun[k][4]));
  }
  printf("largest difference %g, range %g\n", (double)largest, (double)@range@);
  return (largest <= @tolerance@ * @range@) ? 0 : 1;
}
)";

/// How large the wanted forces were that it was taught, or a usual one.
double force_scale(const InverseNetwork& network) {
  for (std::size_t k = 0; k < network.taps.size(); ++k)
    if (network.taps[k].signal == Tap::Signal::Force) return network.mlp.input_scale[k];
  return 1000;
}

std::string rows_of(const HistoryNetwork& model, const Domain& domain) {
  std::vector<double> state(model.state_size());
  const std::vector<DamperInput> run = export_run(domain, model.limits().sample_time, kTestSteps);
  std::string rows;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const DamperInput& now = run[k];
    if (k == 0) model.rest(now, state);
    const double wanted = force_scale(model.network()) * std::sin(0.07 * static_cast<double>(k));
    const InverseInput input{wanted, now.displacement, now.velocity, now.current, 0};
    rows += "    " +
            c_numbers(std::vector{wanted, now.displacement, now.velocity, now.current,
                                  model.command(input, state)}) +
            ",\n";
  }
  return rows;
}

/// What the text of the interface asks for.
std::string tables(const InverseNetwork& network, const InverseLimits& limits) {
  const auto stride = static_cast<int>(network.stride(limits.sample_time));
  std::vector<int> places;
  for (const Tap& tap : network.taps) places.push_back(4 * stride * tap.delay + static_cast<int>(tap.signal));
  const double range = limits.current_max - limits.current_min;
  const double change = network.rate_max > 0 ? network.rate_max * limits.sample_time : range;
  const auto constant = [](const std::string& name, double value) {
    return "static const double " + name + " = " + c_number(value) + ";\n";
  };
  return "#include \"held.h\"\n" + c_mlps({&network.mlp, 1}) + "#define INVERSE_TAPS " +
         std::to_string(network.taps.size()) + "\n\n" + c_table("kPlaces", places) +
         constant("kLeast", limits.current_min) + constant("kMost", limits.current_max) +
         constant("kMostChange", change);
}

}  // namespace

std::vector<ExportedFile> write_c_inverse(const InverseFile& inverse, const ExportOptions& options) {
  const InverseNetwork& network = inverse.network;
  const double sample_time = options.sample_time > 0 ? options.sample_time : network.spacing;
  const HistoryNetwork model(network, {network.current_min, network.current_max, sample_time, 0});
  const std::string prefix = c_name(options.name.empty() ? network.name + "_inverse" : options.name);
  const std::string code = with_texts(tables(network, model.limits()));
  require_free_names(prefix, code);
  const std::vector<std::pair<std::string, std::string>> values{
      {"prefix", prefix},
      {"name", network.name},
      {"unit", inverse.drive_unit},
      {"low", format_number(network.current_min)},
      {"high", format_number(network.current_max)},
      {"range", c_number(network.current_max - network.current_min)},
      {"version", options.version},
      {"size", std::to_string(model.state_size())},
      {"sample_time", c_number(sample_time)},
      {"steps", std::to_string(kTestSteps)},
      {"tolerance", options.precision == CPrecision::Single ? "1e-5" : "1e-12"},
      {"rows", rows_of(model, inverse.domain)}};
  const auto finished = [&](const std::string& text) {
    return filled(with_prefix(in_precision(filled(text, values), options.precision.value_or(CPrecision::Double)), prefix),
                  {{"command", in_comment(options.command)}});
  };
  return {{prefix + ".h", finished(kHeader + std::string(c_text("inverse_api.h")) + kHeaderEnd)},
          {prefix + ".c", finished("#include \"@prefix@.h\"\n\n#include <math.h>\n\n" + code +
                                   std::string(c_text("inverse_api.c")))},
          {prefix + "_test.c", finished(kTest)}};
}

}  // namespace dashpot
