#include "dashpot/identify/search/search.h"

#include <algorithm>
#include <array>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/rank/fit_store.h"
#include "dashpot/report/search_report.h"
#include "dashpot/report/words.h"
#include "document_text.h"
#include "live_table.h"
#include "many_machines.h"
#include "ranking_run.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct SearchSettings {
  RankingSettings ranking;
  std::string model = SearchOptions().model;
  std::vector<std::string> over;
  std::string method = "random", effort = "samples";
  std::uint64_t trials = SearchOptions().trials, steps = SearchOptions().steps;
  ManyMachines machines;
  bool fresh = false;
};

constexpr std::string_view kSearchExample =
    "# 24 networks drawn at random, each judged on records that it has not seen:\n"
    "dashpot search recordings/ --over hidden=3:30 --over activation=tanh,relu --output search\n"
    "\n"
    "# Interrupted, or not enough? The same command goes on where it stopped; more trials are "
    "added:\n"
    "dashpot search recordings/ --over hidden=3:30 --over activation=tanh,relu --output search "
    "--trials 60\n"
    "\n"
    "# Every combination; or many designs, of which the bad ones are dropped early:\n"
    "dashpot search recordings/ --over hidden=5,10,20,10-10 --over activation=tanh,relu --method "
    "grid\n"
    "dashpot search recordings/ --over hidden=2:40 --over l2=1e-6:1e-2 --method halving --trials "
    "54";

std::vector<std::string> searchable_models() {
  std::vector<std::string> names = model_names();
  std::erase_if(names, [](const std::string& name) { return network_settings_of(name).empty(); });
  return names;
}

/// "hidden=5" "10" "activation=tanh": values that the command line took for items of their own go
/// back.
std::vector<SearchAxis> axes_of(const std::vector<std::string>& words) {
  std::vector<std::string> texts;
  for (const std::string& word : words)
    if (texts.empty() || word.find('=') != std::string::npos)
      texts.push_back(word);
    else
      texts.back() += ',' + word;
  std::vector<SearchAxis> axes;
  for (const std::string& text : texts) axes.push_back(parse_search_axis(text, "--over"));
  return axes;
}

SearchOptions search_options(const SearchSettings& settings, Console& console) {
  SearchOptions options;
  options.model = settings.model;

  // The fit of each trial is that of the ranking, but for the network's design.
  FitSettings fit = settings.ranking.fit;
  fit.network.clear();  // no whole design: what is searched makes it one
  options.fit = identify_options(fit, {settings.model}, console);

  // The number of designs tried, and the effort for each.
  options.method = settings.method == "grid"     ? SearchMethod::Grid
                   : settings.method == "random" ? SearchMethod::Random
                                                 : SearchMethod::Halving;
  options.effort = settings.effort == "epochs" ? SearchEffort::Epochs : SearchEffort::Samples;
  options.trials = settings.trials;
  options.steps = settings.steps;

  // The settings searched and those held fixed; together they must leave something to try.
  try {
    for (const std::string& text : settings.ranking.fit.network)
      parse_network_setting(text, "--network", options.space.fixed);
    options.space.axes = axes_of(settings.over);
    search_rungs(options);
  } catch (const Error& error) {
    throw UsageError({}, error.what());
  }

  return options;
}

/// Runs the search; on a terminal, with a table of the best trials so far.
SearchReport run_search(const RankingData& data, const SearchOptions& options, const fs::path& file,
                        Console& console) {
  TrialStore store(file, describe_search(data.dataset, data.leave_out, options, program_id()));
  tell_dropped(store.dropped(), file, console);
  if (store.size() > 0)
    console.talk(counted(store.size(), "fit") + " kept from before in " + file.string() + '\n');

  // The table is redrawn whenever progress is.
  LiveTable live(console);
  SearchOptions watched = options;  // draws the table wherever progress is drawn
  watched.fit.monitor.on_progress =
      [&, show = options.fit.monitor.on_progress](const Progress& progress) {
        live.draw();
        if (show) show(progress);
      };

  SearchReport report =
      search(data.dataset, data.leave_out, watched, &store,
             [&](const Trial& trial, const SearchReport& so_far) { live.add(trial, so_far); });
  live.finish();
  report.options = options;  // what is watched ends here
  return report;
}

