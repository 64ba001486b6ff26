#include "dashpot/machine/watch.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands.h"
#include "console.h"
#include "dampers_in_plant.h"
#include "dashpot/base/date.h"
#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/store.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/day_order.h"
#include "dashpot/machine/in_plant_words.h"
#include "data.h"
#include "document_text.h"
#include "results.h"
#include "units.h"
#include "watch_document.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct WatchSettings {
  std::string model, plant, state, level, units, folder = "dashpot-watch";
  std::vector<std::string> recordings, known, tracked = WatchOptions().wears;
  std::uint64_t reference = ChartOptions().reference;
  double false_alarms = 1 / ChartOptions().days;
  int threads = 0;
};

constexpr std::string_view kWatchExample =
    "# Each day's drive, as its file comes; the state holds the days before:\n"
    "dashpot watch results/models/tanh_kwok.json --in car.yaml --state car.watch day_*.csv\n"
    "\n"
    "# The ride height as well, whose mean tells of the gas; a warm oil explains a weak day:\n"
    "dashpot watch model.json --in car.yaml days --level level --known temperature \\\n"
    "  --state car.watch --false-alarms 0.002\n"
    "\n"
    "# A half car whose dampers are not alike: which of them fades\n"
    "dashpot watch front=firm.json,rear=soft.json --in half.yaml days --state half.watch";

constexpr StoreFormat kWatchFormat{"watch", 1, "remove this one", "--state"};

/// A recording that is to be looked at.
struct NewDay {
  std::string path, hash;
};

/// The days that are known, in their order, and the file that keeps them, where there is one.
class DayState {
 public:
  DayState(const WatchSettings& settings, const NamedTexts& basis, Console& console) {
    if (settings.state.empty()) return;
    const fs::path path = settings.state;
    if (path.has_parent_path()) make_folder(path.parent_path());
    store_.emplace(path, kWatchFormat, basis);
    tell_dropped(store_->dropped(), path, console);
    found_ = store_->load("found");
    store_->for_each([&](std::string_view key, std::string_view bytes) {
      // "day 000012 <hash>"
      if (!key.starts_with("day ")) return;
      hashes_.push_back(std::string(key.substr(key.rfind(' ') + 1)));
      days_.push_back(watched_day_from_json(parse_json(bytes, path.string())));
    });
  }

  const std::vector<WatchedDay>& days() const { return days_; }
  const std::optional<std::string>& found() const { return found_; }
  bool holds(const std::string& hash) const {
    return std::ranges::find(hashes_, hash) != hashes_.end();
  }
  void keep_found(const WatchedPlant& watched) {
    if (store_) store_->save("found", format_json(found_of(watched)));
  }
  void keep(const NewDay& day, WatchedDay watched) {
    if (store_)
      store_->save(fmt::format("day {:06} {}", days_.size(), day.hash),
                   format_json(to_json(watched), false));
    hashes_.push_back(day.hash);
    days_.push_back(std::move(watched));
  }

 private:
  std::optional<Store> store_;
  std::optional<std::string> found_;
  std::vector<std::string> hashes_;
  std::vector<WatchedDay> days_;
};

WatchOptions watch_options(const WatchSettings& settings, Console& console) {
  if (!(settings.false_alarms > 0 && settings.false_alarms < 0.1))
    throw UsageError("--false-alarms", "must lie between 0 and 0.1", "0.001 is one in 1000 days");
  WatchOptions options{
      .wears = settings.tracked,
      .level = settings.level,
      .known = settings.known,
      .chart = {.reference = settings.reference, .days = 1 / settings.false_alarms},
      .threads = settings.threads,
      .monitor = console.monitor()};
  for (const std::string& name : options.wears) find_wear(name, "--tracked");
  return options;
}

/// What all results of a state depend on; `models`: a file per damper.
NamedTexts basis_of(const WatchSettings& settings, const std::vector<std::string>& models,
                    const InPlantSetup& setup) {
  NamedTexts basis;
  const std::vector<std::string> struts = observer_names(setup).struts;
  for (std::size_t d = 0; d < models.size(); ++d)
    basis.emplace_back(models.size() == 1 ? "model" : "model of " + struts[d],
                       sha256_of_file(models[d]));
  basis.insert(basis.end(), {{"plant", format_json(to_json(setup), false)},
                             {"tracked quantities", join(settings.tracked, ",")},
                             {"level", settings.level},
                             {"known channels", join(settings.known, ",")}});
  return basis;
}

