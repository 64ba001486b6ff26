#include "bench_in_plant.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "console.h"
#include "damper_choice.h"
#include "dampers_in_plant.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/worn_damper.h"
#include "dashpot/record/record_file.h"
#include "dashpot/record/source_files.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> grade_names() {
  std::vector<std::string> names;
  for (const SensorGrade& grade : sensor_grades()) names.push_back(grade.name);
  return names;
}

/// What the numbers that the plant calls unknown truly are: "mass 1 kg, stiffness 4000 N/m".
std::string true_words(const InPlantSetup& asked, const InPlantSetup& setup) {
  const auto& rows = setup.model->parameters;
  std::vector<std::string> words;
  for (const PlantUnknown& unknown : asked.unknown) {
    const auto value =
        std::ranges::find(setup.known, unknown.name, &NamedValues::value_type::first);
    const ParameterRow& row = rows[row_named(rows, unknown.name, setup.model->name, "--true")];
    words.push_back(unknown.name + ' ' + format_number(value->second, 6) + ' ' +
                    std::string(row.unit));
  }
  return join(words, ", ");
}

/// Which of them are far from what the plant's file expects: a plant's table does not know the
/// plant, and the fit begins at what is stated. Empty where none is.
std::string far_from_expected(const InPlantSetup& asked, const InPlantSetup& setup) {
  constexpr double kFar = 3;  // times more or less
  const auto& rows = setup.model->parameters;
  std::vector<std::string> words, right;
  for (const PlantUnknown& unknown : asked.unknown) {
    // Passed over where nothing is expected of it, or about the truth.
    if (!unknown.about) continue;
    const auto truth =
        std::ranges::find(setup.known, unknown.name, &NamedValues::value_type::first);
    const double ratio = truth->second / *unknown.about;
    if (ratio > 1 / kFar && ratio < kFar) continue;

    // Both values in words, and the option that would agree with the file.
    const ParameterRow& row = rows[row_named(rows, unknown.name, setup.model->name, "--true")];
    const std::string unit(row.unit);
    words.push_back(unknown.name + " is truly " + format_number(truth->second, 6) + ' ' + unit +
                    ", and the plant's file says about " + format_number(*unknown.about, 6) + ' ' +
                    unit);
    right.push_back(unknown.name + '=' + format_number(*unknown.about, 6));
  }
  if (words.empty()) return {};
  return join(words, "; ") + ": if that is not meant, --true " + join(right, ",");
}

/// The setup as it truly is: stated values in place of unknown ones, else those of the plant's
/// table.
InPlantSetup true_setup(InPlantSetup setup, const PlantBenchSettings& settings) {
  const auto& rows = setup.model->parameters;
  NamedValues stated;
  for (const std::string& word : settings.truth) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos)
      throw UsageError("--true", "'" + word + "' has no '='", "sprung_mass=387kg");
    const std::string name = word.substr(0, equals);
    const ParameterRow& row = rows[row_named(rows, name, setup.model->name, "--true")];
    if (std::ranges::find(setup.unknown, name, &PlantUnknown::name) == setup.unknown.end())
      throw UsageError("--true", name + " is known: the plant states it", "unknown ones only");
    stated.emplace_back(name, parse_value(row, word.substr(equals + 1), "--true"));
  }
  for (const PlantUnknown& unknown : setup.unknown) {
    const auto own = std::ranges::find(stated, unknown.name, &NamedValues::value_type::first);
    const double value =
        own != stated.end()
            ? own->second
            : rows[row_named(rows, unknown.name, setup.model->name, "--true")].value;
    if (value < unknown.lower || value > unknown.upper)
      throw UsageError("--true",
                       unknown.name + " would be " + format_number(value) + ", outside its range",
                       "--true " + unknown.name + "=...");
    setup.known.emplace_back(unknown.name, value);
  }
  setup.unknown.clear();

  // A delay that is to be found is one of a sample or so.
  constexpr double kUsualDelay = 2e-3;  // s
  for (PlantSensor& sensor : setup.sensors)
    if (sensor.finds_delay && sensor.delay == 0) sensor.delay = kUsualDelay;
  for (PlantSensor& sensor : setup.sensors) sensor.finds_delay = false;

  // Nor is a cut-off far from those that loggers have.
  constexpr double kUsualCutoff = 50;  // Hz
  for (PlantSensor& sensor : setup.sensors)
    if (sensor.finds_cutoff && sensor.filter.cutoff == 0)
      sensor.filter.cutoff =
          std::clamp(kUsualCutoff, sensor.finds_cutoff->lower, sensor.finds_cutoff->upper);
  for (PlantSensor& sensor : setup.sensors) sensor.finds_cutoff.reset();
  for (PlantInputChannel& input : setup.inputs) input.finds_later = false;
  return setup;
}

