#include "dashpot/machine/observe.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "console.h"
#include "dampers_in_plant.h"
#include "dashpot/base/date.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/record/record_file.h"
#include "dashpot/report/quantity.h"
#include "data.h"
#include "document_text.h"
#include "observe_options.h"
#include "units.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct ObserveSettings {
  std::string model, plant, truth, units, velocity_shift, folder = "dashpot-observed";
  std::vector<std::string> recordings;
  std::vector<std::string> force_errors;
  double level = 90;
  int steps = 0, threads = 0;
  bool causal = false;
};

constexpr std::string_view kObserveExample =
    "# The damper, found in a car whose road was measured; then its force on drives without\n"
    "# sensors of force or road (in city.yaml the road has no channel, but a class and a speed):\n"
    "dashpot identify drive.csv --in car.yaml --models tanh_kwok --output results\n"
    "dashpot observe results/models/tanh_kwok.json --in city.yaml city.csv --output city\n"
    "\n"
    "# What an ECU would know at each instant, without the future:\n"
    "dashpot observe results/models/tanh_kwok.json --in city.yaml city.csv --causal\n"
    "\n"
    "# A virtual campaign, judged by its truth:\n"
    "dashpot bench --in car.yaml --output rides\n"
    "dashpot observe model.json --in car.yaml rides --truth rides/truth\n"
    "\n"
    "# A half car whose dampers are not alike:\n"
    "dashpot observe front=firm.json,rear=soft.json --in half.yaml drive.csv";

/// Where the truth is known: how far the estimates are from it.
struct TruthFigure {
  std::string recording, quantity, unit;
  double error = 0, span = 0;  ///< rms; largest less least of the truth
  double inside = 0;           ///< share of the samples within the band
};

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The truth of each recording, of what is estimated; none where it is not known.
std::vector<PlantRecording> read_truths(const ObserveSettings& settings,
                                        const ObserveReport& report) {
  std::vector<PlantRecording> truths;
  if (settings.truth.empty()) return truths;
  std::vector<std::string> forces;
  for (const std::string& strut : report.struts)
    forces.push_back(force_name(strut, report.struts.size()));
  for (const ObservedRecording& observed : report.recordings) {
    std::vector<std::string> names;
    for (const ObservedQuantity& q : observed.quantities) names.push_back(q.name);

    const fs::path path = settings.truth;
    truths.push_back(
        read_plant_recording(fs::is_directory(path) ? path / observed.name : path, forces, names));
  }
  return truths;
}

/// The first second, in which the filter settles, does not count.
std::vector<TruthFigure> truth_figures(const ObservedRecording& observed,
                                       const PlantRecording& truth) {
  const std::size_t count = observed.quantities.front().value.size(),
                    first = std::min(count / 2, static_cast<std::size_t>(1 / observed.sample_time));
  if (truth.samples != count)
    throw Error(truth.name,
                "has " + std::to_string(truth.samples) + " samples, and " + observed.name + " " +
                    std::to_string(count),
                "the truth of the same recording");

  // Of each quantity that the truth has: how far it is off, and how often within its band.
  std::vector<TruthFigure> figures;
  for (const ObservedQuantity& q : observed.quantities) {
    const auto channel = std::ranges::find(truth.channels, q.name, &Channel::name);
    if (channel == truth.channels.end()) continue;
    TruthFigure figure{.recording = observed.name, .quantity = q.name, .unit = q.unit};
    double low = INFINITY, high = -INFINITY, square = 0, inside = 0;
    for (std::size_t k = first; k < count; ++k) {
      const double error = q.value[k] - channel->samples[k];
      square += error * error;
      inside += std::abs(error) <= q.half[k];
      low = std::min(low, channel->samples[k]);
      high = std::max(high, channel->samples[k]);
    }
    const auto samples = static_cast<double>(count - first);
    figure.error = std::sqrt(square / samples);
    figure.span = high - low;
    figure.inside = inside / samples;
    figures.push_back(figure);
  }
  return figures;
}

