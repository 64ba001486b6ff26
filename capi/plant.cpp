#include "dashpot/base/date.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/day_order.h"
#include "dashpot/machine/evaluate_in_plant.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/model_in_plant.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/watched.h"
#include "dashpot/record/readers/reader.h"
#include "dashpot/record/source_files.h"
#include "handles.h"
#include "recordings.h"
#include "status.h"
#include "words.h"
#include "work.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

/// A plant by the text of its file, by the file, or by words.
InPlantSetup setup_of(const char* plant) {
  require(plant, "plant");
  const std::string text = plant;
  const bool is_text = text.find_first_of("{\n") != std::string::npos;
  return is_text ? parse_in_plant_setup(text, "plant") : read_in_plant_setup(text);
}

/// `more`: channels beside those of the plant.
std::vector<PlantRecording> recordings_of(const dashpot_rides* rides, const InPlantSetup& setup,
                                          const std::vector<std::string>& more = {}) {
  require(rides, "rides");
  if (rides->tables.empty()) throw Error("rides", "there are none", "add one at least");
  std::vector<std::string> channels = setup.channels();
  channels.insert(channels.end(), more.begin(), more.end());
  std::vector<PlantRecording> recordings;
  for (const RawTable& table : rides->tables)
    recordings.push_back(plant_recording(table, channels));
  return recordings;
}

/// What a fit in a plant is made from.
struct InPlantWork {
  InPlantSetup setup;
  std::vector<PlantRecording> recordings;
  InPlantWords words;
};

InPlantReport identify(const InPlantWork& work, const dashpot_monitor* monitor, char** report) {
  const InPlantWords& words = work.words;
  const std::vector<std::string>& models = words.fit.words.models;
  require_model_for_plant(models.front(), work.setup, "options, models");
  find_sensor_grade(words.grade, "options, grade");
  const IdentifyOptions fit = identify_options(words.fit.words, models, "options, ");
  InPlantOptions options{.choices = fit.choices,
                         .network = fit.network,
                         .starts = fit.starts,
                         .seed = fit.seed,
                         .threads = fit.threads,
                         .grade = words.grade,
                         .profiles = words.profiles};

  // The fit runs beside the caller's thread, which may cancel it.
  InPlantReport found;
  run_watched(monitor, [&](const Monitor& watched) {
    options.monitor = watched;
    found = identify_in_plant(models, work.setup, work.recordings, options).back().report;
  });

  // The report is written before a failed fit is refused, since it says why.
  if (report) {
    Value told = to_json(found, models.front());
    if (found.has_models()) told.add("found", to_json(as_found(work.setup, found)));
    *report = copy_text(format_json(presentable(told)));
  }
  if (!found.has_models()) throw NotUsable(models.front(), found.message);
  return found;
}

/// A damper that was found, as the caller holds it.
dashpot_model* model_of(const FoundDamper& damper, const InPlantReport& found,
                        const InPlantWork& work) {
  ModelFile file = found_damper(damper, found, work.setup, work.recordings.front().sample_time);
  file.provenance.created = date_now();
  file.provenance.command = work.words.fit.command;
  file.provenance.dataset = "identified in a plant: " + std::string(work.setup.model->name);
  for (const PlantRecording& recording : work.recordings)
    file.provenance.training_records.push_back(recording.name);
  return new dashpot_model(std::move(file));
}

InPlantWork work_of(const dashpot_rides* rides, const char* plant, const char* options) {
  const InPlantSetup setup = setup_of(plant);
  return {setup, recordings_of(rides, setup), read_in_plant_options(options)};
}

/// The models of a plant's dampers, in the order of its struts.
using PlacedModels = std::vector<const dashpot_model*>;

/// This model in each strut.
PlacedModels in_each_strut(const dashpot_model* model, const InPlantSetup& setup) {
  require(model, "model");
  require_setup(setup);
  return PlacedModels(setup.dampers(), model);
}

