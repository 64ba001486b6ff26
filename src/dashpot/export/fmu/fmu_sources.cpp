#include "dashpot/base/escape.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {
namespace {

/// The definitions that fmu.h asks of whatever is at work.
constexpr const char* kHeader =
    R"(/* The model, controller or inverse of this FMU. Made by @tool@. */
#ifndef FMU_MODEL_H
#define FMU_MODEL_H

#include "damper.h"

#define FMU_TOKEN "@token@"
#define FMU_EXCHANGES @exchanges@ /* whether model exchange is possible */
#define FMU_DIFFERENTIABLE @differentiable@
#define FMU_INPUTS @inputs@
#define FMU_OUTPUTS @outputs@
#define FMU_STATES @states@ /* continuous ones, the first of the state */
#define FMU_PARAMETERS @parameters@
#define FMU_FIRST_PARAMETER @first_parameter@ /* in the state */
#define FMU_SAMPLE_TIME @sample_time@ /* s */

/* By value reference. */
static const char* const fmu_names[] = {
@names@};
static const double fmu_nominals[] = @nominals@;

/* The limits of the parameters; the last row is unused. */
static const double fmu_ranges[][2] = {
@ranges@    {0.0, 0.0}};

@definitions@
#include "@interface@"

#endif
)";

/// C has no number for infinity.
std::string bound(double value) {
  return std::isfinite(value) ? c_number(value) : value > 0 ? "HUGE_VAL" : "-HUGE_VAL";
}

std::string model_header(const Fmu& fmu) {
  std::string names, ranges;
  std::vector<double> nominals;
  for (const FmuVariable& variable : fmu.variables) {
    names += "    " + c_string(variable.name).text() + ",\n";
    nominals.push_back(variable.nominal);
    if (variable.role == FmuRole::Parameter)
      ranges += "    {" + bound(variable.lower) + ", " + bound(variable.upper) + "},\n";
  }

  const auto count = [&](FmuRole role) { return std::to_string(fmu.count(role)); };
  return filled(kHeader, {{"tool", c_comment(fmu.tool)},
                          {"token", CText::own(fmu.token)},
                          {"exchanges", CText::own(fmu.exchanges ? "1" : "0")},
                          {"differentiable", CText::own(fmu.sampled ? "0" : "1")},
                          {"inputs", CText::own(count(FmuRole::Input))},
                          {"outputs", CText::own(count(FmuRole::Output))},
                          {"states", CText::own(count(FmuRole::State))},
                          {"parameters", CText::own(count(FmuRole::Parameter))},
                          {"first_parameter", CText::own(std::to_string(fmu.first_parameter))},
                          {"sample_time", CText::own(c_number(fmu.sample_time))},
                          {"names", CText::own(names)},
                          {"nominals", CText::own(c_numbers(nominals))},
                          {"ranges", CText::own(ranges)},
                          {"definitions", CText::own(fmu.definitions)},
                          {"interface", CText::own(fmu.interface)}});
}

}  // namespace

std::vector<ExportedFile> fmu_sources(const Fmu& fmu) {
  std::vector<ExportedFile> files = fmu.code;
  files.push_back({"fmu_model.h", model_header(fmu)});
  std::vector<std::string> texts{"fmu.h",     "fmu_between.h",  fmu.interface,
                                 "fmu_run.h", "fmu_snapshot.h", "fmu_derivative.h"};
  if (fmu.version == 2)
    texts.emplace_back("fmi2.c");
  else
    texts.insert(texts.end(), {"fmi3_types.h", "fmi3_absent.h", "fmi3.c"});
  for (const std::string& text : texts) files.push_back({text, std::string(c_text(text))});
  return files;
}

std::vector<std::string> fmu_translation_units(const Fmu& fmu) {
  return {"damper.c", fmu.version == 2 ? "fmi2.c" : "fmi3.c"};
}

}  // namespace dashpot