std::vector<TruthFigure> compared(const ObserveReport& report,
                                  const std::vector<PlantRecording>& truths) {
  std::vector<TruthFigure> all;
  for (std::size_t r = 0; r < truths.size(); ++r) {
    const std::vector<TruthFigure> figures = truth_figures(report.recordings[r], truths[r]);
    all.insert(all.end(), figures.begin(), figures.end());
  }
  return all;
}

DocumentTable truth_table(const std::vector<TruthFigure>& figures, double level) {
  DocumentTable table{.title = "Against the truth",
                      .columns = {{"recording"},
                                  {"quantity"},
                                  {"unit"},
                                  {"rms error", true},
                                  {"% of span", true},
                                  {"in band %", true}},
                      .rows = {}};
  for (const TruthFigure& f : figures)
    table.rows.push_back({f.recording, f.quantity, unit_name(f.unit), quantity(f.error, f.unit),
                          format_number(100 * f.error / f.span, 3),
                          format_number(100 * f.inside, 3)});
  table.note = fmt::format("The bands claim {} %. The first second does not count.",
                           format_number(level, 3));
  return table;
}

DocumentTable quantity_table(const ObserveReport& report, double level) {
  DocumentTable table{.title = "Estimates",
                      .columns = {{"recording"},
                                  {"quantity"},
                                  {"unit"},
                                  {"least", true},
                                  {"greatest", true},
                                  {"half band, mean", true}},
                      .rows = {}};
  for (const ObservedRecording& one : report.recordings)
    for (const ObservedQuantity& q : one.quantities) {
      const auto [low, high] = std::ranges::minmax(q.value);
      table.rows.push_back({one.name, q.name, unit_name(q.unit), plain_quantity(low, q.unit),
                            plain_quantity(high, q.unit), plain_quantity(mean_of(q.half), q.unit)});
    }
  table.note = fmt::format("Each band is to hold {} % of the time.", format_number(level, 3));
  return table;
}

DocumentTable observed_sensors(const ObserveReport& report, double level) {
  DocumentTable table{.title = "Sensors, one sample ahead",
                      .columns = {{"recording"},
                                  {"sensor"},
                                  {"unit"},
                                  {"rms of signal", true},
                                  {"unexpected, rms", true},
                                  {"in band %", true},
                                  {"offset", true, 1}},
                      .rows = {}};
  for (const ObservedRecording& one : report.recordings)
    for (const ObservedSensor& s : one.sensors)
      table.rows.push_back({one.name, s.channel, unit_name(s.unit), quantity(s.rms, s.unit),
                            quantity(s.surprise, s.unit), format_number(100 * s.inside, 3),
                            quantity(s.offset, s.unit, 2)});
  table.note = fmt::format(
      "What a sensor showed beyond what the samples before had led to expect; {} % of it is to lie "
      "within its band.",
      format_number(level, 3));
  return table;
}

/// What was taken as uncertain, in words that the plant's file and the options understand.
std::vector<std::string> noise_lines(const ObserveReport& report, const InPlantSetup& setup) {
  const Plant plant = make_plant(*setup.model, setup.known);
  std::vector<std::string> lines;

  // The errors of the forces, as they are read and as the option takes them.
  std::string errors, words;
  for (const ForceError& one : report.noise.force) {
    const bool stays = one.memory >= kStayingError;
    const std::string memory = format_number(one.memory, 3);
    errors += (errors.empty() ? "" : "; ") + quantity(one.deviation, "N") + ' ' + unit_name("N") +
              (stays ? ", which stay" : ", forgotten in " + memory + " s");
    words +=
        (words.empty() ? "" : ",") + format_number(one.deviation, 3) + (stays ? "" : "@" + memory);
  }
  lines.push_back((report.struts.size() > 1 ? "Errors of each damper's force: "
                                            : "Errors of the model's force: ") +
                  errors + " (--force-error " + words + ").");
  if (const auto [deviation, memory] = report.noise.shift; deviation > 0)
    lines.push_back(fmt::format(
        "The model's force goes by a velocity within {} {} of the damper's, forgotten in {} s "
        "(--velocity-shift {}@{}).",
        quantity(deviation, "m/s"), unit_name("m/s"), format_number(memory, 3),
        format_number(deviation, 3), format_number(memory, 3)));

  if (report.forces_known_within > 0)
    lines.push_back("All forces together: within " +
                    format_number(100 * report.forces_known_within, 2) +
                    " % (95 %), as the plant's mass was found.");

  // The sensors, and roads that nothing measured.
  const auto origin = [](double noise, const IdentifiedNoise& identified) {
    if (!(noise > 0)) return std::string("found in these recordings");
    return identified.from.empty() ? "as stated" : "as identified (" + identified.from + ")";
  };
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const PlantSensor& sensor = setup.sensors[s];
    const std::string unit = unit_of(sensor.place, plant);
    lines.push_back(fmt::format("Noise of {}: {} {}, {}.", sensor.channel,
                                quantity(report.noise.sensors[s], unit), unit_name(unit),
                                origin(sensor.noise, sensor.identified)));
  }
  for (const PlantInputChannel& input : setup.inputs)
    if (const std::string unit = unit_of(input.place.kind); input.noise > 0)
      lines.push_back(fmt::format("Noise of {}: {} {}, {}.", input.channel,
                                  quantity(input.noise, unit), unit_name(unit),
                                  origin(input.noise, input.identified)));
  if (const RoadPrior* road = unmeasured_road(setup))
    lines.push_back(fmt::format(
        "Road, not measured: G_d(n0) {} m^3 at {} m/s{}.", format_number(report.noise.roughness, 3),
        format_number(road->speed, 3), road->roughness > 0 ? ", as its class says" : ", found"));
  lines.push_back(fmt::format("{} of the filter per sample.",
                              counted(static_cast<std::size_t>(report.steps), "step")));
  return lines;
}

