#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/export_run.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {
namespace {

constexpr std::size_t kReferenceSteps = 500;

constexpr const char* kCoSimulation =
    "Any communication step up to a million sample times is accepted. Between communication points "
    "the inputs are taken as "
    "linear, and steps longer than the sample time are made of several. A step ends with the "
    "inputs that are set after fmi2DoStep or fmi3DoStep and before the force is read; when none "
    "are set, with those of its start. So an importer that sets the inputs of an instant before it "
    "reads the force of that instant gets exactly the force of Dashpot, and one that reads first "
    "gets the force for inputs held over the step.";

constexpr const char* kExchange =
    "For model exchange the states and their slopes are exposed; there are no events. The model "
    "starts as after a long rest at the inputs' start values. Some laws are stiff: prefer an "
    "implicit solver.";

double extent(double low, double high) { return std::max(std::abs(low), std::abs(high)); }

void add_ports(const ExportedModel& model, Fmu& fmu) {
  const Domain& d = model.domain;
  const bool volts = model.drive_unit == DriveUnit::Volt;
  auto& list = fmu.variables;

  // Nominal values: the largest of the domain; the force's follows from the run.
  list.push_back({.name = "s",
                  .unit = "m",
                  .meaning = "displacement of the damper, extension positive",
                  .nominal = extent(d.displacement_min, d.displacement_max)});
  list.push_back({.name = "v",
                  .unit = "m/s",
                  .meaning = "its velocity, extension positive",
                  .nominal = extent(d.velocity_min, d.velocity_max)});
  list.push_back({.name = volts ? "u" : "i",
                  .unit = unit_of(model.drive_unit),
                  .meaning = volts ? "voltage commanded" : "current commanded to the coil",
                  .nominal = extent(d.current_min, d.current_max)});
  list.push_back({.role = FmuRole::Output,
                  .name = "f",
                  .unit = "N",
                  .meaning = "force, positive when it resists extension"});
}

/// The unit of a state's slope by time.
std::string rate_unit(const std::string& unit) {
  if (unit == "1") return "1/s";
  return unit == "m/s" ? "m/s^2" : unit + "/s";
}

void add_states(const std::vector<CSource::Variable>& states, const std::vector<double>& sizes,
                Fmu& fmu) {
  // All states, then all their slopes, in the same order.
  const std::size_t first = fmu.variables.size();
  for (std::size_t k = 0; k < states.size(); ++k)
    fmu.variables.push_back({.role = FmuRole::State,
                             .name = "state." + states[k].name,
                             .unit = states[k].unit,
                             .meaning = states[k].meaning,
                             .nominal = sizes[k]});
  for (std::size_t k = 0; k < states.size(); ++k)
    fmu.variables.push_back({.role = FmuRole::Derivative,
                             .name = "der(state." + states[k].name + ")",
                             .unit = rate_unit(states[k].unit),
                             .meaning = "its slope by time",
                             .nominal = sizes[k],
                             .derivative_of = first + k});
}

void add_parameters(const std::vector<CParameter>& parameters, Fmu& fmu) {
  for (const CParameter& parameter : parameters)
    fmu.variables.push_back({.role = FmuRole::Parameter,
                             .name = "parameter." + parameter.name,
                             .unit = parameter.unit,
                             .meaning = parameter.meaning,
                             .start = parameter.value,
                             .lower = parameter.lower,
                             .upper = parameter.upper,
                             .nominal = std::abs(parameter.value)});
}

/// The force along its reference run, and the largest of each number of the state on the way.
std::vector<double> run_along(const DamperModel& model, Fmu& fmu, const Domain& domain) {
  const std::vector<DamperInput> inputs = export_run(domain, fmu.sample_time, kReferenceSteps + 1);
  std::vector<double> sizes(model.state_size()), state(model.state_size());
  model.rest(inputs[0], state);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    if (k > 0) model.advance(inputs[k - 1], inputs[k], fmu.sample_time, state);
    for (std::size_t i = 0; i < state.size(); ++i)
      sizes[i] = std::max(sizes[i], std::abs(state[i]));
    fmu.run.push_back({inputs[k].displacement, inputs[k].velocity, inputs[k].current,
                       model.force(inputs[k], state)});
  }
  return sizes;
}

void describe(const ExportedModel& model, Fmu& fmu) {
  const ModelInfo info = info_of(model.model);
  fmu.title = info.title;
  fmu.equation = info.equation;
  fmu.origin = model.origin;
  fmu.remarks = {"Source: " + std::string(info.source) + ".", std::string(info.remarks),
                 known_text(model.domain, model.drive_unit)};
  fmu.steps = {kCoSimulation};
  if (fmu.grid > 0)
    fmu.steps.push_back(
        "The model remembers at steps of " + format_number(fmu.grid) +
        " s; in between its memory is held. Communication points on that grid are the exact "
        "ones.");
  if (fmu.exchanges) fmu.steps.emplace_back(kExchange);
}

}  // namespace

Fmu model_fmu(const ExportedModel& model, const ExportOptions& options) {
  // FMI's numbers are double, and its parameters may be set.
  ExportOptions own = options;
  own.precision = CPrecision::Double;
  own.settable_parameters = true;
  own.name = "damper";
  const CSource source = c_source(model, own);
  const std::size_t size = std::max<std::size_t>(1, source.state_size);

  // A law is known by its derivatives, a model without a state by itself: either can be exchanged.
  Fmu fmu{.name = export_name(model, options),
          .code = {{"damper.h", source.header}, {"damper.c", source.source}},
          .interface = "fmu_damper.h",
          .definitions = "#define FMU_STATE_SIZE " + std::to_string(size) + "\n",
          .first_parameter = source.first_parameter,
          .exchanges = model.model.state_size() == 0 || !source.states.empty(),
          .sample_time = source.sample_time,
          .grid = source.grid};

  // The variables, in the order in which c/fmu.h numbers them.
  const std::vector<double> sizes = run_along(model.model, fmu, model.domain);
  add_ports(model, fmu);
  add_states(source.states, sizes, fmu);
  add_parameters(source.parameters, fmu);
  describe(model, fmu);
  return fmu;
}

}  // namespace dashpot
