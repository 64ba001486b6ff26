#include "dashpot/report/compare.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/model_file.h"
#include "data.h"
#include "document_text.h"
#include "results.h"
#include "speeds.h"
#include "units.h"

namespace dashpot::cli {
namespace {

struct CompareSettings {
  std::vector<std::string> things;
  std::string speeds, report, units;
  double cutoff_hz = 0;
  int threads = 0;
};

constexpr std::string_view kCompareExample =
    "# What has changed since the last campaign, at the same speeds and currents?\n"
    "dashpot compare before/ after/ --report changes.html\n"
    "\n"
    "# Two models over recordings that neither has seen:\n"
    "dashpot compare new-recordings/ results/models/tanh_kwok.json results/models/anfis.json\n"
    "\n"
    "# Two models alone, on sines over the range of the first:\n"
    "dashpot compare old.json new.json";

bool is_model_file(const std::string& path) {
  if (!path.ends_with(".json") || !std::filesystem::is_regular_file(path)) return false;
  return read_file(path).find("\"dashpot-model\"") != std::string::npos;
}

/// Whether two paths lead to one thing, or to two model files of the same content.
bool are_same(const std::string& one, const std::string& other) {
  std::error_code unknown;
  if (std::filesystem::equivalent(one, other, unknown)) return true;
  return is_model_file(one) && is_model_file(other) && read_file(one) == read_file(other);
}

/// Short names where they stay apart: a model file's without folder and ending.
void shorten_names(std::vector<ComparedThing>& things) {
  std::vector<std::string> names;
  for (const ComparedThing& thing : things)
    names.push_back(thing.is_model ? std::filesystem::path(thing.name).stem().string()
                                   : thing.name);
  for (std::size_t k = 0; k < things.size(); ++k)
    if (std::ranges::count(names, names[k]) == 1) things[k].name = names[k];
}

/// Everything, read and characterised, in the order of the command line.
std::vector<ComparedThing> gather(const CompareSettings& settings, Console& console) {
  std::deque<ModelFile> models;
  std::deque<Dataset> datasets;
  std::vector<ThingToCompare> things;
  for (const std::string& path : settings.things) {
    things.push_back({.name = path});
    if (is_model_file(path)) {
      things.back().model = &models.emplace_back(load_model(path));
      continue;
    }
    DataSettings data;
    data.paths = {path};
    data.load.velocity_cutoff_hz = settings.cutoff_hz;
    things.back().dataset = &datasets.emplace_back(load_recordings(data, console));
  }

  std::vector<ComparedThing> compared =
      compared_things(things, parse_speeds(settings.speeds, page_units(settings.units)),
                      settings.threads, [&] { console.check_stop(); });
  shorten_names(compared);
  return compared;
}

int run_compare(const CompareSettings& settings, Console& console) {
  require_page(settings.report);
  if (settings.things.size() < 2)
    throw UsageError("compare", "one thing cannot be compared",
                     "two or more model files and recordings: dashpot compare before/ after/");

  const PrintUnits units = page_units(settings.units);
  const std::vector<double> speeds = parse_speeds(settings.speeds, units);
  const std::vector<ComparedThing> things = gather(settings, console);
  Document document =
      comparison_document({things, speeds, console.command_line(), DASHPOT_VERSION, date_now()});
  document.units = units;
  print_document(document, console);

  // Without a difference between the things, none of the figures says anything about them.
  for (std::size_t k = 1; k < settings.things.size(); ++k)
    if (are_same(settings.things.front(), settings.things[k]))
      console.warn(fmt::format("{} and {} are the same: a comparison with itself",
                               settings.things.front(), settings.things[k]));

  // A model that has seen the recordings is not judged by them.
  for (const ComparedThing& thing : things)
    if (thing.seen > 0)
      console.warn(fmt::format("{} was taught by {} of the recordings: this is no judgement",
                               thing.name, counted(thing.seen, "record")));

  if (console.json) console.print_json(document_json(document));
  if (!settings.report.empty()) {
    write_page(document, settings.report);
    console.print("\nReport  " + settings.report + '\n');
  }
  return kDone;
}

}  // namespace

Command compare_command() {
  auto settings = std::make_shared<CompareSettings>();
  return {
      .name = "compare",
      .title = "Lay models and recordings over each other",
      .description =
          "Compares the first of the things named with each of the others: forces at the same "
          "speeds and drives, knee, friction, yield and gas force, each difference beside its "
          "noise. Models are run over the first recordings, or, where there are none, over "
          "sines within their data. Warns where a recording taught a model.",
      .options = {{.names = "THINGS",
                   .target = &settings->things,
                   .help = "two or more: model files, and recordings (files, folders or "
                           "dataset files)",
                   .takes = Takes::File,
                   .required = true},
                  units_option(settings->units),

                  // How they are compared, and where the page goes.
                  speeds_option(settings->speeds),
                  {.names = "--velocity-cutoff",
                   .target = &settings->cutoff_hz,
                   .help = "cut-off frequency of the zero-phase filter that velocity is "
                           "derived with",
                   .value = "HZ",
                   .minimum = 0,
                   .default_text = "from the motion, and stated"},
                  {.names = "--report",
                   .target = &settings->report,
                   .help = "also write a page with the curves laid over each other, printed where "
                           "FILE ends in .pdf",
                   .value = "FILE",
                   .takes = Takes::File},
                  threads_option(settings->threads)},
      .example = std::string(kCompareExample),
      .run = [settings](Console& console) { return run_compare(*settings, console); }};
}

}  // namespace dashpot::cli