/// One quantity with its band, over samples of the document; the truth behind, where it is known.
FigurePanel observed_panel(const ObservedQuantity& q, double level, std::size_t time,
                           const Channel* truth,
                           const std::function<std::size_t(const std::vector<double>&)>& keep) {
  FigurePanel panel{.title = q.name,
                    .x_label = "Time",
                    .y_label = q.name,
                    .series = {},
                    .reads_along_x = true,
                    .x_unit = "s",
                    .y_unit = q.unit};
  const std::size_t value = keep(q.value), half = keep(q.half);

  // From the back to the front: the band, the truth, the estimate.
  panel.series.push_back({.label = format_number(level, 3) + " % band",
                          .colour = "modelled",
                          .x = {},
                          .y = {},
                          .mark = FigureSeries::Mark::Area,
                          .is_read = false,
                          .opacity = 0.2,
                          .shared = SharedCurve{.x = time, .y = value, .half_width = half}});
  if (truth)
    panel.series.push_back({.label = "truth",
                            .colour = "measured",
                            .x = {},
                            .y = {},
                            .shared = SharedCurve{.x = time, .y = keep(truth->samples)}});
  panel.series.push_back({.label = "estimate",
                          .colour = "modelled",
                          .x = {},
                          .y = {},
                          .shared = SharedCurve{.x = time, .y = value}});
  return panel;
}

/// The force and the motion of the first recording with their bands, and the truth behind.
DocumentFigure observed_figure(const ObserveReport& report,
                               const std::vector<PlantRecording>& truths, double level,
                               Document& document) {
  constexpr std::size_t kMostShown = 3000;
  const ObservedRecording& one = report.recordings.front();
  DocumentFigure figure{
      .name = "observed",
      .title = "Estimates with their bands",
      .caption = fmt::format("{}, its first {} samples at most.", one.name, kMostShown),
      .panels = {}};

  // The samples stand in the document, where curves share them.
  const std::size_t count = std::min(kMostShown, one.quantities.front().value.size());
  const auto keep = [&](const std::vector<double>& samples, const std::string& unit) {
    document.samples.push_back(
        {.values = {samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count)},
         .unit = unit});
    return document.samples.size() - 1;
  };
  std::vector<double> time;
  for (std::size_t k = 0; k < count; ++k) time.push_back(one.sample_time * static_cast<double>(k));
  const std::size_t at = keep(time, "s");

  for (const ObservedQuantity& q : one.quantities) {
    const Channel* truth = nullptr;
    if (!truths.empty())
      for (const Channel& channel : truths.front().channels)
        if (channel.name == q.name) truth = &channel;
    figure.panels.push_back(
        observed_panel(q, level, at, truth,
                       [&](const std::vector<double>& samples) { return keep(samples, q.unit); }));
  }
  return figure;
}