/// A model for each strut, by its name or that of its kind; one without a name in all of them.
PlacedModels by_struts(const dashpot_placed_model* dampers, size_t count,
                       const InPlantSetup& setup) {
  require(dampers, "dampers");
  if (count == 1 && !dampers->strut) return in_each_strut(dampers->model, setup);
  require_setup(setup);
  const std::vector<std::string> struts = observer_names(setup).struts;

  // Each model goes to the dampers of its name.
  PlacedModels models(struts.size());
  for (size_t k = 0; k < count; ++k) {
    require(dampers[k].strut, "strut");
    require(dampers[k].model, "model");
    const std::vector<size_t> places = dampers_named(setup, dampers[k].strut);
    if (places.empty())
      throw Error("dampers", "the plant has no damper '" + std::string(dampers[k].strut) + "'",
                  suggest(dampers[k].strut, damper_names(setup)));
    for (const size_t d : places) {
      if (models[d])
        throw Error("dampers", "the damper '" + struts[d] + "' has two models",
                    "one of each damper");
      models[d] = dampers[k].model;
    }
  }

  // None is left.
  for (size_t d = 0; d < struts.size(); ++d)
    if (!models[d])
      throw Error("dampers", "the damper '" + struts[d] + "' has no model",
                  "one for each of " + join(struts, ", "));
  return models;
}

/// The plant's dampers, and the noise that an identification of plant or models found.
ObservedDampers placed(const PlacedModels& models, InPlantSetup& setup) {
  ObservedDampers dampers;
  for (const dashpot_model* model : models) {
    require_plant_drive(setup, model->file, model->name);
    setup = with_identified_noise(std::move(setup), model->file, "the model");
    dampers.push_back({model->damper->with_offset(0), model->file.domain});
  }
  return dampers;
}

/// Recordings of a name for the caller.
std::unique_ptr<dashpot_recordings> as_recordings(const char* name, const InPlantSetup& setup,
                                                  std::vector<Record> records) {
  auto made = std::make_unique<dashpot_recordings>();
  made->dataset.name = name;
  made->dataset.drive_unit = setup.drive_unit;
  made->dataset.records = std::move(records);
  return made;
}

void observe_rides(const PlacedModels& models, const dashpot_rides* rides, InPlantSetup setup,
                   ObserveOptions options, const dashpot_monitor* monitor,
                   dashpot_recordings** estimates, char** report) {
  const ObservedDampers dampers = placed(models, setup);
  const std::vector<PlantRecording> recordings = recordings_of(rides, setup);
  ObserveReport observed;
  run_watched(monitor, [&](const Monitor& watched) {
    options.monitor = watched;
    observed = observe(dampers, setup, recordings, options);
  });

  std::vector<Record> records;
  for (const ObservedRecording& one : observed.recordings) records.push_back(estimates_of(one));
  auto made = as_recordings("observed", setup, std::move(records));
  if (report) *report = copy_text(format_json(presentable(to_json(observed, setup))));
  *estimates = made.release();
}

void evaluate_rides(const PlacedModels& models, const dashpot_rides* rides, InPlantSetup setup,
                    PlantEvaluationOptions options, const dashpot_monitor* monitor,
                    dashpot_recordings** runs, char** report) {
  const ObservedDampers dampers = placed(models, setup);
  const std::vector<PlantRecording> recordings = recordings_of(rides, setup);
  PlantEvaluation told;
  run_watched(monitor, [&](const Monitor& watched) {
    options.monitor = watched;
    told = evaluate_in_plant(dampers, setup, recordings, options);
  });

  std::vector<Record> records;
  for (const InPlantTrace& trace : told.traces) records.push_back(run_of(trace, setup));
  auto made = as_recordings("in free run", setup, std::move(records));
  *report = copy_text(format_json(presentable(to_json(told, setup))));
  if (runs) *runs = made.release();
}

/// What the days of a state depend on, by name.
Value basis_of(const PlacedModels& models, const InPlantSetup& setup, const WatchOptions& options) {
  Value basis = Value::object();
  const std::vector<std::string> struts = observer_names(setup).struts;
  for (size_t d = 0; d < models.size(); ++d)
    basis.add(models.size() == 1 ? "model" : "model of " + struts[d],
              sha256(format_model(models[d]->file)));
  basis.add("plant", sha256(format_json(to_json(setup), false)));
  basis.add("tracked", join(options.wears, ","));
  basis.add("level", options.level);
  basis.add("known", join(options.known, ","));
  return basis;
}

