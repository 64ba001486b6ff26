#include "dashpot/export/c/c_source.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_rewrite.h"
#include "dashpot/export/export_run.h"

namespace dashpot {
namespace {

constexpr std::size_t kDamperTestSteps = 200;

constexpr const char* kDamperHeader = R"(/* @title@.
 *
 * @what@
 * Inputs: displacement m and velocity m/s, extension positive; command @unit@. Output: force N,
 * positive when it resists extension. Known for displacements @x_min@ ... @x_max@ m,
 * velocities @v_min@ ... @v_max@ m/s, commands @i_min@ ... @i_max@ @unit@; beyond, the model
 * extrapolates.
 *
 *   damper_model model;
@defaults_first@ *   damper_reset(&model, &input);
 *   for (;;) force = damper_step(&model, &input);
 *
 * C99 with math.h: no heap, no files, no variables outside a damper_model.
 * Made by Dashpot @version@:
 *   @command@
 * MISRA C:2012, deviations: @deviations@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_STATE_SIZE @size@ /* numbers in the state@unused@ */
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, of damper_step */

)";

constexpr const char* kDerivatives = R"(
/* Time derivatives of the state, for a simulator that integrates it; the input's own slope is not
 * needed. */
void damper_derivatives(const damper_input* input, const double* state, double* derivatives);
)";

constexpr const char* kDefaults = R"(
/* Writes the parameters, which stand behind the state, as they were identified; call it before
 * anything else. */
void damper_defaults(double* state);
)";

constexpr const char* kSourceBegin = R"(
#include <math.h>

typedef damper_input DamperInput;

)";

constexpr const char* kDefaultsFunction = R"(
void damper_defaults(double* state) { model_defaults(state); }
)";

constexpr const char* kDerivativesFunction = R"(
void damper_derivatives(const damper_input* input, const double* state, double* derivatives) {
  model_derivatives(input, state, derivatives);
}
)";

constexpr const char* kDamperTest =
    R"(/* Steps through a run and compares the force with the one that Dashpot @version@ computed in
 * double precision. Returns 0 when they agree within @tolerance@ of the force's span. */
#include "@prefix@.h"

#include <math.h>
#include <stdio.h>

#define STEPS @steps@

/* displacement m, velocity m/s, command, force N */
static const double kRun[STEPS][4] = {
@rows@};

int main(void) {
  damper_model model;
  double largest = 0.0, low = kRun[0][3], high = kRun[0][3];
  int k;
  for (k = 0; k < STEPS; ++k) {
    const damper_input input = {kRun[k][0], kRun[k][1], kRun[k][2]};
    double force;
    if (k == 0) {
@defaults@      damper_reset(&model, &input);
      force = damper_force(&input, model.state);
    } else {
      force = damper_step(&model, &input);
    }
    largest = fmax(largest, fabs(force - kRun[k][3]));
    low = fmin(low, kRun[k][3]);
    high = fmax(high, kRun[k][3]);
  }
  printf("largest difference %g N, span of the force %g N\n", (double)largest,
         (double)(high - low));
  return (largest <= @tolerance@ * (high - low)) ? 0 : 1;
}
)";

std::string rows_of(const ExportedModel& model, double sample_time) {
  const std::vector<DamperInput> run = export_run(model.domain, sample_time, kDamperTestSteps);
  const std::vector<double> force = force_along(model.model, run, sample_time);
  std::string rows;
  for (std::size_t k = 0; k < run.size(); ++k)
    rows += "    " +
            c_numbers(std::vector{run[k].displacement, run[k].velocity, run[k].current, force[k]}) +
            ",\n";
  return rows;
}

/// The places that only the C files have, besides common_facts.
Facts facts_of(const ExportedModel& model, const ExportOptions& options, const CSource& source) {
  Facts facts = common_facts(model, options, source);
  facts.insert(
      facts.end(),
      {{"title", c_comment(title_of(model.model))},
       {"unit", CText::own(unit_of(model.drive_unit))},
       {"prefix", CText::own(source.prefix)},
       {"deviations", CText::own(std::string(c_deviations()))},
       {"size", CText::own(std::to_string(std::max<std::size_t>(1, source.state_size)))},
       {"unused", CText::own(source.state_size == 0 ? ": one that is not used" : "")},
       {"steps", CText::own(std::to_string(kDamperTestSteps))},
       {"tolerance", CText::own(options.c_precision() == CPrecision::Single ? "1e-5" : "1e-12")}});
  return facts;
}

std::vector<CSource::Variable> states_of(const DamperModel& model) {
  std::vector<CSource::Variable> states;
  if (const auto* law = model_as<LawModel>(model)) {
    for (const StateInfo& state : law->law().states)
      states.push_back(
          {std::string(state.name), std::string(state.unit), "internal state of the law"});
    if (law->lag_rate() > 0)
      states.push_back({"coil_current", unit_of(law->drive_unit()),
                        law->drive_unit() == DriveUnit::Volt ? "voltage as it acts, behind its lag"
                                                             : "current in the coil"});
  }
  return states;
}

/// The names of parameters as macros end with them: in capitals, but where two would be alike (`a`
/// and `A`) as they are.
std::vector<std::string> macro_names(const std::vector<CParameter>& parameters) {
  std::vector<std::string> capitals, names;
  for (const CParameter& parameter : parameters) {
    std::string& name = capitals.emplace_back(parameter.name);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  }
  for (std::size_t k = 0; k < parameters.size(); ++k)
    names.push_back(std::ranges::count(capitals, capitals[k]) == 1 ? capitals[k]
                                                                   : parameters[k].name);
  return names;
}

}  // namespace

