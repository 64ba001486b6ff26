#include "campaign.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/bench_experiments.h"
#include "units.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

std::vector<double> levels_over(double low, double high) {
  constexpr int kLevels = 5;
  std::vector<double> levels;
  for (int k = 0; k < kLevels; ++k) levels.push_back(low + (high - low) * k / (kLevels - 1));
  return levels;
}

std::string drive_column(DriveUnit drive_unit) {
  return drive_unit == DriveUnit::Volt ? "voltage_V" : "current_A";
}

/// A column as a real bench would record it.
struct Column {
  std::string title;
  const std::vector<double>& samples;
  double factor = 1;
  int digits = 9;  ///< more than any sensor has
};

/// The notes that a real bench would have of its tests, as YAML; the true offsets stay in comments.
std::string public_notes(const Dataset& campaign) {
  std::vector<std::string> notes{"simulated, not measured"};
  for (const Record& record : campaign.records)
    for (const std::string& note : record.notes)
      if (!note.starts_with("true ") && std::ranges::find(notes, note) == notes.end())
        notes.push_back(note);
  if (notes.size() == 1) return notes.front();
  std::string list;
  for (const std::string& note : notes) list += "\n  - " + yaml_string(note);
  return list;
}

std::string dataset_yaml(const Dataset& campaign, const ParameterSet& damper,
                         const std::string& command) {
  std::string text =
      "# Written by " + yaml_string(command) + "\n# True model (" + yaml_comment(damper.source) +
      "):\n#   " + format_json(damper.model.to_json(), false) +
      "\nname: " + yaml_string(campaign.name) + "\ncitation: " + yaml_string(campaign.citation) +
      "\ndrive: " + to_string(campaign.drive_unit) + "\nnotes: " + public_notes(campaign) +
      "\nfiles:\n";
  for (const Record& record : campaign.records) {
    text += fmt::format("  - match: {}  # {}\n    name: {}\n    condition: {}\n",
                        yaml_string(recording_file(record)), yaml_comment(record.notes.front()),
                        yaml_string(record.name), yaml_string(record.condition));
    if (record.drive_level) text += "    level: " + format_exact(*record.drive_level) + '\n';
  }
  return text;
}

/// An option that another one would leave without effect.
void require_consistent(const CampaignSettings& settings) {
  const bool experiment = !settings.experiment.empty();
  const bool motions = settings.motions != CampaignSettings().motions;
  if (experiment && !(settings.motion.empty() && settings.drive.empty()))
    throw UsageError("--experiment", "states motion and drive itself",
                     "leave --motion and --drive out");
  if (motions && (experiment || !settings.motion.empty()))
    throw UsageError("--motions", "are not run beside another motion", "leave one of them out");
  if (!settings.levels.empty() && (experiment || !settings.drive.empty()))
    throw UsageError("--levels", "are not run beside another drive", "leave one of them out");
}

/// The levels asked for; else the damper's own, where it has some, or five over its range.
std::vector<double> drive_levels(const CampaignSettings& settings, const ParameterSet& damper) {
  std::vector<double> levels = stated_levels(settings);
  if (!levels.empty()) return levels;
  return damper.drive_levels.empty() ? levels_over(damper.drive_min, damper.drive_max)
                                     : damper.drive_levels;
}

/// Each motion under each drive.
std::vector<BenchTest> campaign_tests(const CampaignSettings& settings, const ParameterSet& damper,
                                      BenchOptions options) {
  if (!settings.experiment.empty())
    return experiment_tests(settings.experiment, damper, options.seed);

  const std::vector<BenchTest> motions = campaign_motions(settings, options);

  // Each motion runs under each drive: one sequence, or every level.
  const DriveFrame frame{.low = damper.drive_min, .high = damper.drive_max, .seed = options.seed};
  std::vector<BenchTest> tests;
  for (const BenchTest& motion : motions) {
    if (!settings.drive.empty()) {
      tests.push_back(under_sequence(motion, settings.drive, frame, "--drive"));
      continue;
    }
    for (const double level : drive_levels(settings, damper))
      tests.push_back(at_level(motion, level, damper.model.drive_unit()));
  }
  return tests;
}

}  // namespace

SineMotion parse_motion(const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  const auto millimetres = parse_number(parts.front());
  const auto hertz = parse_number(parts.back());
  if (parts.size() != 2 || !millimetres || !hertz || !(*millimetres > 0) || !(*hertz > 0))
    throw UsageError("--motions", "'" + text + "' is not an amplitude and a frequency",
                     "write mm x Hz, as 25x0.5");
  return {*millimetres / 1000, *hertz};
}

double parse_level(const std::string& text) {
  const auto level = parse_number(text);
  if (!level || !std::isfinite(*level))
    throw UsageError("--levels", "'" + text + "' is not a number", "write them as 0,0.5,1");
  if (*level < 0)
    throw UsageError("--levels", text + " is below 0, and dampers are driven from 0 up",
                     "write them as 0,0.5,1");
  return *level;
}

std::vector<BenchTest> campaign_motions(const CampaignSettings& settings, BenchOptions options) {
  if (!settings.motion.empty()) return {sequence_test(settings.motion, options.seed, "--motion")};
  options.motions.clear();
  for (const std::string& motion : settings.motions)
    options.motions.push_back(parse_motion(motion));
  return bench_sines(options);
}

std::string levels_note(const CampaignSettings& settings, double drive_max, DriveUnit unit) {
  const std::vector<double> levels = stated_levels(settings);
  if (levels.empty()) return {};
  return beyond_known_text(std::ranges::max(levels), drive_max, unit);
}

std::vector<double> stated_levels(const CampaignSettings& settings) {
  std::vector<double> levels;
  for (const std::string& level : settings.levels) levels.push_back(parse_level(level));
  return levels;
}