/// Days that were looked at before, and the plant as they found it.
struct WatchHistory {
  std::optional<Value> found;
  std::vector<WatchedDay> days;
};
WatchHistory history_of(const std::optional<Value>& state, const Value& basis) {
  WatchHistory history;
  if (!state) return history;
  ObjectReader reader(*state, "the JSON");
  const Value& stated = reader.required("basis");
  for (const auto& [name, now] : basis.members()) {
    const Value* then = stated.find(name);
    if (!then || then->as_string() != now.as_string())
      throw Error("options, state", "is of another " + name, "begin with a new one: without it");
  }
  history.found = reader.required("found");
  for (const Value& day : reader.required("days").items())
    history.days.push_back(watched_day_from_json(day));
  reader.finish();
  return history;
}

/// The charts of all days as JSON, and the state that the next days go on from.
std::string watch_rides(const PlacedModels& models, const dashpot_rides* rides, InPlantSetup setup,
                        WatchWords words, const dashpot_monitor* monitor) {
  const ObservedDampers dampers = placed(models, setup);
  WatchOptions& options = words.options;
  const Value basis = basis_of(models, setup, options);
  WatchHistory history = history_of(words.state, basis);
  std::vector<PlantRecording> recordings = recordings_of(rides, setup, options.known);

  // Days are taken as they come, whatever their names say.
  Value warnings = Value::array();
  std::vector<std::string> names = {history.days.empty() ? "" : history.days.back().estimate.name};
  names.insert(names.end(), rides->names.begin(), rides->names.end());
  if (std::string disorder = day_disorder(names); !disorder.empty())
    warnings.push_back(std::move(disorder));

  // The plant as the state has it, or as the first days show it; then each new day.
  WatchedPlant watched;
  std::vector<WatchedDay> days(recordings.size());
  run_watched(monitor, [&](const Monitor& watching) {
    options.monitor = watching;
    if (history.found) {
      watched = watched_again(dampers, setup, *history.found, options);
    } else {
      require_watchable(setup, options);
      const std::size_t first = std::min(kPreparationDays, recordings.size());
      watched =
          watched_plant(dampers, setup, {recordings.begin(), recordings.begin() + first}, options);
    }
    parallel_for(days.size(), options.threads, [&](std::size_t d) {
      watching.check();
      days[d] = watch_day(watched, recordings[d], options);
    });
  });
  std::ranges::move(days, std::back_inserter(history.days));

  // What they say.
  const std::vector<WatchedQuantity> quantities = watch_charts(watched, history.days, options);
  Value told = to_json(Watched{watched, history.days, quantities, options}), kept = Value::array();
  for (const WatchedDay& day : history.days) kept.push_back(to_json(day));
  for (std::string& doubt : hardly_apart(watched)) warnings.push_back(std::move(doubt));
  for (std::string& day : odd_days(quantities, history.days)) warnings.push_back(std::move(day));
  told.add("warnings", std::move(warnings));
  told.add(
      "state",
      Value::object({{"basis", basis}, {"found", found_of(watched)}, {"days", std::move(kept)}}));
  return format_json(presentable(told));
}

}  // namespace

dashpot_status dashpot_rides_new(dashpot_rides** rides) {
  return guarded([&] {
    require(rides, "rides");
    *rides = nullptr;
    *rides = new dashpot_rides;
  });
}

dashpot_status dashpot_rides_load(dashpot_rides* rides, const char* path) {
  return guarded([&] {
    require(rides, "rides");
    require(path, "path");
    std::vector<RawTable> tables;
    for (const SourcePath& file : list_files({path})) {
      std::vector<RawTable> read = read_tables(file.path);
      if (read.size() != 1)
        throw Error(file.path.string(), "holds " + std::to_string(read.size()) + " tables",
                    "one recording of the plant per file");
      read.front().file = file.path.filename().string();
      tables.push_back(std::move(read.front()));
    }
    if (tables.empty()) throw Error(path, "holds no file", "a file or a folder of recordings");
    for (const RawTable& table : tables) rides->names.push_back(table.file);
    std::ranges::move(tables, std::back_inserter(rides->tables));
  });
}

dashpot_status dashpot_rides_add(dashpot_rides* rides, const dashpot_table* table) {
  return guarded([&] {
    require(rides, "rides");
    require(table, "table");
    require(table->columns, "columns");
    if (table->conditions)
      throw Error("conditions", "mean nothing to a plant", "a null pointer in their place");
    const std::string name =
        table->name ? table->name : "ride " + std::to_string(rides->tables.size() + 1);
    rides->tables.push_back(copy_table(*table, name));
    rides->names.emplace_back(table->name ? name : "");
  });
}

