#include "identify_in_plant.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <tuple>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/model_in_plant.h"
#include "dashpot/machine/plant_fit_store.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/machine/sensor_doubts.h"
#include "dashpot/machine/virtual_campaign.h"
#include "document_text.h"
#include "in_plant_document.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

/// By which models are listed: what could be fitted, then by the error in free run; where nothing
/// measures the road what lacks nothing that is known of, then by what is left of the force.
std::tuple<bool, bool, double> place_of(const InPlantFit& fit) {
  const InPlantReport& report = fit.report;
  const double worst = worst_of(fit);
  return {!std::isfinite(worst), !report.lacks.empty(),
          report.road_measured ? worst : report.force_error};
}

/// Whether even the best of the usual laws leaves a fifth of a sensor, where nobody would use it.
bool lacks_all(const InPlantFit& best) {
  constexpr double kMuch = 20;  // % of the sensor, in free run
  return best.report.road_measured && worst_of(best) > kMuch;
}

bool names_none(const std::vector<std::string>& models) {
  return models == std::vector<std::string>{"usual"};
}

/// The models asked for, each once; "usual" are those that are so in a plant.
std::vector<std::string> models_for(const InPlantSetup& setup,
                                    const std::vector<std::string>& asked) {
  std::vector<std::string> models;
  const auto add = [&](const std::string& model) {
    if (std::ranges::find(models, model) == models.end()) models.push_back(model);
  };
  for (const std::string& word : asked) {
    if (word == "all" || word == "family")
      throw UsageError("--models", "'" + word + "' are models of a bench",
                       "with --in, 'usual' or names, as tanh_kwok");
    if (word == "usual") {
      std::ranges::for_each(usual_in_plant(), add);
      continue;
    }
    require_model_for_plant(word, setup, "--models");
    add(word);
  }
  return models;
}

/// What the fit of a measured force follows alone, what it is ridden by among them, each with what
/// says the same inside a plant.
std::vector<IdleOptions> idle_in_plant(const std::vector<Option>& ride) {
  IdleOptions ridden{.names = {}, .right = "dashpot rank or ride, with the models found"};
  for (const Option& option : ride) ridden.names.push_back(option.long_name());
  return {{{"--leave-out"},
           "",
           "'held_back' of the plant says which share of each recording judges the fit"},
          {{"--prior"}, "", "state --bounds, or a range of the plant's parameters"},
          {{"--search", "--budget"}, "", "--starts says how many starts are tried"},
          {{"--dataset", "--no-recognise"}, "", "the plant says which channel is which"},
          {{"--figures"}, "", "the page has its figures"},
          {{"--pdf"}, "", "print the page, report.html, from a browser"},
          {{"--units"}, "", "leave it out: results are in SI"},
          {{"--allow-active"}, "", "leave it out: models are kept as they fit best"},
          {{"--traces", "--covariance", "--validate", "--from", "--force-offset",
            "--velocity-cutoff", "--keep-inertia", "--verbose"},
           "",
           "leave it out: no force is measured"},
          std::move(ridden)};
}

/// Where finished fits are kept, beside the results, so that an interrupted run goes on; nothing
/// with --fresh.
std::unique_ptr<PlantFitStore> plant_fit_store(const RankingSettings& settings, Console& console) {
  if (settings.fresh) return nullptr;
  const fs::path file = fs::path(settings.results.folder) / "plant-fits.sqlite";
  auto store = std::make_unique<PlantFitStore>(file, program_id());
  tell_dropped(store->dropped(), file, console);
  return store;
}

/// A damper as a file that every other command reads.
void save_damper(const InPlantFit& fit, const FoundDamper& damper, const InPlantSetup& setup,
                 const std::vector<std::string>& paths, double sample_time, const fs::path& folder,
                 Console& console) {
  ModelFile file = found_damper(damper, fit.report, setup, sample_time);
  const std::string name = fit.model + (damper.name.empty() ? "" : "." + damper.name);

  // What it was fitted to, so that it is not judged by that unawares.
  file.provenance.created = date_now();
  file.provenance.command = console.command_line();
  file.provenance.dataset = "identified in a plant: " + std::string(setup.model->name);
  for (const std::string& path : paths) {
    file.provenance.files.push_back({path, sha256_of_file(path)});
    file.provenance.training_records.push_back(fs::path(path).filename().string());
  }

  if (!file.dissipation->dissipates())
    console.warn(name + ": " + activity(*file.dissipation, file.drive_unit));
  save_model(file, folder / (name + ".json"));
}

}  // namespace

