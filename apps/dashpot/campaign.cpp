#include "campaign.h"

#include <algorithm>

#include <fmt/core.h>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

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
  if (const auto level = parse_number(text)) return *level;
  throw UsageError("--levels", "'" + text + "' is not a number", "write them as 0,0.5,1");
}

std::vector<double> levels_over(double low, double high) {
  constexpr int kLevels = 5;
  std::vector<double> levels;
  for (int k = 0; k < kLevels; ++k) levels.push_back(low + (high - low) * k / (kLevels - 1));
  return levels;
}

std::string drive_column(const Dataset& campaign) {
  return campaign.drive_unit == "V" ? "voltage_V" : "current_A";
}

std::string file_name(const Record& record) {
  std::string name = record.name + ".csv";
  std::erase(name, ',');
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::string csv_of(const Record& record, const Dataset& campaign) {
  const std::vector<double>& x = record.channel("displacement").samples;
  const std::vector<double>& force = record.channel("force").samples;
  const std::vector<double>& drive =
      record.channel(campaign.drive_unit == "V" ? "voltage" : "current").samples;
  std::string text = "t_s,x_mm,F_N," + drive_column(campaign) + '\n';
  constexpr int kDigits = 9;  // more than any sensor has
  for (std::size_t k = 0; k < record.size(); ++k)
    text += format_number(record.time[k], kDigits) + ',' + format_number(1000 * x[k], kDigits) + ',' +
            format_number(force[k], kDigits) + ',' + format_number(drive[k], kDigits) + '\n';
  return text;
}

/// JSON text is YAML too, and quotes what has to be quoted.
std::string quoted(const std::string& text) { return format_json(Value(text), false); }

std::string dataset_yaml(const Dataset& campaign, const ParameterSet& damper, const std::string& command) {
  std::string text = "# Written by " + quoted(command) + "\n# True model (" + damper.source + "):\n#   " +
                     format_json(damper.model.to_json(), false) + "\nname: " + quoted(campaign.name) +
                     "\ncitation: " + quoted(campaign.citation) + "\ndrive: " + campaign.drive_unit +
                     "\nnotes: simulated, not measured\nfiles:\n";
  for (const Record& record : campaign.records)
    text += fmt::format("  - match: {}  # {}\n    name: {}\n    condition: {}\n    level: {}\n",
                        quoted(file_name(record)), join(record.notes, "; "), quoted(record.name),
                        quoted(record.condition), format_exact(record.drive_level.value_or(0)));
  return text;
}

}  // namespace

CampaignSettings::CampaignSettings() {
  for (const SineMotion& motion : bench.motions)
    motions.push_back(format_number(1000 * motion.amplitude) + "x" + format_number(motion.frequency));
}

std::vector<Option> campaign_options(CampaignSettings& settings) {
  BenchOptions& bench = settings.bench;
  return {
      {.names = "--damper",
       .target = &settings.damper,
       .help = "the damper under test, by the publication of its parameters",
       .value = "NAME",
       .choices = parameter_set_names(),
       .noun = "damper"},
      {.names = "--motions",
       .target = &settings.motions,
       .help = "sines, amplitude in mm x frequency in Hz",
       .value = "LIST"},
      {.names = "--levels",
       .target = &settings.levels,
       .help = "currents in A (or voltages in V, as the damper is driven)",
       .value = "LIST",
       .default_text = "five over the damper's range"},
      {.names = "--cycles", .target = &bench.cycles, .help = "cycles per record", .value = "N", .minimum = 1},
      {.names = "--sample-rate",
       .target = &bench.sample_rate,
       .help = "samples per second",
       .value = "HZ",
       .minimum = 1},
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
  BenchOptions options = settings.bench;
  options.motions.clear();
  for (const std::string& motion : settings.motions) options.motions.push_back(parse_motion(motion));
  options.drive_levels.clear();
  for (const std::string& level : settings.levels) options.drive_levels.push_back(parse_level(level));
  if (options.drive_levels.empty()) options.drive_levels = levels_over(damper.drive_min, damper.drive_max);
  Dataset campaign = run_virtual_bench(damper.model, damper.model.drive_unit(), options);
  campaign.name = "virtual bench, " + damper.name;
  return campaign;
}

fs::path write_campaign(const Dataset& campaign, const ParameterSet& damper, const fs::path& folder,
                        const std::string& command) {
  for (const Record& record : campaign.records)
    write_file(folder / file_name(record), csv_of(record, campaign));
  const fs::path statement = folder / "dataset.yaml";
  write_file(statement, dataset_yaml(campaign, damper, command));
  return statement;
}

}  // namespace dashpot::cli