Value truth_json(const std::vector<TruthFigure>& truth) {
  Value against = Value::array();
  for (const TruthFigure& f : truth)
    against.push_back(Value::object({{"recording", f.recording},
                                     {"quantity", f.quantity},
                                     {"unit", f.unit},
                                     {"error", f.error},
                                     {"span", f.span},
                                     {"inside", f.inside}}));
  return against;
}

Document observe_document(const ObserveReport& report, const std::vector<PlantRecording>& truths,
                          const InPlantSetup& setup, const ObserveSettings& settings,
                          const ObservedDampers& dampers, const Console& console) {
  Document document{.title = report.struts.size() > 1
                                 ? "A plant observed through its dampers' models"
                                 : "A plant observed through its damper's model",
                    .subtitle = std::string(setup.model->title),
                    .verdict = {},
                    .sections = {},
                    .command = console.command_line(),
                    .version = DASHPOT_VERSION,
                    .date = date_now(),
                    .kind = "observation",
                    .units = page_units(settings.units)};
  const std::vector<TruthFigure> truth = compared(report, truths);

  // Each force in one sentence: how sure it is, and where known how wrong; of several recordings
  // those of the first.
  const std::size_t others = report.recordings.size() - 1;
  const std::string of_which =
      others == 0 ? ""
                  : " of " + report.recordings.front().name + " (the table has " +
                        (others == 1 ? "the other one" : std::to_string(others) + " more") + ")";
  for (std::size_t d = 0; d < report.struts.size(); ++d) {
    const ObservedQuantity& force = report.recordings.front().quantities[d];
    const bool is_one = report.struts.size() == 1;
    document.verdict += fmt::format(
        "{}The force of the {}damper ({}) is estimated with a {} % band of ±{} {}, {}{}.",
        d > 0 ? " " : "", is_one ? "" : report.struts[d] + " ", dampers[d].model->name(),
        format_number(settings.level, 3), quantity(mean_of(force.half), "N"), unit_name("N"),
        settings.causal ? "from the past alone" : "from the whole recording", of_which);
    for (const TruthFigure& f : truth)
      if (f.quantity == force.name && f.recording == report.recordings.front().name)
        document.verdict += fmt::format(
            " It is {} % of its span from the truth (rms), which lies in the band {} % of "
            "the time.",
            format_number(100 * f.error / f.span, 3), format_number(100 * f.inside, 3));
  }

  if (!report.warnings.empty()) document.verdict += " These bands are in doubt: see the warnings.";

  add_doubts(report.warnings, document);
  DocumentSection section{.name = "observed", .title = "Observed", .paragraphs = {}};
  if (!truth.empty()) section.tables.push_back(truth_table(truth, settings.level));
  section.tables.push_back(quantity_table(report, settings.level));
  section.tables.push_back(observed_sensors(report, settings.level));
  section.figures = {observed_figure(report, truths, settings.level, document)};
  section.lists = {{.title = report.noise_was_found
                                 ? "Uncertainties; what was not stated was found as that under "
                                   "which the recordings are most likely"
                                 : "Uncertainties",
                    .lines = noise_lines(report, setup)}};
  document.sections.push_back(std::move(section));
  document.data = to_json(report, setup);
  document.data.add("truth", truth_json(truth));
  return document;
}

