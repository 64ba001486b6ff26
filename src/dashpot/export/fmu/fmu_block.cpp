#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {
namespace {

/// The functions that fmu_block.h asks of a block.
constexpr const char* kDefinitions = R"(
static void fmu_read(const double* row, damper_input* input) {
@reads@}

static damper_model fmu_sample(damper_model model, const double* row, double* commands) {
  damper_input input;
  fmu_read(row, &input);
  @step@
  return model;
}
)";

constexpr const char* kSteps =
    "A sample is taken where initialization ends, with the inputs that are set by then, and every "
    "@time@ s from there on; in between the commands are held. Any communication step is accepted. "
    "At a communication point that is a sample's instant the sample sees the inputs that are set "
    "after fmi2DoStep or fmi3DoStep and before the commands are read; when none are set, those of "
    "the step's start. Samples within a step see inputs that are linear between its ends. So an "
    "importer that sets the inputs of an instant before it reads the commands of that instant gets "
    "exactly those of Dashpot.";

/// One variable for each of a port: "deflection", or "deflection[1]", "deflection[2]".
void add_variables(const std::vector<CPort>& ports, FmuRole role, Fmu& fmu) {
  for (const CPort& port : ports)
    if (port.count == 1)
      fmu.variables.push_back(
          {.role = role, .name = port.name, .unit = port.unit, .meaning = port.meaning});
    else
      for (std::size_t k = 0; k < port.count; ++k)
        fmu.variables.push_back({.role = role,
                                 .name = port.name + '[' + std::to_string(k + 1) + ']',
                                 .unit = port.parts[k].unit,
                                 .meaning = port.parts[k].name + ": " + port.meaning});
}

}  // namespace

Fmu block_fmu(const CBlock& block, const ExportOptions& options) {
  Fmu fmu{.name = block.name,
          .code = c_block_sources(block, "damper", options.command),
          .interface = "fmu_block.h",
          .definitions = filled(kDefinitions, {{"reads", CText::own(c_block_reads(block))},
                                               {"step", CText::own(block.step)}}),
          .sampled = true,
          .sample_time = block.sample_time,
          .grid = block.sample_time,
          .title = block.title,
          .origin = block.about,
          .steps = {filled(kSteps, {{"time", CText::own(format_number(block.sample_time))}})}};

  // Its variables, and the run that a test of the FMU can repeat.
  add_variables(block.inputs, FmuRole::Input, fmu);
  add_variables(block.commands, FmuRole::Output, fmu);
  for (const CBlock::Sample& sample : block.samples) {
    fmu.run.push_back(sample.inputs);
    fmu.run.back().insert(fmu.run.back().end(), sample.commands.begin(), sample.commands.end());
  }
  return fmu;
}

}  // namespace dashpot