/// The recordings that the state does not hold yet, in their order.
std::vector<NewDay> new_days(const WatchSettings& settings, const DayState& state) {
  std::vector<NewDay> days;
  if (settings.recordings.empty()) return days;
  std::map<std::string, std::string> seen;
  for (const std::string& path : recording_files(settings.recordings)) {
    NewDay day{path, sha256_of_file(path)};
    const auto [same, is_new] = seen.emplace(day.hash, path);
    if (!is_new) throw Error(path, "is the same recording as " + same->second, "each day once");
    if (!state.holds(day.hash)) days.push_back(std::move(day));
  }
  return days;
}

PlantRecording read_day(const NewDay& day, const InPlantSetup& setup, const WatchOptions& options) {
  std::vector<std::string> channels = setup.channels();
  channels.insert(channels.end(), options.known.begin(), options.known.end());
  return read_plant_recording(day.path, channels);
}

/// The plant as the state has it, or as the first reference days show it.
WatchedPlant prepared(ObservedDampers dampers, const InPlantSetup& setup,
                      const std::vector<NewDay>& todo, const WatchOptions& options, DayState& state,
                      Console& console) {
  if (state.found()) {
    const Value found = parse_json(*state.found(), "state");
    return watched_again(std::move(dampers), setup, found, options);
  }
  require_watchable(setup, options);
  if (todo.empty()) throw UsageError("RECORDING", "is missing", "the recordings of the first days");
  std::vector<PlantRecording> first;
  for (std::size_t d = 0; d < std::min(kPreparationDays, todo.size()); ++d)
    first.push_back(read_day(todo[d], setup, options));
  if (const std::string note = without_units(first); !note.empty()) console.note(note);
  WatchedPlant watched = watched_plant(std::move(dampers), setup, first, options);
  state.keep_found(watched);
  return watched;
}

/// Looks at the new days, a few at a time, and keeps each in its order. Returns why others are left
/// out, each with its name.
std::vector<std::string> add_days(const WatchedPlant& watched, const std::vector<NewDay>& todo,
                                  const WatchOptions& options, DayState& state) {
  std::vector<std::string> left_out;
  const int threads = options.threads > 0 ? options.threads : default_threads();
  const std::size_t batch = 2 * static_cast<std::size_t>(threads);

  // Batch by batch, so that a stop loses one of them at most.
  for (std::size_t first = 0; first < todo.size(); first += batch) {
    options.monitor.report(fmt::format("day {} of {}", first + 1, todo.size()),
                           kPreparation + (1 - kPreparation) * static_cast<double>(first) /
                                              static_cast<double>(todo.size()));
    const std::size_t count = std::min(batch, todo.size() - first);
    std::vector<std::optional<WatchedDay>> days(count);
    std::vector<std::string> faults(count);

    // Day beside day; one that cannot be read stops no other.
    parallel_for(count, options.threads, [&](std::size_t k) {
      try {
        days[k] = watch_day(watched, read_day(todo[first + k], watched.setup, options), options);
      } catch (const Error& error) {
        faults[k] = error.what();
      }
    });

    // In their order into the state.
    for (std::size_t k = 0; k < count; ++k) {
      if (days[k])
        state.keep(todo[first + k], std::move(*days[k]));
      else
        left_out.push_back(std::move(faults[k]));
    }
  }
  return left_out;
}