std::string recording_file(const Record& record) {
  std::string name = record.name + ".csv";
  std::erase(name, ',');
  std::ranges::replace(name, ' ', '_');
  std::ranges::replace(name, '/', '-');
  return name;
}

std::string recording_csv(const Record& record, DriveUnit drive_unit, const std::string& units) {
  constexpr int kTimeDigits = 12;  // so that equal steps read back as equal
  const std::string drive = drive_channel(drive_unit);
  const PrintUnits shown = page_units(units);
  const PrintUnit length = shown.of("m"), force = shown.of("N"),
                  speed = file_units(units).of("m/s");

  // A bench has time, motion, force and drive; velocity only where it was measured.
  std::vector<Column> columns{
      {"t_s", record.time, 1, kTimeDigits},
      {"x_" + length.name, record.channel("displacement").samples, length.factor},
      {"F_" + force.name, record.channel("force").samples, force.factor},
      {drive_column(drive_unit), record.channel(drive).samples}};
  const Channel& velocity = record.channel("velocity");
  if (!velocity.origin.starts_with("derived"))
    columns.push_back({"v_" + speed.name, velocity.samples, speed.factor});

  // The header names channel and unit as the reader of recordings expects them.
  std::string text;
  for (const Column& column : columns) text += (text.empty() ? "" : ",") + column.title;
  text += '\n';

  for (std::size_t k = 0; k < record.size(); ++k)
    for (const Column& column : columns)
      text += format_number(column.factor * column.samples[k], column.digits) +
              (&column == &columns.back() ? '\n' : ',');
  return text;
}

CampaignSettings::CampaignSettings() {
  bench.velocity_noise = one_sensor_bench({}).velocity_noise;
  for (const SineMotion& sine : bench.motions)
    motions.push_back(format_number(1000 * sine.amplitude) + "x" + format_number(sine.frequency));
}

std::vector<Option> campaign_options(CampaignSettings& settings) {
  BenchOptions& bench = settings.bench;
  return {
      // The damper, and the usual campaign of sines at constant currents.
      {.names = "--damper",
       .target = &settings.damper,
       .help = "the damper under test, by the publication of its parameters",
       .value = "NAME",
       .choices = parameter_set_names(),
       .takes_parts = true,
       .noun = "damper",
       .takes = Takes::File,
       .details = "; with --in also a model file, and one for all dampers of the plant, or one of "
                  "each strut or kind of damper: front=NAME,rear=NAME"},
      {.names = "--motions",
       .target = &settings.motions,
       .help = "sines, amplitude in mm x frequency in Hz",
       .value = "LIST"},
      {.names = "--levels",
       .target = &settings.levels,
       .help = "currents in A (or voltages in V, as the damper is driven)",
       .value = "LIST",
       .default_text = "the damper's own, or five over its range"},

      // Sequences and experiments in place of the usual campaign.
      {.names = "--motion",
       .target = &settings.motion,
       .help = "a sequence in place of the sines, with values for its parameters if wanted, as "
               "AM,carrier=3,amplitude=10mm; --sequences lists them",
       .value = "NAME,..."},
      {.names = "--drive",
       .target = &settings.drive,
       .help = "a sequence over the damper's range in place of the levels, as PRBS,clock=20ms",
       .value = "NAME,..."},
      {.names = "--experiment",
       .target = &settings.experiment,
       .help = "an experiment of the one-sensor paper in place of motion and drive, or all five",
       .value = "NAME",
       .choices = experiment_names(),
       .noun = "experiment"},

      // The length and the rate of each recording.
      {.names = "--cycles",
       .target = &bench.cycles,
       .help = "cycles per record",
       .value = "N",
       .minimum = 1},
      {.names = "--sample-rate",
       .target = &settings.sample_rate,
       .help = "samples per second",
       .value = "HZ",
       .minimum = 1,
       .default_text = format_number(bench.sample_rate) + "; of an experiment " +
                       format_number(one_sensor_bench(bench).sample_rate)},

      // The sensors and their flaws.
      {.names = "--velocity-sensor",
       .target = &bench.velocity_sensor,
       .help = "record the velocity too, with the noise of a tachometer; an experiment does"},
      {.names = "--noise",
       .target = &bench.force_noise,
       .help = "standard deviation of the force noise, as a share of each record's force span",
       .value = "SHARE",
       .minimum = 0},
      {.names = "--zero-drift",
       .target = &bench.force_offset,
       .help = "standard deviation of the load cell's zero from record to record",
       .value = "N",
       .minimum = 0},
      {.names = "--seed",
       .target = &bench.seed,
       .help = "seed of all random numbers: the same seed gives the same files",
       .value = "N",
       .minimum = 0}};
}

Dataset run_campaign(const CampaignSettings& settings, const ParameterSet& damper) {
  require_consistent(settings);
  BenchOptions options =
      settings.experiment.empty() ? settings.bench : one_sensor_bench(settings.bench);
  if (settings.sample_rate > 0) options.sample_rate = settings.sample_rate;
  Dataset campaign = run_virtual_bench(damper.model, damper.model.drive_unit(),
                                       campaign_tests(settings, damper, options), options);
  campaign.name = "virtual bench, " + damper.name;
  return campaign;
}

fs::path write_campaign(const Dataset& campaign, const ParameterSet& damper, const fs::path& folder,
                        const std::string& command, const std::string& units) {
  for (const Record& record : campaign.records)
    write_file(folder / recording_file(record), recording_csv(record, campaign.drive_unit, units));
  const fs::path statement = folder / "dataset.yaml";
  write_file(statement, dataset_yaml(campaign, damper, command));
  return statement;
}

}  // namespace dashpot::cli