/// The road under the plant: as asked for, or as the plant's file says of one that nothing
/// measures.
std::string road_of(const InPlantSetup& setup, const PlantBenchSettings& settings) {
  const auto is_pushed = [](const PlantInputChannel& input) {
    return input.place.kind == PlantInput::Force;
  };
  if (!settings.road.empty() && std::ranges::all_of(setup.inputs, is_pushed))
    throw UsageError("--road", "moves a plant by its ground, and forces alone move this one",
                     "--push");
  if (!settings.road.empty()) return settings.road;
  for (const PlantInputChannel& input : setup.inputs) {
    if (input.place.kind != PlantInput::Ground) continue;
    if (!input.road || input.road->roughness == 0) return "iso8608,class=C,speed=20m/s";
    return "iso8608,roughness=" + format_exact(input.road->roughness) +
           ",speed=" + format_exact(input.road->speed) + "m/s";
  }
  return "";
}

/// The damper that truly stands in a strut.
struct TrueDamper {
  std::string name, about;  ///< what it is and where from; empty: a file, which its reader told
  std::string doubt;        ///< why its numbers are an example; empty: they are not
  DriveUnit drive_unit = DriveUnit::None;
  double drive_min = 0, drive_max = 0;
  std::vector<double> drive_levels;  ///< those that its driver can give; empty: all
  std::shared_ptr<const DamperModel> model;
};

/// A published damper by its name, or that of a model file.
TrueDamper true_damper(const std::string& name, Console& console) {
  if (!is_path(name)) {
    ParameterSet set = load_parameter_set(name);
    return {name,
            set.damper + "; " + set.source,
            set.verified ? "" : set.reason,
            set.model.drive_unit(),
            set.drive_min,
            set.drive_max,
            set.drive_levels,
            std::make_shared<LawModel>(std::move(set.model))};
  }

  // A file, of which the drive's range is that of its data.
  ModelFile file = load_damper_file({.model = name, .parameters = {}}, "bench", console);
  return {name,
          "",
          "",
          file.drive_unit,
          file.domain.current_min,
          file.domain.current_max,
          {},
          std::move(file.model)};
}

/// The levels of the rides: as asked for, else the damper's own or three over its range; where no
/// channel shows the drive, the one that the plant states.
std::vector<double> levels_of(const InPlantSetup& setup, const CampaignSettings& campaign,
                              const TrueDamper& damper) {
  const std::vector<double> stated = stated_levels(campaign);
  if (setup.drive_channels().empty()) {
    if (!stated.empty())
      throw UsageError("--levels", "no channel of the plant shows the drive",
                       "'current' or 'voltage' of the plant as the name of a channel");
    return {setup.drives.front().level};
  }
  if (!stated.empty()) return stated;
  if (!damper.drive_levels.empty()) return damper.drive_levels;
  return {damper.drive_min, 0.5 * (damper.drive_min + damper.drive_max), damper.drive_max};
}

/// The damper of each strut as it is, or worn: all by "force", one of several by "front_force".
std::vector<std::shared_ptr<const DamperModel>> worn_dampers(const std::vector<TrueDamper>& as_new,
                                                             double level,
                                                             const std::vector<std::string>& struts,
                                                             const PlantBenchSettings& settings) {
  std::vector<std::vector<WornDamper::Amount>> amounts(struts.size());
  for (const std::string& word : settings.wear) {
    const std::size_t equals = word.find('=');
    const auto value =
        equals == std::string::npos ? std::nullopt : parse_number(word.substr(equals + 1));
    if (!value) throw UsageError("--wear", "is '" + word + "'", "force=-0.1");
    const std::string name = word.substr(0, equals);
    const std::size_t bar = name.rfind('_');
    const auto own =
        bar == std::string::npos ? struts.end() : std::ranges::find(struts, name.substr(0, bar));
    const Wear& wear = find_wear(own == struts.end() ? name : name.substr(bar + 1), "--wear");

    // A share beyond the whole would push where the damper brakes; of two, one would be a slip.
    if (wear.unit == "1" && *value < -1)
      throw UsageError("--wear", name + " is " + format_number(*value) + ", more than the whole",
                       name + "=-0.1, 10 % less");
    for (std::size_t d = 0; d < struts.size(); ++d) {
      if (own != struts.end() && *own != struts[d]) continue;
      if (std::ranges::find(amounts[d], &wear, &WornDamper::Amount::wear) != amounts[d].end())
        throw UsageError("--wear", name + " is stated twice", "once, with the sum of both");
      amounts[d].push_back({&wear, *value});
    }
  }

  std::vector<std::shared_ptr<const DamperModel>> dampers;
  for (std::size_t d = 0; d < struts.size(); ++d) {
    const auto& model = as_new[d].model;
    if (amounts[d].empty())
      dampers.push_back(model);
    else
      dampers.push_back(std::make_shared<WornDamper>(mounted(model, level), amounts[d]));
  }
  return dampers;
}