int run_watch(const WatchSettings& settings, Console& console) {
  // All that can be wrong is found before the work.
  if (settings.plant.empty())
    throw UsageError("--in", "is missing", "the plant and its sensors: docs/in-plant.md");
  const WatchOptions options = watch_options(settings, console);
  const PrintUnits units = page_units(settings.units);
  InPlantSetup setup = read_in_plant_setup(settings.plant);
  require_setup(setup);
  const std::vector<std::string> models = model_files(settings.model, setup);
  ObservedDampers dampers = load_dampers(models, "watch", setup, console);
  DayState state(settings, basis_of(settings, models, setup), console);
  const std::vector<NewDay> todo = new_days(settings, state);
  std::vector<std::string> names = {state.days().empty() ? "" : state.days().back().estimate.name};
  for (const NewDay& day : todo) names.push_back(fs::path(day.path).filename().string());
  if (const std::string disorder = day_disorder(names); !disorder.empty()) console.warn(disorder);

  // The new days, then the charts of all; before them, what the sensors will not tell.
  const WatchedPlant watched = prepared(std::move(dampers), setup, todo, options, state, console);
  for (const std::string& doubt : hardly_apart(watched)) console.warn(doubt);
  const std::vector<std::string> left_out = add_days(watched, todo, options, state);
  for (const std::string& why : left_out) console.warn("left out: " + why);
  console.files_unread |= !left_out.empty();
  if (state.days().empty()) throw Error("recordings", "none of them can be used");
  const std::vector<WatchedQuantity> quantities = watch_charts(watched, state.days(), options);

  // What they say.
  for (const std::string& day : odd_days(quantities, state.days())) console.warn(day);
  const Watched told{watched, state.days(), quantities, options, left_out};
  Document document = watch_document(told, units);
  document.command = console.command_line();
  document.version = DASHPOT_VERSION;
  document.date = date_now();
  print_document(document, console);
  console.print("\n" + write_document(document, settings.folder, "report", false,
                                      watch_csv(told, file_units(settings.units))));
  console.print(settings.state.empty()
                    ? "No state  name a --state FILE, and a new day is added without the old ones\n"
                    : "State    " + settings.state + ", " + counted(state.days().size(), "day") +
                          ", " + counted(todo.size(), "new recording") + " looked at\n");
  if (console.json) console.print_json(document_json(document));
  return kDone;
}

}  // namespace

Command watch_command() {
  auto settings = std::make_shared<WatchSettings>();
  WatchSettings& s = *settings;
  std::vector<std::string> names;
  for (const Wear& wear : wears()) names.push_back(wear.name);
  return {
      .name = "watch",
      .title = "Dampers at work, followed from day to day: an alarm when one fades",
      .description =
          "Takes the recordings of a plant, one per day and in their order. Each says, through the "
          "filter of 'dashpot observe', how much the force of each damper differs from its "
          "model's; what is unknown of the plant, as its load, and the road are found anew on each "
          "day. The first days teach how much healthy days differ; from then on a chart per damper "
          "and quantity (a self-starting cumulative sum) raises an alarm when it has fallen. How "
          "often healthy days raise any is stated, not hoped for. docs/watch.md has the rules.",
      .options =
          {// The damper, the days, and the plant.
           model_of_each_option(s.model),
           {.names = "RECORDING",
            .target = &s.recordings,
            .help = "a recording per day, in their order, or folders of them; those that the state "
                    "holds are not looked at again",
            .takes = Takes::File},
           {.names = "--in",
            .target = &s.plant,
            .help = "the plant and its sensors, as a YAML file or words (docs/in-plant.md); what "
                    "differs from day to day is unknown there: a load, the class of the road",
            .value = "PLANT",
            .takes = Takes::File},
           {.names = "--state",
            .target = &s.state,
            .help = "keeps the days, so that a new one is added without the old ones",
            .value = "FILE",
            .takes = Takes::File},

           // What is followed, and how soon it alarms.
           {.names = "--tracked",
            .target = &s.tracked,
            .help = "what is followed of each damper, as changes of its model's force",
            .value = "LIST",
            .choices = names,
            .noun = "wear"},
           {.names = "--level",
            .target = &s.level,
            .help = "follow this sensor's mean too: a ride height, which falls with the gas force",
            .value = "CHANNEL"},
           {.names = "--known",
            .target = &s.known,
            .help = "channels whose mean may explain a day, as a temperature",
            .value = "LIST"},
           {.names = "--reference",
            .target = &s.reference,
            .help = "days at the beginning that teach and are not judged",
            .value = "DAYS"},
           {.names = "--false-alarms",
            .target = &s.false_alarms,
            .help = "per healthy day, all charts of all dampers together: 0.001 is one in 1000 "
                    "days on average",
            .value = "RATE",
            .minimum = 0},

           // Where it goes.
           {.names = "-o,--output",
            .target = &s.folder,
            .help = "folder for the report",
            .value = "DIR",
            .takes = Takes::Folder},
           units_option(s.units),
           threads_option(s.threads)},
      .example = std::string(kWatchExample),
      .run = [settings](Console& console) { return run_watch(*settings, console); }};
}

}  // namespace dashpot::cli
