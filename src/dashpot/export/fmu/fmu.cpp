#include "dashpot/export/fmu/fmu.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>

#include <fmt/chrono.h>

#include "dashpot/base/file.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// SOURCE_DATE_EPOCH, by which builds are made reproducible, or now.
std::time_t time_of_making() {
  const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
  if (!fixed || *fixed == '\0')
    return std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const std::string_view text = fixed;
  std::time_t seconds = 0;
  const auto [end, problem] = std::from_chars(text.begin(), text.end(), seconds);
  if (problem != std::errc{} || end != text.end())
    throw Error("SOURCE_DATE_EPOCH", "is '" + std::string(text) + "'", "write seconds since 1970");
  return seconds;
}

/// One significant digit: what is usual need not be said more exactly.
double rounded(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  return std::strtod(fmt::format("{:.0e}", value).c_str(), nullptr);
}

/// Fills in the nominal values that are still open: the largest along the run.
void size_variables(Fmu& fmu) {
  for (std::size_t k = 0; k < fmu.variables.size(); ++k) {
    double& nominal = fmu.variables[k].nominal;
    if (nominal == 0 && k > 0 && k <= fmu.run[0].size())
      for (const std::vector<double>& row : fmu.run)
        nominal = std::max(nominal, std::abs(row[k - 1]));
    nominal = rounded(nominal);
  }
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

/// For which binaries are compiled, each once.
std::vector<const FmuPlatform*> wanted_platforms(const ExportOptions& options) {
  if (options.sources_only) return {};
  if (options.platforms.empty()) return {&own_platform()};
  std::vector<const FmuPlatform*> wanted;
  for (const std::string& name : options.platforms)
    if (std::ranges::find(wanted, &find_platform(name)) == wanted.end())
      wanted.push_back(&find_platform(name));
  return wanted;
}

std::vector<ExportedFile> write_fmu(Fmu fmu, const ExportOptions& options, int version) {
  fmu.version = version;
  fmu.command = options.command;
  fmu.tool = "Dashpot " + options.version;
  fmu.made = time_of_making();
  fmu.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(fmu.made));
  size_variables(fmu);
  fmu.token = token_of(fmu);

  // The files at the places where FMI asks for them.
  std::vector<ExportedFile> files{
      {"modelDescription.xml", version == 2 ? fmi2_description(fmu) : fmi3_description(fmu)},
      {"documentation/index.html", fmu_page(fmu)}};
  const std::string results = "extra/org.fmi-standard.fmi-ls-ref/";
  files.push_back({results + "fmi-ls-manifest.xml", fmu_reference_manifest(fmu)});
  files.push_back({results + fmu.name + "_out.csv", fmu_reference_run(fmu)});

  // The sources, and what an importer that does not compile needs.
  const std::vector<ExportedFile> sources = fmu_sources(fmu);
  for (const ExportedFile& file : sources) files.push_back({"sources/" + file.name, file.content});
  if (version == 3) files.push_back({"sources/buildDescription.xml", fmu_build_description(fmu)});
  for (const FmuPlatform* platform : wanted_platforms(options))
    files.push_back(
        {fmt::format("binaries/{}/{}{}", version == 2 ? platform->fmi2 : platform->fmi3, fmu.name,
                     platform->ending),
         compile_shared_library(sources, fmu_translation_units(fmu), *platform, options.compiler)});
  return {{fmu.name + (version == 2 ? "_fmi2.fmu" : "_fmi3.fmu"), zip_archive(files, fmu.made)}};
}

/// FMI's numbers are double.
CBlock double_block(const CBlockMaker& block, ExportOptions options) {
  options.precision = CPrecision::Double;
  return block(options);
}

}  // namespace

std::size_t Fmu::count(FmuVariable::Role role) const {
  return static_cast<std::size_t>(std::ranges::count(variables, role, &FmuVariable::role));
}

std::vector<ExportedFile> write_fmu2(const ExportedModel& model, const ExportOptions& options) {
  return write_fmu(model_fmu(model, options), options, 2);
}

std::vector<ExportedFile> write_fmu3(const ExportedModel& model, const ExportOptions& options) {
  return write_fmu(model_fmu(model, options), options, 3);
}

std::vector<ExportedFile> write_fmu2_block(const CBlockMaker& block, const ExportOptions& options) {
  return write_fmu(block_fmu(double_block(block, options), options), options, 2);
}

std::vector<ExportedFile> write_fmu3_block(const CBlockMaker& block, const ExportOptions& options) {
  return write_fmu(block_fmu(double_block(block, options), options), options, 3);
}

}  // namespace dashpot
