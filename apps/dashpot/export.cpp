#include "dashpot/export.h"

#include <algorithm>
#include <array>
#include <cmath>
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
#include "dashpot/export/c/c_observer.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/fmu/fmu.h"
#include "dashpot/export/tables/force_map.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "export_control.h"
#include "observe_options.h"
#include "units.h"

namespace dashpot::cli {
namespace {

struct ExportSettings {
  DamperChoice damper;
  VehicleChoice vehicle;
  std::vector<std::string> formats;
  std::string name, precision, sample_time, folder = "dashpot-export", compiler;
  std::string velocities, currents, units;
  std::vector<std::string> platforms;
  std::string plant;  ///< whose observer is exported
  std::vector<std::string> force_errors;
  std::string velocity_shift;
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
    "# Tables on a grid of your own, for a multibody program and for a spreadsheet:\n"
    "dashpot export --parameters spencer1997 --to tables,carsim,dpr --velocities=-200:50:200 "
    "--currents 0,1,2\n"
    "\n"
    "# A controller for an ECU with the sensors of a car, from accelerometer to current:\n"
    "dashpot export --controller mix1,crossover=1.9Hz --in-car --to c --precision float "
    "--sample-time 2ms -o ecu\n"
    "\n"
    "# The current for a wanted force, and a skyhook that drives its damper by it:\n"
    "dashpot export --parameters spencer1997 --inverse numeric --to c -o ecu\n"
    "dashpot export --controller skyhook_modified --damper spencer1997 --inverse numeric --to c -o "
    "ecu\n"
    "\n"
    "# A damper's force from a car's sensors, for an ECU:\n"
    "dashpot export model.json --in car.yaml --force-error 28@0.005,5@0.5 --to c --precision float "
    "-o ecu";

std::vector<std::string> exporter_names() {
  std::vector<std::string> names;
  for (const Exporter& exporter : exporters()) names.emplace_back(exporter.name);
  return names;
}

std::string formats_text() {
  std::string text;
  for (const Exporter& exporter : exporters())
    text += fmt::format(". {}: {}, from {}; writes {}", exporter.name, exporter.title,
                        exporter.takes, exporter.files);
  return text;
}

bool is_inverse(const std::string& path) {
  if (std::error_code none; !std::filesystem::is_regular_file(path, none)) return false;
  const std::string text = read_file(path);
  if (!trim(text).starts_with('{')) return false;
  const Value document = parse_json(text, path);
  const Value* format = document.kind() == Value::Kind::Object ? document.find("format") : nullptr;
  return format && format->kind() == Value::Kind::String &&
         format->as_string() == "dashpot-inverse";
}

std::optional<CPrecision> precision_of(const ExportSettings& settings) {
  if (settings.precision.empty()) return {};
  return settings.precision == "float" ? CPrecision::Single : CPrecision::Double;
}

std::vector<ExportedFile> damper_files(const ExportSettings& settings, const ExportOptions& options,
                                       Console& console) {
  const ModelFile file = load_damper_file(settings.damper, "export", console);
  const PrintUnits asked =
      options.units.empty() ? PrintUnits() : PrintUnits::parse(options.units, "units");
  if (const std::string note = extrapolation_note(exported_model(file), options, asked.of("m/s"));
      !note.empty())
    console.warn("the table is " + note);
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
    add_files(find_exporter(format, "--to").write(exported_model(file), options), files);
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

/// The observer of a plant with this damper in each of its struts.
CBlockMaker observer_block(const ExportSettings& settings, const ExportOptions& options,
                           Console& console) {
  ModelFile file = load_damper_file(settings.damper, "export", console);
  const InPlantSetup setup =
      with_identified_noise(read_in_plant_setup(settings.plant), file, settings.damper.model);
  if (const std::string words = identified_noise_words(setup, {}); !words.empty())
    console.note(words);

  // At the step that is asked for, else that of the model's data.
  ObserveOptions observed;
  observed.force = force_errors(settings.force_errors);
  observed.shift = velocity_shift(settings.velocity_shift);
  const double sample_time = options.sample_time > 0 ? options.sample_time
                             : file.sample_time > 0  ? file.sample_time
                                                     : 1e-3;
  const std::string origin = damper_origin(exported_model(file));
  const std::shared_ptr<const DamperModel> damper = std::move(file.model);
  auto observer = std::make_shared<const PlantObserver>(
      make_observer(damper, file.domain, setup, sample_time, observed));
  return [observer, names = observer_names(setup, damper->name()), origin](
             const ExportOptions& own) { return c_observer_block(*observer, names, origin, own); };
}

/// Options, and whether they were given.
using GivenOptions = std::vector<std::pair<const char*, bool>>;

/// Of a controller and its vehicle.
GivenOptions vehicle_options_given(const VehicleChoice& vehicle) {
  return {
      {"--controller", !vehicle.controller.empty()},       {"--damper", !vehicle.damper.empty()},
      {"--plant", vehicle.plant != VehicleChoice{}.plant}, {"--set", !vehicle.values.empty()},
      {"--force-loop", !vehicle.force_loop.empty()},       {"--in-car", vehicle.in_car}};
}

/// Of an inverse and the coil whose limits it keeps.
GivenOptions inverse_options_given(const VehicleChoice& vehicle) {
  return {{"--inverse", !vehicle.inverse.empty()},
          {"--current-max", vehicle.current_max > 0},
          {"--lag-rate", vehicle.lag_rate >= 0}};
}

void refuse(const GivenOptions& options, const std::string& why, const std::string& right) {
  for (const auto& [option, is_given] : options)
    if (is_given) throw UsageError(option, why, right);
}

/// Null: what is named is a damper.
CBlockMaker chosen_block(const ExportSettings& settings, const ExportOptions& options,
                         Console& console) {
  const VehicleChoice& vehicle = settings.vehicle;
  if (!settings.plant.empty()) {
    require_blocks(settings, settings.plant, "an observer");
    return observer_block(settings, options, console);
  }
  if (!settings.force_errors.empty()) throw UsageError("--force-error", "goes with --in");
  if (!settings.velocity_shift.empty()) throw UsageError("--velocity-shift", "goes with --in");

  // A controller takes its damper and sensors with it.
  if (!vehicle.controller.empty()) {
    require_blocks(settings, vehicle.controller, "a controller");
    return controller_block(vehicle, settings.damper, options, console);
  }

  // Without one, options of its vehicle would have no effect.
  refuse(vehicle_options_given(vehicle), "goes with --controller", "");

  // An inverse network from a file, or the inverse of a damper by a scheme.
  if (is_inverse(settings.damper.model)) {
    require_blocks(settings, settings.damper.model, "an inverse");
    refuse(inverse_options_given(vehicle), "has no effect on an inverse from a file",
           "leave it out; the file holds its limits");
    return [file = load_inverse(settings.damper.model)](const ExportOptions& own) {
      return c_inverse_block(file, own);
    };
  }

  if (vehicle.inverse.empty()) {
    refuse(inverse_options_given(vehicle), "goes with --controller or --inverse", "");
    return nullptr;
  }
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
    add_files(find_exporter(format, "--to").write_block(block, options), files);
  return files;
}

/// "0,100,250" or "-500:50:500" as ascending numbers, each times `scale`.
std::vector<double> grid_of(const std::string& text, const std::string& option, double scale) {
  constexpr std::size_t kMost = 1000;
  constexpr int kDigits = 12;  // steps add up to what people read
  const auto wrong = [&](const std::string& what) {
    return UsageError(option, what, "numbers as 0,50,100, or low:step:high as 0:50:500");
  };
  std::vector<double> grid;
  if (text.empty()) return grid;
  const bool is_range = text.find(':') != std::string::npos;
  for (const std::string& word : split(text, is_range ? ':' : ',')) {
    const std::optional<double> number = parse_number(trim(word));
    if (!number || !std::isfinite(*number)) throw wrong("'" + word + "' is not a number");
    grid.push_back(*number);
  }

  // A range becomes its steps.
  if (is_range) {
    if (grid.size() != 3 || grid[1] <= 0 || grid[2] < grid[0]) throw wrong("is '" + text + "'");
    const double low = grid[0], step = grid[1], steps = std::floor((grid[2] - low) / step + 1e-9);
    if (!(steps < kMost)) throw wrong("has more than " + std::to_string(kMost) + " steps");
    if (steps < 1) throw wrong("'" + text + "' is a single number: its step is beyond its end");

    // A range that misses its end was most likely meant as low:high:step.
    const double last = low + steps * step;
    if (grid[2] - last > 1e-6 * step)
      throw wrong("'" + text + "' ends at " + format_number(last) + ", not at " +
                  format_number(grid[2]) + ": its step is " + format_number(step));
    grid.clear();
    for (double k = 0; k <= steps; ++k) grid.push_back(low + k * step);
  }
  if (grid.size() > kMost) throw wrong("has more than " + std::to_string(kMost) + " numbers");
  for (double& value : grid) value = *parse_number(format_number(scale * value, kDigits));
  std::ranges::sort(grid);
  if (std::ranges::adjacent_find(grid) != grid.end()) throw wrong("holds a number twice");
  return grid;
}

/// s; 0 where none is stated.
double sample_time_of(const std::string& text) {
  if (text.empty()) return 0;
  const double seconds = parse_quantity(text, "s", "--sample-time");
  require_export_sample_time(seconds, "--sample-time");
  return seconds;
}

/// The grid is of tables alone.
void require_tables(const ExportSettings& settings) {
  constexpr std::array kTables{"carsim", "dpr", "tables"};
  for (const auto& [option, text] : {std::pair{"--velocities", &settings.velocities},
                                     std::pair{"--currents", &settings.currents}})
    if (!text->empty() && std::ranges::none_of(settings.formats, [&](const std::string& format) {
          return std::ranges::find(kTables, format) != kTables.end();
        }))
      throw UsageError(option, "is the grid of tables", "with --to tables, carsim or dpr");

  // The other layouts have the units of their programs.
  if (!settings.units.empty() &&
      std::ranges::find(settings.formats, "tables") == settings.formats.end())
    throw UsageError("--units", "are of tables", "with --to tables");
}

/// A precision is chosen of C and ONNX alone.
void require_precise_formats(const ExportSettings& settings) {
  constexpr std::array kFixed{"fmu2", "fmu3", "tables", "carsim", "dpr"};
  if (!settings.precision.empty() &&
      std::ranges::all_of(settings.formats, [&](const std::string& format) {
        return std::ranges::find(kFixed, format) != kFixed.end();
      }))
    throw UsageError("--precision", "has no effect on " + join(settings.formats, ", "),
                     "leave it out, or add --to c or onnx");
}

std::vector<std::string> platform_names() {
  std::vector<std::string> names;
  for (const FmuPlatform& platform : fmu_platforms()) names.emplace_back(platform.name);
  return names;
}

/// Binaries are of FMUs alone.
void require_fmus(const ExportSettings& settings) {
  const bool has_fmu = std::ranges::any_of(
      settings.formats, [](const std::string& format) { return format.starts_with("fmu"); });
  for (const auto& [option, is_said] : {std::pair{"--sources-only", settings.sources_only},
                                        {"--compiler", !settings.compiler.empty()}})
    if (is_said && !has_fmu)
      throw UsageError(option, "is of the binaries in an FMU", "with --to fmu2 or fmu3");
  if (settings.sources_only && !settings.compiler.empty())
    throw UsageError("--compiler", "is of binaries, and --sources-only wants none",
                     "leave one of them out");
  if (settings.platforms.empty()) return;
  if (settings.sources_only)
    throw UsageError("--platforms", "are of binaries, and --sources-only wants none",
                     "leave one of them out");
  if (!has_fmu)
    throw UsageError("--platforms", "are of the binaries in an FMU",
                     "with --to fmu2 or fmu3; what --to c writes is compiled by any C compiler");
}

Option table_units_option(std::string& units) {
  Option option = units_option(units);
  option.help = "units of --velocities and of the CSV files of tables, as lbf,in/s";
  option.default_text = "mm/s; in the files SI";
  return option;
}

void require_tunable_formats(const ExportSettings& settings) {
  if (!settings.tunable) return;
  for (const std::string& format : settings.formats)
    if (format != "c" && !format.starts_with("fmu"))
      throw UsageError("--tunable", "does not go with " + format,
                       "--to c; an FMU has its parameters tunable by itself");
}

/// Refuses to write C whose parameters can be set over C whose cannot, or the other way round,
/// where a file that goes with the other would be left: it would no longer fit its header.
void require_alike_headers(const ExportSettings& settings, const std::vector<ExportedFile>& files) {
  const auto is_settable = [](const std::string& text) {
    return text.find("_defaults(") != std::string::npos;
  };
  for (const ExportedFile& file : files) {
    // A header that would take the place of one of the other kind.
    const std::filesystem::path path = std::filesystem::path(settings.folder) / file.name;
    if (path.extension() != ".h" || !std::filesystem::exists(path) ||
        is_settable(read_file(path)) == is_settable(file.content))
      continue;

    // Whatever goes with that one, and is not written anew.
    for (const char* ending : {"_test.c", "_mex.c", "_sfun.c"}) {
      const std::string left = path.stem().string() + ending;
      const bool is_written = std::ranges::find(files, left, &ExportedFile::name) != files.end();
      if (!is_written && std::filesystem::exists(path.parent_path() / left))
        throw Error(path.string(),
                    std::string("is of an export ") + (settings.tunable ? "without" : "with") +
                        " --tunable, and " + left + ", which goes with it, would be left",
                    "another --name or --output, or remove these files");
    }
  }
}

int run_export(const ExportSettings& settings, Console& console) {
  if (settings.formats.empty())
    throw UsageError("--to", "is missing", "one or more of " + join(exporter_names(), ", "));
  if (settings.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  require_tunable_formats(settings);
  require_fmus(settings);
  require_tables(settings);
  require_precise_formats(settings);

  // The words of the command line as the exporters take them.
  const ExportOptions options{
      .name = settings.name,
      .precision = precision_of(settings),
      .sample_time = sample_time_of(settings.sample_time),
      .settable_parameters = settings.tunable,
      .compiler = settings.compiler.empty() ? usual_compiler() : settings.compiler,
      .sources_only = settings.sources_only,
      .platforms = settings.platforms,
      .velocities = grid_of(settings.velocities, "--velocities",
                            1 / page_units(settings.units).of("m/s").factor),
      .currents = grid_of(settings.currents, "--currents", 1),
      .units = settings.units,
      .command = console.command_line(),
      .version = DASHPOT_VERSION};

  // All files are made before the first is written: an error leaves none behind.
  const std::vector<ExportedFile> files = exported_files(settings, options, console);
  require_alike_headers(settings, files);
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
                    .noun = "format",
                    .details = formats_text()},
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
                    .default_text = "that of the model's data, or 1 ms; of a controller or the "
                                    "inverse of a damper 1 ms"},

                   // The grid of tables.
                   {.names = "--velocities",
                    .target = &settings->velocities,
                    .help = "velocities of tables: a list, or low:step:high; those beyond the "
                            "model's data are marked as extrapolated",
                    .value = "MM/S,...",
                    .default_text = "31 over the model's data"},
                   {.names = "--currents",
                    .target = &settings->currents,
                    .help = "currents (or voltages) of tables, likewise",
                    .value = "A,...",
                    .default_text = "11 over the model's data"},
                   table_units_option(settings->units),
                   {.names = "--tunable",
                    .target = &settings->tunable,
                    .help = "C whose parameters stand behind the state and may be set while it "
                            "runs: of a law, or of family_physics (gap, lengths, areas, viscosity, "
                            "yield stress, build); an FMU has them in any case"},

                   // The observer of a plant.
                   {.names = "--in",
                    .target = &settings->plant,
                    .help = "with C or an FMU: the observer of this plant with the damper in it "
                            "('dashpot observe'), from sensors to force and motion",
                    .value = "PLANT",
                    .takes = Takes::File,
                    .idles = {{{"--controller", "--damper", "--plant", "--set", "--force-loop",
                                "--in-car", "--inverse", "--current-max", "--lag-rate"},
                               ", which exports an observer"}}},
                   force_error_option(settings->force_errors),
                   velocity_shift_option(settings->velocity_shift),

                   // The binary of an FMU.
                   {.names = "--compiler",
                    .target = &settings->compiler,
                    .help = "C compiler for the binary in an FMU, and more arguments for it",
                    .value = "CC",
                    .default_text = "$CC, or cc"},
                   {.names = "--platforms",
                    .target = &settings->platforms,
                    .help = "binaries of an FMU; others than this machine's need cross compilers",
                    .value = "PLATFORM",
                    .choices = platform_names(),
                    .noun = "platform",
                    .default_text = "this machine's"},
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
              "controller (--controller) are exported, too, where a format takes them.",
          .options = std::move(options),
          .example = std::string(kExportExample),
          .run = [settings](Console& console) { return run_export(*settings, console); }};
}

}  // namespace dashpot::cli
