#include "dashpot/record/characterise.h"

#include <algorithm>
#include <memory>
#include <set>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/report/characterisation_document.h"
#include "data.h"
#include "document_text.h"
#include "results.h"
#include "speeds.h"
#include "units.h"

namespace dashpot::cli {
namespace {

struct CharacteriseSettings {
  DataSettings data;
  std::string speeds, csv, report, units;
};

constexpr std::string_view kCharacteriseExample =
    "# The dyno sheet of a damper: forces over speed, knee, friction, gas force:\n"
    "dashpot characterise recordings/\n"
    "\n"
    "# At the speeds of the house, every cycle as a table, and a page with its loops:\n"
    "dashpot characterise recordings/ --speeds 52,131,262,524 --csv cycles.csv \\\n"
    "    --report sheet.html";

/// How many dampers the records are of, by the numbers that they state, as those of a family do.
std::size_t stated_dampers(const Dataset& dataset) {
  std::set<std::vector<double>> dampers;
  for (const Record& record : dataset.records) {
    std::vector<double> numbers;
    for (const MemberField& field : member_fields()) {
      const double* stated = find_condition(record.conditions, field.name);
      numbers.push_back(stated ? *stated : 0);
    }
    const double* specimen = find_condition(record.conditions, kSpecimen);
    numbers.push_back(specimen ? *specimen : 0);
    dampers.insert(std::move(numbers));
  }
  return dampers.size();
}

int run_characterise(const CharacteriseSettings& settings, Console& console) {
  require_page(settings.report);
  require_output(settings.csv);
  const PrintUnits units = page_units(settings.units);
  const CharacteriseOptions options{parse_speeds(settings.speeds, units)};
  const Dataset dataset = load_recordings(settings.data, console);
  const Characterisation figures = characterise(dataset, options);
  console.check_stop();
  if (const std::size_t dampers = stated_dampers(dataset); dampers > 1)
    console.warn("the recordings are of " + std::to_string(dampers) +
                 " dampers by their drawings, and the sheet takes them for one: name those of one");
  Document document = characterisation_document(
      {dataset, figures, console.command_line(), DASHPOT_VERSION, date_now()});
  document.units = units;

  // The sheet, then the files that were asked for.
  print_document(document, console);
  if (console.json) console.print_json(document_json(document));
  if (!settings.csv.empty()) {
    write_file(settings.csv, cycles_csv(figures, file_units(settings.units)));
    console.print("\nCycles  " + settings.csv + '\n');
  }
  if (!settings.report.empty()) {
    write_page(document, settings.report);
    console.print("\nReport  " + settings.report + '\n');
  }

  const bool has_cycles = std::ranges::any_of(figures.records, &RecordFigures::is_cyclic);
  if (has_cycles) return kDone;
  console.error("no record holds a cycle that can be characterised");
  return kNotUsable;
}

}  // namespace

Command characterise_command() {
  auto settings = std::make_shared<CharacteriseSettings>();
  Command command{
      .name = "characterise",
      .title = "Print the dyno sheet of a damper, without any model",
      .description =
          "Splits cyclic recordings at their reversals and prints what they say by themselves: "
          "force at mid stroke and its peaks in rebound and compression over speed, knee, "
          "low-speed friction, gas force and its rate, hysteresis, energy, equivalent damping, "
          "dynamic range over the drive, how cycles repeat and drift. docs/characterise.md has "
          "every definition.",
      .options = data_options(settings->data),
      .example = std::string(kCharacteriseExample),
      .run = [settings](Console& console) { return run_characterise(*settings, console); }};

  append(command.options,
         {units_option(settings->units),
          speeds_option(settings->speeds),
          {.names = "--csv",
           .target = &settings->csv,
           .help = "also write every cycle with all its figures",
           .value = "FILE",
           .takes = Takes::File},
          {.names = "--report",
           .target = &settings->report,
           .help = "also write a page with the loops, printed where FILE ends in .pdf",
           .value = "FILE",
           .takes = Takes::File}});
  return command;
}

}  // namespace dashpot::cli