size_t dashpot_rides_count(const dashpot_rides* rides) { return rides ? rides->tables.size() : 0; }

void dashpot_rides_free(dashpot_rides** rides) { give_back(rides); }

dashpot_status dashpot_identify_in_plant(const dashpot_rides* rides, const char* plant,
                                         const char* options, const dashpot_monitor* monitor,
                                         dashpot_model** model, char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(model, "model");
    *model = nullptr;
    InPlantWork work = work_of(rides, plant, options);
    require_alike(work.setup, "dashpot_identify_in_plant");
    work.setup.kinds.are_stated = true;
    const InPlantReport found = identify(work, monitor, report);
    *model = model_of(found.kinds.front(), found, work);
  });
}

dashpot_status dashpot_identify_dampers_in_plant(const dashpot_rides* rides, const char* plant,
                                                 const char* options,
                                                 const dashpot_monitor* monitor,
                                                 dashpot_model** models, size_t room, size_t* count,
                                                 char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(models, "models");
    require(count, "count");
    std::fill_n(models, room, nullptr);
    *count = 0;
    const InPlantWork work = work_of(rides, plant, options);
    if (room < work.setup.dampers())
      throw Error(
          "room", "is " + std::to_string(room),
          "one for each of the plant's " + std::to_string(work.setup.dampers()) + " dampers");
    const InPlantReport found = identify(work, monitor, report);
    for (const FoundDamper& damper : found.kinds)
      models[(*count)++] = model_of(damper, found, work);
  });
}

dashpot_status dashpot_observe(const dashpot_model* model, const dashpot_rides* rides,
                               const char* plant, const char* options,
                               const dashpot_monitor* monitor, dashpot_recordings** estimates,
                               char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(estimates, "estimates");
    *estimates = nullptr;
    InPlantSetup setup = setup_of(plant);
    const PlacedModels models = in_each_strut(model, setup);
    observe_rides(models, rides, std::move(setup), read_observe_options(options), monitor,
                  estimates, report);
  });
}

dashpot_status dashpot_observe_dampers(const dashpot_placed_model* dampers, size_t count,
                                       const dashpot_rides* rides, const char* plant,
                                       const char* options, const dashpot_monitor* monitor,
                                       dashpot_recordings** estimates, char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(estimates, "estimates");
    *estimates = nullptr;
    InPlantSetup setup = setup_of(plant);
    const PlacedModels models = by_struts(dampers, count, setup);
    observe_rides(models, rides, std::move(setup), read_observe_options(options), monitor,
                  estimates, report);
  });
}

dashpot_status dashpot_evaluate_in_plant(const dashpot_placed_model* dampers, size_t count,
                                         const dashpot_rides* rides, const char* plant,
                                         const char* options, const dashpot_monitor* monitor,
                                         dashpot_recordings** runs, char** report) {
  return guarded([&] {
    if (runs) *runs = nullptr;
    require(report, "report");
    *report = nullptr;
    InPlantSetup setup = setup_of(plant);
    const PlacedModels models = by_struts(dampers, count, setup);
    evaluate_rides(models, rides, std::move(setup), read_plant_evaluation_options(options), monitor,
                   runs, report);
  });
}

dashpot_status dashpot_watch(const dashpot_model* model, const dashpot_rides* rides,
                             const char* plant, const char* options, const dashpot_monitor* monitor,
                             char** report) {
  return guarded([&] {
    require(report, "report");
    *report = nullptr;
    InPlantSetup setup = setup_of(plant);
    const PlacedModels models = in_each_strut(model, setup);
    *report = copy_text(
        watch_rides(models, rides, std::move(setup), read_watch_options(options), monitor));
  });
}

dashpot_status dashpot_watch_dampers(const dashpot_placed_model* dampers, size_t count,
                                     const dashpot_rides* rides, const char* plant,
                                     const char* options, const dashpot_monitor* monitor,
                                     char** report) {
  return guarded([&] {
    require(report, "report");
    *report = nullptr;
    InPlantSetup setup = setup_of(plant);
    const PlacedModels models = by_struts(dampers, count, setup);
    *report = copy_text(
        watch_rides(models, rides, std::move(setup), read_watch_options(options), monitor));
  });
}
