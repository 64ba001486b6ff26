#include "dashpot/output/exporters/fmu.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>

#include <fmt/chrono.h>

#include "dashpot/base/error.h"
#include "dashpot/base/file.h"
#include "dashpot/damper/registry.h"
#include "dashpot/output/exporters/export_run.h"

namespace dashpot {
namespace {

using Role = FmuVariable::Role;

constexpr std::size_t kReferenceSteps = 500;
constexpr std::size_t kFirstState = 5;  // a value reference: as c/fmu.h has it

/// SOURCE_DATE_EPOCH, by which builds are made reproducible, or now.
std::time_t time_of_making() {
  const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
  if (!fixed || *fixed == '\0') return std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const std::string_view text = fixed;
  std::time_t seconds = 0;
  const auto [end, problem] = std::from_chars(text.begin(), text.end(), seconds);
  if (problem != std::errc{} || end != text.end())
    throw Error("SOURCE_DATE_EPOCH", "is '" + std::string(text) + "'", "write seconds since 1970");
  return seconds;
}

double extent(double low, double high) {
  const double most = std::max(std::abs(low), std::abs(high));
  return most > 0 ? most : 1;
}

/// The largest of each number of the state and of the force along a run: what is usual for them.
struct Sizes {
  std::vector<double> state;
  double force = 0;
};

Sizes sizes_along(const DamperModel& model, const Fmu& fmu) {
  Sizes sizes{std::vector<double>(model.state_size()), 0};
  std::vector<double> state(model.state_size());
  model.rest(fmu.run.front(), state);
  for (std::size_t k = 1; k < fmu.run.size(); ++k) {
    model.advance(fmu.run[k - 1], fmu.run[k], fmu.source.sample_time, state);
    for (std::size_t i = 0; i < state.size(); ++i)
      sizes.state[i] = std::max(sizes.state[i], std::abs(state[i]));
    sizes.force = std::max(sizes.force, std::abs(fmu.force[k]));
  }
  return sizes;
}

/// One significant digit: what is usual need not be said more exactly.
double rounded(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  return std::strtod(fmt::format("{:.0e}", value).c_str(), nullptr);
}

void add_ports(const ExportedModel& model, double usual_force, Fmu& fmu) {
  const Domain& d = model.domain;
  const bool volts = model.drive_unit == "V";
  auto& list = fmu.variables;
  list.push_back({.role = Role::Time, .name = "time", .unit = "s", .meaning = "simulation time"});
  list.push_back({.name = "s",
                  .unit = "m",
                  .meaning = "displacement of the damper, extension positive",
                  .nominal = rounded(extent(d.displacement_min, d.displacement_max))});
  list.push_back({.name = "v",
                  .unit = "m/s",
                  .meaning = "its velocity, extension positive",
                  .nominal = rounded(extent(d.velocity_min, d.velocity_max))});
  list.push_back({.name = volts ? "u" : "i",
                  .unit = model.drive_unit,
                  .meaning = volts ? "voltage commanded" : "current commanded to the coil",
                  .nominal = rounded(extent(d.current_min, d.current_max))});
  list.push_back({.role = Role::Output,
                  .name = "f",
                  .unit = "N",
                  .meaning = "force, positive when it resists extension",
                  .nominal = rounded(usual_force)});
}

/// A state's unit by time.
std::string rate_unit(const std::string& unit) {
  if (unit == "1") return "1/s";
  return unit == "m/s" ? "m/s^2" : unit + "/s";
}

void add_states(const std::vector<double>& sizes, Fmu& fmu) {
  const auto& states = fmu.source.states;
  for (std::size_t k = 0; k < states.size(); ++k)
    fmu.variables.push_back({.role = Role::State,
                             .name = "state." + states[k].name,
                             .unit = states[k].unit,
                             .meaning = states[k].meaning,
                             .nominal = rounded(sizes[k])});
  for (std::size_t k = 0; k < states.size(); ++k)
    fmu.variables.push_back({.role = Role::Derivative,
                             .name = "der(state." + states[k].name + ")",
                             .unit = rate_unit(states[k].unit),
                             .meaning = "its slope by time",
                             .nominal = fmu.variables[kFirstState + k].nominal,
                             .derivative_of = kFirstState + k});
}

void add_parameters(Fmu& fmu) {
  for (const CParameter& parameter : fmu.source.parameters)
    fmu.variables.push_back({.role = Role::Parameter,
                             .name = "parameter." + parameter.name,
                             .unit = parameter.unit,
                             .meaning = parameter.meaning,
                             .start = parameter.value,
                             .lower = parameter.lower,
                             .upper = parameter.upper,
                             .nominal = rounded(std::abs(parameter.value))});
}

/// 8-4-4-4-12 hexadecimal digits in braces, from all that the FMU is but its date.
std::string token_of(const Fmu& fmu) {
  Fmu undated = fmu;
  undated.token = undated.date = "";
  std::string all = fmu.version == 2 ? fmi2_description(undated) : fmi3_description(undated);
  for (const ExportedFile& file : fmu_sources(undated)) all += file.content;
  const std::string hash = sha256(all);
  return '{' + hash.substr(0, 8) + '-' + hash.substr(8, 4) + '-' + hash.substr(12, 4) + '-' +
         hash.substr(16, 4) + '-' + hash.substr(20, 12) + '}';
}

std::vector<ExportedFile> write_fmu(const ExportedModel& model, const ExportOptions& options, int version) {
  const Fmu fmu = make_fmu(model, options, version);
  std::vector<ExportedFile> files{
      {"modelDescription.xml", version == 2 ? fmi2_description(fmu) : fmi3_description(fmu)},
      {"documentation/index.html", fmu_page(fmu)}};
  const std::string results = "extra/org.fmi-standard.fmi-ls-ref/";
  files.push_back({results + "fmi-ls-manifest.xml", fmu_reference_manifest(fmu)});
  files.push_back({results + fmu.name + "_out.csv", fmu_reference_run(fmu)});
  const std::vector<ExportedFile> sources = fmu_sources(fmu);
  for (const ExportedFile& file : sources) files.push_back({"sources/" + file.name, file.content});
  if (version == 3) files.push_back({"sources/buildDescription.xml", fmu_build_description(fmu)});
  if (!options.sources_only)
    files.push_back(
        {std::string("binaries/") + (version == 2 ? "linux64/" : "x86_64-linux/") + fmu.name + ".so",
         compile_shared_library(sources, fmu_translation_units(fmu), options.compiler)});
  return {{fmu.name + (version == 2 ? "_fmi2.fmu" : "_fmi3.fmu"), zip_archive(files, fmu.made)}};
}

}  // namespace

Fmu make_fmu(const ExportedModel& model, const ExportOptions& options, int version) {
  ExportOptions own = options;
  own.precision = CPrecision::Double;
  own.settable_parameters = true;
  own.name = "damper";
  const ModelInfo info = model_info(model.model.name());
  Fmu fmu{.version = version,
          .name = export_name(model, options),
          .source = c_source(model, own),
          .made = time_of_making(),
          .title = std::string(info.title),
          .equation = std::string(info.equation),
          .remarks = std::string(info.remarks),
          .literature = std::string(info.source),
          .origin = model.origin,
          .command = options.command,
          .tool = "Dashpot " + options.version,
          .domain = model.domain};
  fmu.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(fmu.made));
  fmu.run = export_run(model.domain, fmu.source.sample_time, kReferenceSteps + 1);
  fmu.force = force_along(model.model, fmu.run, fmu.source.sample_time);
  const Sizes sizes = sizes_along(model.model, fmu);
  add_ports(model, sizes.force, fmu);
  add_states(sizes.state, fmu);
  add_parameters(fmu);
  fmu.token = token_of(fmu);
  return fmu;
}

std::vector<ExportedFile> write_fmu2(const ExportedModel& model, const ExportOptions& options) {
  return write_fmu(model, options, 2);
}

std::vector<ExportedFile> write_fmu3(const ExportedModel& model, const ExportOptions& options) {
  return write_fmu(model, options, 3);
}

}  // namespace dashpot