/// The best network and the smallest that is practically as good, ranked as `dashpot rank` does, as
/// files.
void write_choices(const RankingData& data, const SearchReport& report, const fs::path& folder,
                   Console& console) {
  const std::unique_ptr<FitStore> fits = kept_fits(folder, console);

  // The smallest is often the best itself; its file from an earlier search would mislead then.
  std::vector<std::pair<std::string, const Trial*>> choices{{"best", report.best()}};
  if (report.smallest() != report.best()) choices.emplace_back("smallest", report.smallest());
  fs::remove(folder / "models" / "smallest.json");  // of a search that went less far

  // Each is fitted once more, on all training records and with the full effort.
  for (const auto& [name, trial] : choices) {
    console.talk(fmt::format("fitting the {}, {}, on all training records\n", name,
                             searched_settings(*trial, report)));
    const Ranking ranking = rank({report.options.model}, data.dataset, data.leave_out,
                                 options_of(trial->design, report.options), fits.get());
    ModelFile file = to_model_file(ranking.models.front(), data.dataset, console.command_line());
    file.provenance.created = date_now();
    save_model(file, folder / "models" / (name + ".json"));
  }
  if (choices.size() == 1) fs::remove(folder / "models" / "smallest.json");
}

void write_report(const Document& report, const SearchInput& input, const ResultSettings& settings,
                  Console& console) {
  const fs::path folder = settings.folder;
  std::string where = "\nModels   " + (folder / "models").string() + "/\n";
  if (settings.report) {
    where += write_document(report, folder, "search", false, csv_search(input.search));
  }
  if (settings.figures) {
    write_search_figure(input.search, folder / "figures");
    where += "Figures  " + (folder / "figures").string() + "/\n";
  }
  console.print(where);
}

std::string time_line(const SearchReport& report) {
  double seconds = 0;
  for (const Trial& trial : report.trials) seconds += trial.seconds;
  return fmt::format(
      "{} in {} s; {} s of CPU time{}.\n", counted(report.results, "fit"),
      number_text(report.wall_seconds), number_text(seconds),
      report.kept ? fmt::format("; {} kept from before", counted(report.kept, "fit")) : "");
}

int run_in(const fs::path& folder, const RankingData& data, const SearchOptions& options,
           const SearchSettings& settings, const Part& part, Console& console) {
  const fs::path file = folder / "search.sqlite";
  if (settings.fresh) Store::remove(file);
  console.talk("search: " + search_plan(search_rungs(options), options.effort) + '\n');

  // Trials kept from an interrupted search are not fitted again.
  PartReport made;
  if (are_dealt_out(part)) {
    TrialStore store(file, describe_search(data.dataset, data.leave_out, options, program_id()));
    tell_dropped(store.dropped(), file, console);
    made = search_part(data.dataset, data.leave_out, options, store, part);
    if (ranks().is_worker()) return kDone;
    if (!part.is_all()) return finish_part(made, part, "fit", file, console);
  }
  SearchReport report = run_search(data, options, file, console);
  if (!ranks().is_alone()) {
    report.kept = made.kept;
    report.wall_seconds += made.wall_seconds;
  }
  const SearchInput input{data.dataset, report, console.command_line(), DASHPOT_VERSION,
                          date_now()};

  // Without a usable trial there is nothing to save, but still a table that says why.
  if (report.best()) write_choices(data, report, folder, console);
  const Document document = search_document(input);
  print_document(document, console);
  console.print(time_line(report));

  ResultSettings results = settings.ranking.results;
  results.figures = results.figures && report.best();
  write_report(document, input, results, console);
  if (console.json) console.print_json(document_json(document));

  if (report.best()) return kDone;
  console.error("no trial gave a usable force on the records left out; the table says why");
  return kNotUsable;
}