std::string title_of(const DamperModel& model) {
  if (const auto* law = model_as<LawModel>(model)) return std::string(law->law().title);
  for (const std::vector<std::string>& names : {model_names(), more_model_names()})
    if (std::ranges::find(names, model.name()) != names.end())
      return std::string(model_info(model.name()).title);
  return model.name();
}

std::string known_text(const Domain& d, DriveUnit drive_unit) {
  const auto span = [](double low, double high, const std::string& unit) {
    return format_number(low) + " ... " + format_number(high) + " " + unit;
  };
  return "Known for displacements " + span(d.displacement_min, d.displacement_max, "m") +
         ", velocities " + span(d.velocity_min, d.velocity_max, "m/s") + " and commands " +
         span(d.current_min, d.current_max, unit_of(drive_unit)) + "; beyond, it extrapolates.";
}

std::string damper_origin(const ExportedModel& damper) {
  return "Of its damper: " + damper.origin + ". " + known_text(damper.domain, damper.drive_unit);
}

Facts common_facts(const ExportedModel& model, const ExportOptions& options,
                   const CSource& source) {
  const Domain& d = model.domain;
  return {{"x_min", CText::own(format_number(d.displacement_min))},
          {"x_max", CText::own(format_number(d.displacement_max))},
          {"v_min", CText::own(format_number(d.velocity_min))},
          {"v_max", CText::own(format_number(d.velocity_max))},
          {"i_min", CText::own(format_number(d.current_min))},
          {"i_max", CText::own(format_number(d.current_max))},
          {"sample_time", CText::own(c_number(source.sample_time))},
          {"version", c_comment(options.version)}};
}

CSource c_source(const ExportedModel& model, const ExportOptions& options) {
  const bool settable = options.settable_parameters && has_settable(model.model);
  const CModel code = c_model(model.model, settable);

  // The facts that a program around the code must know.
  CSource source{
      .prefix = export_name(model, options),
      .real = options.c_precision() == CPrecision::Single ? "float" : "double",
      .state_size = model.model.state_size(),
      .inputs = {{"displacement", "m", "extension positive"},
                 {"velocity", "m/s", "extension positive"},
                 {"current", unit_of(model.drive_unit), "command to the coil"}},
      .outputs = {{"force", "N", "positive when it resists extension"}},
      .states = code.has_derivatives ? states_of(model.model) : std::vector<CSource::Variable>{},
      .sample_time = export_sample_time(model, options),
      .grid = model.model.feedback_step()};
  if (settable) {
    const auto* law = model_as<LawModel>(model.model);
    source.parameters = c_parameters(model.model);
    source.first_parameter = source.state_size;
    source.state_size += source.parameters.size() + (law && law->lag_rate() <= 0 ? 1 : 0);
  }

  // The header: what comes from the user is filled in last, so that nothing rewrites it.
  const auto finished = [&](const std::string& text) {
    return with_prefix(in_precision(text, options.c_precision()), source.prefix);
  };
  Facts facts = facts_of(model, options, source);
  facts.emplace_back("defaults_first",
                     CText::own(settable ? " *   damper_defaults(model.state);\n" : ""));
  source.header =
      filled(finished(filled(kDamperHeader, facts) + std::string(c_text("damper_api.h")) +
                      (code.has_derivatives ? kDerivatives : "") + (settable ? kDefaults : "") +
                      kCHeaderEnd),
             {{"what", c_comment(model.origin)}, {"command", c_comment(options.command)}});

  // The source: the model's own functions, then those of the interface, which call them.
  const std::string own = with_texts(code.code);
  require_free_names(source.prefix, own);
  source.source =
      finished("#include \"" + source.prefix + ".h\"\n" + kSourceBegin + own +
               std::string(c_text("damper_api.c")) + (settable ? kDefaultsFunction : "") +
               (code.has_derivatives ? kDerivativesFunction : ""));

  facts.emplace_back("defaults",
                     CText::own(settable ? "      damper_defaults(model.state);\n" : ""));

  // The test: a run with the forces that the library gives.
  facts.emplace_back("rows", CText::own(rows_of(model, source.sample_time)));
  source.test = finished(filled(kDamperTest, facts));
  return source;
}

std::vector<ExportedFile> write_c_source(const ExportedModel& model, const ExportOptions& options) {
  CSource source = c_source(model, options);

  // Where each parameter that may be set stands.
  if (!source.parameters.empty()) {
    std::string places = "\n/* Parameters, as state[...]; they may be set between two steps. */\n";
    const std::vector<std::string> names = macro_names(source.parameters);
    for (std::size_t k = 0; k < source.parameters.size(); ++k) {
      const CParameter& parameter = source.parameters[k];
      places +=
          "#define DAMPER_PARAMETER_" + names[k] + " " +
          std::to_string(source.first_parameter + k) + " /* " + parameter.unit + ", " +
          c_comment(parameter.meaning).text() +
          (std::isfinite(parameter.lower) && std::isfinite(parameter.upper)
               ? "; " + format_number(parameter.lower) + " ... " + format_number(parameter.upper)
               : "") +
          " */\n";
    }
    source.header.insert(source.header.rfind("\n#ifdef __cplusplus\n}"),
                         with_prefix(places, source.prefix));
  }
  return {{source.prefix + ".h", source.header},
          {source.prefix + ".c", source.source},
          {source.prefix + "_test.c", source.test}};
}

}  // namespace dashpot