std::vector<Option> in_plant_options(InPlantSettings& settings, const std::vector<Option>& ride) {
  std::vector<std::string> grades;
  for (const SensorGrade& grade : sensor_grades())
    if (grade.sensors[0] > 0) grades.push_back(grade.name);
  return {{.names = "--in",
           .target = &settings.plant,
           .help = "the plant in which the damper worked when DATA were recorded, and its sensors: "
                   "a YAML file or words (docs/in-plant.md)",
           .value = "PLANT",
           .takes = Takes::File,
           .default_text = "a bench that measures the damper's force",
           .idles = idle_in_plant(ride),
           .details = "; the models of --models (unasked some usual laws) are identified as part "
                      "of it, with its unknown numbers: laws in free run, others along the best "
                      "of these laws"},
          {.names = "--grade",
           .target = &settings.grade,
           .help = "with --in: the grade of the sensors that it tries beside those that are there",
           .value = "NAME",
           .choices = grades,
           .noun = "grade",
           .needs = "--in"},
          {.names = "--profile",
           .target = &settings.profiles,
           .help = "with --in: numbers of plant and damper whose misfit is followed with all "
                   "others fitted anew; those that no sensor tells are so unasked",
           .value = "LIST",
           .needs = "--in"}};
}

int run_in_plant(const InPlantSettings& asked, const RankingSettings& settings, Console& console) {
  // All that can be wrong is found before the work.
  const InPlantSetup setup = read_in_plant_setup(asked.plant);
  const std::vector<std::string> wanted = models_for(setup, settings.fit.models);
  if (settings.fit.options.asymmetric && !unmeasured_road(setup))
    throw UsageError("--asymmetric", "has no meaning where the road is measured",
                     "both sides of the damper are alike there");
  const IdentifyOptions fit = identify_options(settings.fit, wanted, console);
  const std::vector<std::string> files = recording_files(settings.data.paths);
  std::vector<PlantRecording> recordings;
  for (const std::string& file : files)
    recordings.push_back(read_plant_recording(file, setup.channels()));
  if (const std::string note = without_units(recordings); !note.empty()) console.note(note);
  if (const std::string note = unread_drives(recordings);
      !note.empty() && setup.drive_channels().empty())
    console.note(note);
  const std::string left_out = still_parts(setup, recordings);
  prepare_results(settings.results);
  const std::unique_ptr<PlantFitStore> store = plant_fit_store(settings, console);

  // Each model in turn, the best first.
  InPlantOptions options{
      .choices = fit.choices,
      .network = fit.network,
      .asymmetric = fit.asymmetric || (names_none(settings.fit.models) && unmeasured_road(setup)),
      .seed = fit.seed,
      .threads = fit.threads,
      .grade = asked.grade,
      .profiles = asked.profiles,
      .monitor = fit.monitor};
  options.starts = std::max(options.starts, fit.starts);
  std::vector<InPlantFit> fits = identify_in_plant(wanted, setup, recordings, options, store.get());
  tell_kept(static_cast<std::size_t>(std::ranges::count_if(fits, &InPlantFit::was_kept)), console);
  std::ranges::stable_sort(fits, {}, place_of);

  // What came out of it; of laws that nobody asked for, what speaks against the best.
  const auto doubted = std::span(fits).first(names_none(settings.fit.models) ? 1 : fits.size());
  const Document document = in_plant_document(fits, doubted, left_out, setup, console);
  print_document(document, console);
  for (const InPlantFit& one : doubted)
    for (const std::string& warning : one.report.warnings) console.warn(one.model + ": " + warning);
  if (names_none(settings.fit.models) && lacks_all(fits.front()))
    console.warn(
        "none of the usual laws comes near these sensors: name other models, or a law of your own "
        "(docs/laws-from-a-file.md; examples/laws/duhem.yaml is a hysteresis without a name, of a "
        "damper whose current never changes)");
  const fs::path folder = settings.results.folder, models = folder / "models",
                 plants = folder / "plants";
  for (const InPlantFit& one : fits)
    if (one.report.has_models()) {
      for (const FoundDamper& damper : one.report.kinds)
        save_damper(one, damper, setup, files, recordings.front().sample_time, models, console);
      write_file(plants / (one.model + ".json"), format_json(to_json(as_found(setup, one.report))));
    }
  const bool has_follower = std::ranges::any_of(
      setup.inputs, [](const PlantInputChannel& one) { return !one.follows.empty(); });
  std::string where = "\n";
  if (settings.results.report) where += write_document(document, folder, "report");
  console.print(where + "Models   " + models.string() + "/\nPlants   " + plants.string() +
                "/, as they were found" + (has_follower ? "\n" : ", for 'dashpot observe'\n"));
  if (console.json) console.print_json(document_json(document));
  if (!std::isfinite(worst_of(fits.front()))) return kNotUsable;
  if (fits.front().report.road_measured && is_far_off(setup, fits.front().report.traces)) {
    console.error("no model comes near any sensor: the warnings say what to look at");
    return kNotUsable;
  }
  return kDone;
}

}  // namespace dashpot::cli