int run_search(const SearchSettings& settings, Console& console) {
  const Part part = settle_machines(settings.machines);
  const SearchOptions options = search_options(settings, console);
  const RankingData data = ranking_data(settings.ranking, console);
  const fs::path folder = settings.ranking.results.folder;
  try {
    return run_in(folder, data, options, settings, part, console);
  } catch (const Interrupted&) {
    console.note("every finished fit is kept in " + folder.string() +
                 "; the same command goes on from there");
    throw;
  }
}

std::vector<Option> own_options(SearchSettings& settings) {
  return {
      {.names = "--model",
       .target = &settings.model,
       .help = "the network whose settings are searched",
       .value = "NAME",
       .choices = searchable_models(),
       .noun = "network"},
      {.names = "--over",
       .target = &settings.over,
       .help = "a setting and its values, as hidden=5,10,10-10, or their range, as l2=1e-5:1e-2; "
               "again for each setting. --network lists the settings",
       .value = "SETTING=...",
       .required = true},

      // The choice of designs, and their number.
      {.names = "--method",
       .target = &settings.method,
       .help =
           "every combination, a number of random ones, or halving: many random ones with little "
           "effort, the best third of them with three times as much, until all effort goes to the "
           "last three or more. Ranges are spaced and drawn evenly in the logarithm",
       .value = "HOW",
       .choices = {"grid", "random", "halving"}},
      {.names = "--trials",
       .target = &settings.trials,
       .help = "number of networks drawn at random; a grid has its own number",
       .value = "N",
       .minimum = 1},
      {.names = "--steps",
       .target = &settings.steps,
       .help = "values of a range on a grid",
       .value = "N",
       .minimum = 1},

      // The effort of halving, and whether earlier trials count.
      {.names = "--effort",
       .target = &settings.effort,
       .help = "the effort that halving limits at first: samples (the first part of every training "
               "record) or epochs (--network epochs=N then sets the full number)",
       .value = "WHAT",
       .choices = {"samples", "epochs"}},
      {.names = "--fresh",
       .target = &settings.fresh,
       .help = "start anew: the fits of an earlier search in DIR/search.sqlite are thrown away"}};
}

}  // namespace

Command search_command() {
  auto settings = std::make_shared<SearchSettings>();
  settings->ranking.results.folder = "dashpot-search";
  Command command{
      .name = "search",
      .title = "The settings with which a network predicts best",
      .description =
          "Fits a network with many settings and judges each on left-out records as 'rank' does. "
          "Prints them by error, with the fewest parameters that are within one standard error of "
          "the best, and writes both as model files, fitted on everything, with a page that shows "
          "error against size. Each fit is kept in DIR/search.sqlite as it ends: the same command "
          "goes on where it was stopped, and more --trials go on beyond it. The result does not "
          "depend on threads or interruptions.",
      .options = ranking_options(settings->ranking),
      .example = std::string(kSearchExample),
      .run = [settings](Console& console) { return run_search(*settings, console); }};
  // A search has one model, and parameters of laws are not its business.
  constexpr std::array kOthers{"--models", "--form",  "--fix",   "--free",
                               "--bounds", "--prior", "--search"};
  std::erase_if(command.options, [&](const Option& option) {
    return std::ranges::find(kOthers, option.long_name()) != kOthers.end();
  });
  const auto data_end = std::ranges::find(command.options, "--leave-out", &Option::names);
  const std::vector<Option> own = own_options(*settings);
  command.options.insert(data_end, own.begin(), own.end());
  append(command.options, many_machines_options(settings->machines));
  command.over_ranks = true;
  return command;
}

}  // namespace dashpot::cli
