#include <algorithm>

#include "dashpot/output/exporters/c_text.h"
#include "dashpot/output/exporters/fmu.h"

namespace dashpot {
namespace {

/// What c/fmu.h asks of a damper.
constexpr const char* kHeader = R"(/* The damper of this FMU. Made by @tool@. */
#ifndef FMU_MODEL_H
#define FMU_MODEL_H

#include "@name@.h"

#define FMU_TOKEN "@token@"
#define FMU_EXCHANGES @exchanges@ /* whether model exchange is possible */
#define FMU_STATES @states@ /* continuous ones, the first of the state */
#define FMU_STATE_SIZE @size@
#define FMU_PARAMETERS @parameters@
#define FMU_FIRST_PARAMETER @first_parameter@ /* in the state */
#define FMU_SAMPLE_TIME @sample_time@ /* s */

typedef @name@_input FmuInput;

/* By value reference. */
static const char* const fmu_names[] = {
@names@};
static const double fmu_nominals[] = @nominals@;

/* Of the parameters; the last row is unused. */
static const double fmu_ranges[][2] = {
@ranges@    {0.0, 0.0}};

static void fmu_defaults(double* state) { @defaults@; }

static void fmu_rest(const FmuInput* input, double* state) { @name@_rest(input, state); }

static void fmu_move(const FmuInput* from, const FmuInput* to, double dt, double* state) {
  @name@_move(from, to, dt, state);
}

static double fmu_force(const FmuInput* input, const double* state) { return @name@_force(input, state); }

static void fmu_derivatives(const FmuInput* input, const double* state, double* derivatives) {
  @derivatives@;
}

#endif
)";

constexpr const char* kNoDerivatives = "(void)input;\n  (void)state;\n  (void)derivatives";

/// C has no number for infinity.
std::string bound(double value) {
  return std::isfinite(value) ? c_number(value) : value > 0 ? "HUGE_VAL" : "-HUGE_VAL";
}

std::string model_header(const Fmu& fmu) {
  const std::string& name = fmu.source.prefix;
  const std::size_t parameters = fmu.source.parameters.size();
  std::string names, ranges;
  std::vector<double> nominals;
  for (const FmuVariable& variable : fmu.variables) {
    names += "    \"" + variable.name + "\",\n";
    nominals.push_back(variable.nominal);
    if (variable.role == FmuVariable::Role::Parameter)
      ranges += "    {" + bound(variable.lower) + ", " + bound(variable.upper) + "},\n";
  }
  return filled(kHeader, {{"tool", fmu.tool},
                          {"name", name},
                          {"token", fmu.token},
                          {"exchanges", fmu.exchanges() ? "1" : "0"},
                          {"states", std::to_string(fmu.source.states.size())},
                          {"size", std::to_string(std::max<std::size_t>(1, fmu.source.state_size))},
                          {"parameters", std::to_string(parameters)},
                          {"first_parameter", std::to_string(fmu.source.first_parameter)},
                          {"sample_time", c_number(fmu.source.sample_time)},
                          {"names", names},
                          {"nominals", c_numbers(nominals)},
                          {"ranges", ranges},
                          {"defaults", parameters > 0 ? name + "_defaults(state)" : "(void)state"},
                          {"derivatives", fmu.source.states.empty()
                                              ? kNoDerivatives
                                              : name + "_derivatives(input, state, derivatives)"}});
}

}  // namespace

std::vector<ExportedFile> fmu_sources(const Fmu& fmu) {
  std::vector<ExportedFile> files{{fmu.source.prefix + ".h", fmu.source.header},
                                  {fmu.source.prefix + ".c", fmu.source.source},
                                  {"fmu_model.h", model_header(fmu)}};
  std::vector<std::string> texts{"fmu.h", "fmu_run.h", "fmu_snapshot.h", "fmu_derivative.h"};
  if (fmu.version == 2)
    texts.emplace_back("fmi2.c");
  else
    texts.insert(texts.end(), {"fmi3_types.h", "fmi3_absent.h", "fmi3.c"});
  for (const std::string& text : texts) files.push_back({text, std::string(c_text(text))});
  return files;
}

std::vector<std::string> fmu_translation_units(const Fmu& fmu) {
  return {fmu.source.prefix + ".c", fmu.version == 2 ? "fmi2.c" : "fmi3.c"};
}

}  // namespace dashpot
