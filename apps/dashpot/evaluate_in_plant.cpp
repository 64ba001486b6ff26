#include "evaluate_in_plant.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "console.h"
#include "dampers_in_plant.h"
#include "dashpot/base/date.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/report/quantity.h"
#include "data.h"
#include "document_text.h"
#include "sensor_figure.h"
#include "stated_plant_section.h"
#include "traces.h"
#include "units.h"

namespace dashpot::cli {
namespace {

double share_of(const SensorFigures& figure) { return 100 * figure.training / figure.rms; }

/// A sensor over all recordings: of its mean squares each sample counts as much, of its errors each
/// that was compared.
SensorFigures pooled(const PlantEvaluation& told, std::size_t sensor, std::size_t sensors) {
  SensorFigures all = told.sensors[sensor];
  double samples = 0, compared = 0, squares = 0, errors = 0;
  for (std::size_t r = 0; r < told.traces.size(); ++r) {
    const SensorFigures& own = told.sensors[r * sensors + sensor];
    const InPlantTrace& trace = told.traces[r];
    const auto count = static_cast<double>(trace.measured[sensor].size()),
               judged = static_cast<double>(trace.training - trace.first);
    samples += count;
    compared += judged;
    squares += count * own.rms * own.rms;
    errors += judged * own.training * own.training;
  }
  all.recording = "all";
  all.rms = std::sqrt(squares / samples);
  all.training = std::sqrt(errors / compared);
  return all;
}

DocumentTable sensor_table(const PlantEvaluation& told, std::size_t sensors) {
  DocumentTable table{.title = "Sensors, in free run of the whole plant",
                      .columns = {{"recording"},
                                  {"sensor"},
                                  {"unit"},
                                  {"rms of signal", true},
                                  {"rms error", true},
                                  {"error %", true},
                                  {"offset", true, 1}},
                      .rows = {}};

  // Every recording, then all of them together.
  const auto add = [&](const SensorFigures& s, const std::string& offset) {
    table.rows.push_back({s.recording, s.channel, unit_name(s.unit), quantity(s.rms, s.unit, 4),
                          quantity(s.training, s.unit, 4), format_number(share_of(s), 3), offset});
  };
  for (const SensorFigures& s : told.sensors) add(s, quantity(s.offset, s.unit, 2));
  for (std::size_t s = 0; s < sensors && told.traces.size() > 1; ++s)
    add(pooled(told, s, sensors), "");
  table.note =
      "Errors are after each sensor's offset; where the plant is at the beginning is found unless "
      "the plant's file says 'start: rest'. Nothing else is fitted.";
  return table;
}

/// Recordings of which a model's fit has seen some time, by their content.
std::vector<std::string> seen_files(const std::vector<std::string>& models,
                                    const std::vector<std::string>& recordings) {
  std::set<std::string> known;
  for (const std::string& model : std::set(models.begin(), models.end()))
    for (const Provenance::File& file : load_model(model).provenance.files)
      known.insert(file.sha256);
  std::vector<std::string> seen;
  std::ranges::copy_if(recordings, std::back_inserter(seen), [&](const std::string& recording) {
    return !known.empty() && known.contains(sha256_of_file(recording));
  });
  return seen;
}

Document evaluation_document(const PlantEvaluation& told, const InPlantSetup& setup,
                             const ObservedDampers& dampers, const std::string& units,
                             const Console& console) {
  Document document{.title = "A plant in free run, with its damper's model",
                    .subtitle = std::string(setup.model->title),
                    .verdict = {},
                    .sections = {},
                    .command = console.command_line(),
                    .version = DASHPOT_VERSION,
                    .date = date_now(),
                    .kind = "evaluation in a plant",
                    .units = page_units(units)};
  const SensorFigures& worst = *std::ranges::max_element(told.sensors, {}, share_of);
  document.verdict =
      std::isfinite(worst.training)
          ? fmt::format(
                "{} in the {}: {} % of the worst sensor's rms is left in free run ({} in "
                "{}).",
                dampers.front().model->name(), setup.model->name, format_number(share_of(worst), 3),
                worst.channel, worst.recording)
          : "The plant diverges: nothing below can be used. Are model and plant those of these "
            "recordings, in the same units?";

  add_doubts(told.warnings, document);
  DocumentSection section{.name = "evaluation", .title = "Judged", .paragraphs = {}};
  section.tables = {sensor_table(told, setup.sensors.size())};
  section.figures = {sensor_figure(told.traces.front(), told.sensors)};
  document.sections.push_back(std::move(section));
  document.sections.push_back(stated_plant_section(setup));
  document.data = to_json(told, setup);
  return document;
}

}  // namespace

int run_evaluate_in_plant(const PlantEvaluateSettings& settings, Console& console) {
  // All that can be wrong is found before the work.
  require_page(settings.report);
  const PrintUnits csv_units = file_units(settings.units);
  InPlantSetup setup = read_in_plant_setup(settings.plant);
  require_setup(setup);
  const std::vector<std::string> models = model_files(settings.model, setup);
  const ObservedDampers dampers = load_dampers(models, "evaluate", setup, console);
  const std::vector<std::string> files = recording_files(settings.recordings);
  std::vector<PlantRecording> recordings;
  for (const std::string& file : files)
    recordings.push_back(read_plant_recording(file, setup.channels()));
  if (const std::string note = without_units(recordings); !note.empty()) console.note(note);
  if (const std::string note = unread_drives(recordings);
      !note.empty() && setup.drive_channels().empty())
    console.note(note);

  // The run, and what is to be said of it.
  PlantEvaluation told = evaluate_in_plant(
      dampers, setup, recordings, {.threads = settings.threads, .monitor = console.monitor()});
  if (const std::vector<std::string> seen = seen_files(models, files); !seen.empty())
    told.warnings.push_back("the fit of the model has seen " + join(seen, ", ") +
                            ": these errors are no judgement");
  const Document document = evaluation_document(told, setup, dampers, settings.units, console);
  print_document(document, console);
  for (const std::string& warning : told.warnings) console.warn(warning);
  if (console.json) console.print_json(document_json(document));
  if (!settings.report.empty()) {
    write_page(document, settings.report);
    console.print("\nReport  " + settings.report + '\n');
  }
  if (!settings.traces.empty()) {
    std::vector<Record> runs;
    for (const InPlantTrace& trace : told.traces) {
      runs.push_back(run_of(trace, setup));
      runs.back().name = std::filesystem::path(trace.recording).stem().string();
    }
    write_records(runs, settings.traces, csv_units, settings.folder);
    console.print(
        fmt::format("\nTraces  {}/ ({})\n", settings.folder, counted(runs.size(), "recording")));
  }
  const bool is_finite = std::ranges::all_of(
      told.sensors, [](const SensorFigures& s) { return std::isfinite(s.training); });
  return is_finite ? kDone : kNotUsable;
}

}  // namespace dashpot::cli