/// The damper in each strut.
std::vector<TrueDamper> true_dampers(const CampaignSettings& campaign, const InPlantSetup& setup,
                                     Console& console) {
  std::vector<TrueDamper> dampers;
  for (const std::string& name : of_each_damper(campaign.damper, setup, "--damper", "NAME")) {
    dampers.push_back(true_damper(name, console));
    const DriveUnit unit = dampers.back().drive_unit;
    if (setup.drive_unit != DriveUnit::None && setup.drive_unit != unit)
      throw Error(
          name,
          "takes " + to_string(unit) + ", and the plant states " + to_string(setup.drive_unit),
          "'voltage' or 'current' of the plant as the damper has it");
  }
  return dampers;
}

/// Rides of an earlier campaign would be taken for some of this one.
void require_no_other_rides(const fs::path& folder, const std::vector<VirtualRide>& rides) {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".csv" || !name.starts_with("ride_")) continue;
    if (std::ranges::none_of(rides, [&](const VirtualRide& r) { return r.recorded.name == name; }))
      throw Error(entry.path().string(),
                  "is a ride of an earlier campaign, which would be taken for one of this",
                  "another --output, or remove it");
  }
}

}  // namespace

std::vector<Option> plant_bench_options(PlantBenchSettings& settings) {
  return {// What the recordings are of.
          {.names = "--in",
           .target = &settings.plant,
           .help = "instead of a bench: rides of a plant with the damper in it, as its sensors "
                   "record them, a ride per level, and the truth beside them (docs/in-plant.md)",
           .value = "PLANT",
           .takes = Takes::File,
           .idles = {{{"--motions", "--motion", "--drive", "--experiment", "--cycles"},
                      ": a plant is moved by its road or a force, not by motions of a bench",
                      "leave it out; --duration, --road or --push"},
                     {{"--velocity-sensor", "--noise", "--zero-drift"},
                      ", whose sensors are those of the plant",
                      "leave it out; 'noise' in the plant's file, or --grade"},
                     {{"--family", "--fluid", "--builds", "--asymmetry", "--give", "--dampers",
                       "--faults", "--trend", "--scatter"},
                      ", which drives one damper as it is published",
                      "leave it out; --wear changes its force"},
                     {{"--units"}, ", whose plant's file states units", "leave it out"}}},
          {.names = "--true",
           .target = &settings.truth,
           .help = "with --in: true values of what the plant calls unknown, as sprung_mass=350kg",
           .value = "LIST",
           .default_text = "those of the plant's table",
           .needs = "--in"},
          {.names = "--wear",
           .target = &settings.wear,
           .help = "with --in: changes of the damper's force, as force=-0.1 (10 % less), of one of "
                   "several front_force=-0.1; what 'dashpot watch' finds",
           .value = "LIST",
           .needs = "--in"},

          // What moves it, for how long, and how well that is seen.
          {.names = "--road",
           .target = &settings.road,
           .help = "with --in: the road (simulate --list roads)",
           .value = "WORDS",
           .default_text = "of class C at 20 m/s, or as the plant says",
           .needs = "--in"},
          {.names = "--push",
           .target = &settings.push,
           .help = "with --in: rms of the random force, N, or ground acceleration, m/s^2, that "
                   "moves a plant without a road",
           .value = "RMS",
           .minimum = 0,
           .default_text = "0.3 N per kg, or 1 m/s^2",
           .needs = "--in"},
          {.names = "--duration",
           .target = &settings.duration,
           .help = "with --in: of each ride, s",
           .value = "S",
           .minimum = 1,
           .needs = "--in"},
          {.names = "--hold",
           .target = &settings.hold,
           .help = "with --in: one ride that holds each level so long, s, one after the other at "
                   "random",
           .value = "S",
           .minimum = 0,
           .default_text = "a ride per level",
           .needs = "--in"},
          {.names = "--grade",
           .target = &settings.grade,
           .help = "with --in: of sensors whose noise is not stated",
           .value = "NAME",
           .choices = grade_names(),
           .noun = "grade",
           .needs = "--in"}};
}