int run_observe(const ObserveSettings& settings, Console& console) {
  // All that can be wrong is found before the work.
  if (settings.plant.empty())
    throw UsageError("--in", "is missing", "the plant and its sensors: docs/in-plant.md");
  if (settings.recordings.empty()) throw UsageError("RECORDING", "is missing", "a file");
  if (!(settings.level > 0 && settings.level < 100))
    throw UsageError("--band", "is not between 0 and 100 %", "90");
  InPlantSetup setup = read_in_plant_setup(settings.plant);
  require_setup(setup);
  const ObservedDampers dampers =
      load_dampers(model_files(settings.model, setup), "observe", setup, console);
  page_units(settings.units);
  std::vector<PlantRecording> recordings;
  for (const std::string& name : recording_files(settings.recordings))
    recordings.push_back(read_plant_recording(name, setup.channels()));
  if (const std::string note = without_units(recordings); !note.empty()) console.note(note);
  if (const std::string note = unread_drives(recordings);
      !note.empty() && setup.drive_channels().empty())
    console.note(note);
  if (!settings.truth.empty() && recordings.size() > 1 && !fs::is_directory(settings.truth))
    throw UsageError("--truth", "is one file for several recordings",
                     "a folder with a file of each recording's name");

  // The work, then what came out of it.
  const ObserveOptions options{.causal = settings.causal,
                               .force = force_errors(settings.force_errors),
                               .shift = velocity_shift(settings.velocity_shift),
                               .steps = settings.steps,
                               .level = settings.level / 100,
                               .threads = settings.threads,
                               .monitor = console.monitor()};
  const ObserveReport report = observe(dampers, setup, recordings, options);
  const Document document =
      observe_document(report, read_truths(settings, report), setup, settings, dampers, console);
  print_document(document, console);
  for (const std::string& line : noise_lines(report, setup))
    console.print(in_units(line, document.units) + '\n');
  for (const std::string& warning : report.warnings) console.warn(warning);

  // Files: the page and the samples.
  const fs::path folder = settings.folder;
  std::string where = "\n" + write_document(document, folder, "report");
  for (const ObservedRecording& one : report.recordings)
    save_csv(estimates_of(one), folder / (fs::path(one.name).stem().string() + "_observed.csv"),
             file_units(settings.units));
  console.print(where + "Samples  " + (folder / "*_observed.csv").string() + '\n');
  if (console.json) console.print_json(document_json(document));
  return kDone;
}

}  // namespace

Command observe_command() {
  auto settings = std::make_shared<ObserveSettings>();
  ObserveSettings& s = *settings;
  return {
      .name = "observe",
      .title = "A damper's force, speeds and road where no sensor shows them",
      .description =
          "Follows a plant (a car, a building, an oscillator) through a recording with the models "
          "of its dampers, by a Kalman filter and a smoother behind it: each damper's force, which "
          "no sensor measures, deflections and velocities, and the road where nothing measured it, "
          "each with a band. A model may be wrong: the error of its force is one of the unknowns. "
          "How large that is, and the sensors' noise where neither the plant states it nor the "
          "'identify --in' that made its file or the model found it, is found from the recordings.",
      .options =
          {// The damper, the recordings, and the plant.
           model_of_each_option(s.model),
           {.names = "RECORDING",
            .target = &s.recordings,
            .help = "recordings of the plant, one table each, or folders of them",
            .takes = Takes::File,
            .required = true},
           {.names = "--in",
            .target = &s.plant,
            .help = "the plant with all its numbers known, and its sensors, as a YAML file or "
                    "words (docs/in-plant.md); 'identify --in' writes what it found into "
                    "plants/",
            .value = "PLANT",
            .takes = Takes::File},

           // How it is estimated.
           {.names = "--causal",
            .target = &s.causal,
            .help = "each instant from its past alone, as an ECU knows it"},
           force_error_option(s.force_errors),
           velocity_shift_option(s.velocity_shift),
           {.names = "--band",
            .target = &s.level,
            .help = "share of the time that the bands are to hold, %",
            .value = "PERCENT",
            .minimum = 0},
           {.names = "--steps",
            .target = &s.steps,
            .help = "steps of the filter per sample",
            .value = "N",
            .minimum = 0,
            .default_text = "as many as its error asks for"},

           // What it is judged by, and where it goes.
           {.names = "--truth",
            .target = &s.truth,
            .help = "where the truth is known, as of 'dashpot bench --in': its file, or a "
                    "folder with a file of each recording's name; needs damper_force, of several "
                    "dampers front_damper_force and so on",
            .value = "PATH",
            .takes = Takes::File},
           {.names = "-o,--output",
            .target = &s.folder,
            .help = "folder for the report and the samples",
            .value = "DIR",
            .takes = Takes::Folder},
           units_option(s.units),
           threads_option(s.threads)},
      .example = std::string(kObserveExample),
      .run = [settings](Console& console) { return run_observe(*settings, console); }};
}

}  // namespace dashpot::cli
