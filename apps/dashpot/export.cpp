#include "dashpot/export.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "damper_choice.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/export/c/c_inverse.h"
#include "dashpot/export/c/c_model.h"
#include "export_control.h"

namespace dashpot::cli {
namespace {

struct ExportSettings {
  DamperChoice damper;
  VehicleChoice vehicle;
  std::vector<std::string> formats;
  std::string name, precision, sample_time, folder = "dashpot-export", compiler;
  bool sources_only = false, tunable = false;
};

constexpr std::string_view kExportExample =
    "# A fitted model for an ECU: one header, one source, and a test that checks them:\n"
    "dashpot export results/models/bouc_wen.json --to c --precision float --sample-time 1ms\n"
    "\n"
    "# A fitted model for a simulator, with a binary that needs nothing but the C library:\n"
    "dashpot export results/models/bouc_wen.json --to fmu3 -o results/fmu\n"
    "\n"
    "# A fitted model for ONNX Runtime:\n"
    "dashpot export results/models/hysteresis_network.json --to onnx\n"
    "\n"
    "# A published damper, under a name of your own:\n"
    "dashpot export --parameters spencer1997 --to c --name front_damper -o front\n"
    "\n"
    "# A controller for an ECU with the sensors of a car, from accelerometer to current:\n"
    "dashpot export --controller mix1,crossover=1.9Hz --in-car --to c --precision float "
    "--sample-time 2ms -o ecu\n"
    "\n"
    "# The current for a wanted force, and a skyhook that drives its damper by it:\n"
    "dashpot export --parameters spencer1997 --inverse numeric --to c -o ecu\n"
    "dashpot export --controller skyhook_modified --damper spencer1997 --inverse numeric --to c -o "
    "ecu";

std::vector<std::string> exporter_names() {
  std::vector<std::string> names;
  for (const Exporter& exporter : exporters()) names.emplace_back(exporter.name);
  return names;
}

std::string formats_text() {
  std::string text;
  for (const Exporter& exporter : exporters())
    text += fmt::format(" {}: {}, from {}; writes {}.", exporter.name, exporter.title,
                        exporter.takes, exporter.files);
  return text;
}

bool is_inverse(const std::string& path) {
  if (path.empty()) return false;
  const Value document = parse_json(read_file(path), path);
  const Value* format = document.kind() == Value::Kind::Object ? document.find("format") : nullptr;
  return format && format->kind() == Value::Kind::String &&
         format->as_string() == "dashpot-inverse";
}

std::optional<CPrecision> precision_of(const ExportSettings& settings) {
  if (settings.precision.empty()) return {};
  return settings.precision == "float" ? CPrecision::Single : CPrecision::Double;
}

/// Adds files but those that are there: several formats have C code.
void add(std::vector<ExportedFile> written, std::vector<ExportedFile>& files) {
  for (ExportedFile& file : written)
    if (std::ranges::find(files, file.name, &ExportedFile::name) == files.end())
      files.push_back(std::move(file));
}

std::vector<ExportedFile> damper_files(const ExportSettings& settings, const ExportOptions& options,
                                       Console& console) {
  const ModelFile file = load_damper_file(settings.damper, "export", console);
  const bool settable = has_settable(*file.model);
  if (settings.tunable && !settable)
    throw Error(settings.damper.model, "its code is of one damper: nothing in it can be set",
                "a law, or family_physics");

  // A family's code is of one damper, whose numbers an FMU may still set.
  const auto* family = model_as<FamilyModel>(*file.model);
  const bool all_fmus = std::ranges::all_of(
      settings.formats, [](const std::string& format) { return format.starts_with("fmu"); });
  if (family && !settings.tunable && !(settable && all_fmus))
    console.note("the code is of one damper of the family: " + describe(family->member()));
  std::vector<ExportedFile> files;
  for (const std::string& format : settings.formats)
    add(find_exporter(format, "--to").write(exported_model(file), options), files);
  return files;
}

/// Throws Error where one of the formats is of models alone; `what` was to become it.
void require_blocks(const ExportSettings& settings, const std::string& where,
                    const std::string& what) {
  std::vector<std::string> possible;
  for (const Exporter& exporter : exporters())
    if (exporter.write_block) possible.emplace_back(exporter.name);
  for (const std::string& format : settings.formats)
    if (!find_exporter(format, "--to").write_block)
      throw Error(where, "is " + what + ", which cannot become '" + format + "'",
                  "--to " + join(possible, ", "));
}

/// Null: what is named is a damper.
CBlockMaker chosen_block(const ExportSettings& settings, const ExportOptions& options,
                         Console& console) {
  const VehicleChoice& vehicle = settings.vehicle;

  // A controller takes its damper and sensors with it.
  if (!vehicle.controller.empty()) {
    require_blocks(settings, vehicle.controller, "a controller");
    return controller_block(vehicle, settings.damper, options, console);
  }

  // Without one, options of its vehicle would have no effect.
  for (const auto& [option, said] : {std::pair{"--damper", !vehicle.damper.empty()},
                                     {"--set", !vehicle.values.empty()},
                                     {"--in-car", vehicle.in_car}})
    if (said) throw UsageError(option, "goes with --controller");

  // An inverse network from a file, or the inverse of a damper by a scheme.
  if (is_inverse(settings.damper.model)) {
    require_blocks(settings, settings.damper.model, "an inverse");
    return [file = load_inverse(settings.damper.model)](const ExportOptions& own) {
      return c_inverse_block(file, own);
    };
  }

  if (vehicle.inverse.empty()) return nullptr;
  require_blocks(settings, vehicle.inverse, "an inverse");
  return scheme_block(vehicle, settings.damper, options, console);
}

std::vector<ExportedFile> exported_files(const ExportSettings& settings,
                                         const ExportOptions& options, Console& console) {
  const CBlockMaker block = chosen_block(settings, options, console);
  if (!block) return damper_files(settings, options, console);
  if (settings.tunable) throw UsageError("--tunable", "is of a damper's model", "leave it out");
  std::vector<ExportedFile> files;
  for (const std::string& format : settings.formats)
    add(find_exporter(format, "--to").write_block(block, options), files);
  return files;
}

void require_tunable_formats(const ExportSettings& settings) {
  if (!settings.tunable) return;
  for (const std::string& format : settings.formats)
    if (format != "c" && !format.starts_with("fmu"))
      throw UsageError("--tunable", "does not go with " + format,
                       "--to c; an FMU has its parameters tunable by itself");
}

int run_export(const ExportSettings& settings, Console& console) {
  if (settings.formats.empty())
    throw UsageError("--to", "is missing", "one or more of " + join(exporter_names(), ", "));
  if (settings.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  require_tunable_formats(settings);

  // The words of the command line as the exporters take them.
  const ExportOptions options{
      .name = settings.name,
      .precision = precision_of(settings),
      .sample_time = settings.sample_time.empty()
                         ? 0
                         : parse_quantity(settings.sample_time, "s", "--sample-time"),
      .settable_parameters = settings.tunable,
      .compiler = settings.compiler.empty() ? usual_compiler() : settings.compiler,
      .sources_only = settings.sources_only,
      .command = console.command_line(),
      .version = DASHPOT_VERSION};

  // All files are made before the first is written: an error leaves none behind.
  const std::vector<ExportedFile> files = exported_files(settings, options, console);
  Value list = Value::array();
  for (const ExportedFile& file : files) {
    const std::string path = (std::filesystem::path(settings.folder) / file.name).string();
    write_file(path, file.content);
    list.push_back(path);
    console.print(path + '\n');
  }

  if (console.json) console.print_json(Value::object({{"files", std::move(list)}}));
  return kDone;
}

}  // namespace

Command export_command() {
  auto settings = std::make_shared<ExportSettings>();
  std::vector<Option> options = damper_options(settings->damper);
  append(options, control_options(settings->vehicle));

  // The formats, and the code in them.
  append(options, {{.names = "--to",
                    .target = &settings->formats,
                    .help = "the formats to write",
                    .value = "FORMAT",
                    .choices = exporter_names(),
                    .noun = "format"},
                   {.names = "--name",
                    .target = &settings->name,
                    .help = "name of the files and of the functions in them",
                    .default_text = "the model's"},
                   {.names = "--precision",
                    .target = &settings->precision,
                    .help = "precision of the numbers in C or ONNX",
                    .value = "TYPE",
                    .choices = {"double", "float"},
                    .default_text = "double in C, float in ONNX"},
                   {.names = "--sample-time",
                    .target = &settings->sample_time,
                    .help = "time between two steps, as 1ms",
                    .value = "S",
                    .default_text = "that of the model's data, or 1 ms"},

                   {.names = "--tunable",
                    .target = &settings->tunable,
                    .help = "C whose parameters stand behind the state and may be set while it "
                            "runs: of a law, or of family_physics (gap, lengths, areas, viscosity, "
                            "yield stress, build); an FMU has them in any case"},

                   // The binary of an FMU.
                   {.names = "--compiler",
                    .target = &settings->compiler,
                    .help = "C compiler for the binary in an FMU, and more arguments for it",
                    .value = "CC",
                    .default_text = "$CC, or cc"},
                   {.names = "--sources-only",
                    .target = &settings->sources_only,
                    .help = "an FMU without a binary, for an importer that compiles"},

                   {.names = "-o,--output",
                    .target = &settings->folder,
                    .help = "folder for the files",
                    .value = "DIR",
                    .takes = Takes::Folder}});

  return {.name = "export",
          .title = "A model or a controller as code or tables for other programs",
          .description =
              "Writes a model in a form that no longer needs Dashpot. An inverse network that "
              "'dashpot invert' wrote, an inverse of a damper (--inverse) and a vehicle's "
              "controller (--controller) are exported, too, where a format takes them." +
              formats_text(),
          .options = std::move(options),
          .example = std::string(kExportExample),
          .run = [settings](Console& console) { return run_export(*settings, console); }};
}

}  // namespace dashpot::cli
