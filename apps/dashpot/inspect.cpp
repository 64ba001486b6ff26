#include "dashpot/report/inspect.h"

#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "data.h"
#include "layout.h"
#include "results.h"
#include "velocity_check.h"

namespace dashpot::cli {
namespace {

struct Settings {
  DataSettings data;
  std::string folder;
};

constexpr std::string_view kExample =
    "# Which column is what, in which unit, under which conditions?\n"
    "dashpot inspect recordings/\n"
    "\n"
    "# The same with plots of every record, to look for flaws:\n"
    "dashpot inspect recordings/ --output look\n"
    "\n"
    "# Something wrong? State it in a dataset file and look again:\n"
    "dashpot inspect recordings/ --dataset recordings.yaml";

std::string velocity_table(const std::vector<VelocityCheck>& checks, int width) {
  Table table({"record", ">cut-off Hz", ">derived against measured, rms %"});
  for (const VelocityCheck& check : checks)
    table.row({check.record, format_number(check.cutoff_hz, 3),
               fmt::format("{:.2f}", check.rms_percent)});
  return table.text(static_cast<std::size_t>(width));
}

Value inspect_json(const Dataset& dataset, const std::vector<VelocityCheck>& checks) {
  Value columns = Value::array(), records = Value::array(), velocities = Value::array();
  for (const ColumnReading& c : dataset.readings)
    columns.push_back(Value::object({{"file", c.file},
                                     {"column", c.column},
                                     {"channel", c.channel},
                                     {"unit", c.unit},
                                     {"factor", c.factor},
                                     {"raw_offset", c.raw_offset},
                                     {"basis", c.basis}}));
  for (const Record& r : dataset.records) {
    std::vector<std::string> channels;
    for (const Channel& channel : r.channels) channels.push_back(channel.name);
    records.push_back(
        Value::object({{"name", r.name},
                       {"source", r.source},
                       {"condition", r.condition},
                       {"drive_level", r.drive_level ? Value(*r.drive_level) : Value()},
                       {"samples", r.size()},
                       {"sample_time", r.sample_time},
                       {"channels", Value::array(channels)},
                       {"notes", Value::array(r.notes)}}));
  }
  Value passed_over = Value::array();
  for (const PassedOver& passed : dataset.passed_over)
    passed_over.push_back(Value::object({{"file", passed.file}, {"why", passed.why}}));
  for (const VelocityCheck& check : checks)
    velocities.push_back(Value::object({{"record", check.record},
                                        {"cutoff_hz", check.cutoff_hz},
                                        {"rms_percent", check.rms_percent}}));
  return Value::object({{"name", dataset.name},
                        {"drive_unit", to_string(dataset.drive_unit)},
                        {"columns", std::move(columns)},
                        {"records", std::move(records)},
                        {"derived_velocity", std::move(velocities)},
                        {"passed_over", std::move(passed_over)},
                        {"notes", Value::array(dataset.notes)}});
}

int run(const Settings& settings, Console& console) {
  LoadOptions options = settings.data.load;
  options.monitor = console.monitor();
  const Dataset dataset =
      load_dataset({settings.data.paths.begin(), settings.data.paths.end()}, options);
  const std::vector<VelocityCheck> checks = check_velocities(dataset, options.velocity_cutoff_hz);
  console.print(summary(dataset) + "\n\n" + describe(dataset));
  if (!checks.empty()) console.print('\n' + velocity_table(checks, console.width()));
  if (!settings.folder.empty()) {
    const std::string page = settings.folder + "/inspect.html";
    write_file(page, inspect_html(dataset, console.command_line(), date_now()));
    console.print("\nPlots  " + page + '\n');
  }
  if (console.json) console.print_json(inspect_json(dataset, checks));
  return kDone;
}

}  // namespace

Command inspect_command() {
  auto settings = std::make_shared<Settings>();
  Command command{.name = "inspect",
                  .title = "Show what is understood of recordings",
                  .description =
                      "Reads recordings as 'identify' would and prints what each column was taken "
                      "for, its unit, the "
                      "conditions of each record, and what was inferred or passed over. Where "
                      "velocity was measured, "
                      "also "
                      "compares it with the velocity derived from displacement.",
                  .options = data_options(settings->data),
                  .example = std::string(kExample),
                  .run = [settings](Console& console) { return run(*settings, console); }};
  std::erase_if(command.options,
                [](const Option& option) { return option.names == "-v,--verbose"; });
  command.options.push_back({.names = "-o,--output",
                             .target = &settings->folder,
                             .help = "also write DIR/inspect.html with plots of every record",
                             .value = "DIR",
                             .takes = Takes::Folder});
  return command;
}

}  // namespace dashpot::cli