int record_in_plant(const PlantBenchSettings& settings, const CampaignSettings& campaign,
                    const std::string& folder, Console& console) {
  // What the plant truly is, and the damper in it.
  const InPlantSetup asked = read_in_plant_setup(settings.plant);
  const InPlantSetup setup =
      with_grade(true_setup(asked, settings), find_sensor_grade(settings.grade, "--grade"));
  if (const std::string far = far_from_expected(asked, setup); !far.empty()) console.warn(far);
  const std::vector<TrueDamper> as_new = true_dampers(campaign, setup, console);
  const TrueDamper& damper = as_new.front();

  const std::string road = road_of(setup, settings);
  if (!road.empty() && settings.push != PlantBenchSettings{}.push)
    throw UsageError("--push", "moves a plant without a road, and this one has one", "--road");

  // A ride per level.
  const VirtualCampaignOptions options{
      .duration = settings.duration,
      .sample_rate = campaign.sample_rate > 0 ? campaign.sample_rate : 500,
      .levels = levels_of(setup, campaign, damper),
      .hold = settings.hold,
      .road = road,
      .push = settings.push,
      .seed = campaign.bench.seed,
      .monitor = console.monitor()};
  const auto dampers =
      worn_dampers(as_new, options.levels.front(), observer_names(setup).struts, settings);
  std::vector<const DamperModel*> models;
  for (const auto& one : dampers) models.push_back(one.get());
  const std::vector<VirtualRide> rides = virtual_campaign(setup, models, options);

  // All rides before the first file.
  require_no_other_rides(folder, rides);
  Value list = Value::array();
  for (const VirtualRide& ride : rides) {
    const fs::path path = fs::path(folder) / (ride.recorded.name + ".csv");
    save_csv(ride.recorded, path);
    save_csv(ride.truth, fs::path(folder) / "truth" / path.filename());
    list.push_back(path.string());
  }
  const fs::path plant = fs::path(folder) / "truth" / "plant.json";
  write_file(plant, format_json(to_json(setup)));
  mark_without_recordings(plant.parent_path());

  // What was recorded, and the command that goes on from it.
  std::set<std::string> told;
  for (const TrueDamper& one : as_new) {
    if (!told.insert(one.name).second) continue;
    if (!one.about.empty()) console.talk(one.about + '\n');
    if (!one.doubt.empty()) console.note("these parameters are an example: " + one.doubt);
  }
  if (const std::string note = levels_note(campaign, damper.drive_max, damper.drive_unit);
      !note.empty())
    console.note(note);
  std::string levels;
  for (const double level : options.levels)
    levels += (levels.empty() ? "" : ", ") + format_number(level);
  const std::string drives = setup.drive_channels().size() < 2 ? ""
                             : options.hold > 0
                                 ? ", each channel switched by itself"
                                 : ", each channel one level ahead of the one before it";
  console.print(
      counted(rides.size(), "ride") + " of the " +
      (setup.matrices ? "plant" : std::string(setup.model->name)) + ", " +
      format_number(options.duration) + " s each, at " + levels + ' ' +
      to_string(damper.drive_unit) + drives + (options.road.empty() ? "" : ", on " + options.road) +
      "\n\nRecordings  " + folder + "/ride_*.csv\nTruth       " + folder +
      "/truth/, of the same names\nPlant       " + plant.string() + ", as it truly is\n" +
      (asked.unknown.empty()
           ? ""
           : "Unknown     truly " + true_words(asked, setup) + " (--true states others)\n") +
      "Next        dashpot identify " + shell_quoted(folder) + " --in " +
      shell_quoted(settings.plant) + '\n');
  if (console.json)
    console.print_json(
        Value::object({{"folder", folder}, {"rides", std::move(list)}, {"plant", plant.string()}}));
  return kDone;
}

}  // namespace dashpot::cli
