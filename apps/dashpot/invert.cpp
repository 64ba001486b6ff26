#include <algorithm>
#include <cmath>
#include <memory>

#include "commands.h"
#include "console.h"
#include "damper_choice.h"
#include "dashpot/base/date.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/damper/inverse/numeric.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/fit_inverse.h"
#include "dashpot/rank.h"
#include "dashpot/report/track_figure.h"
#include "dashpot/report/words.h"
#include "data.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

struct InvertSettings {
  DamperChoice damper;
  DataSettings recordings;
  std::vector<std::string> networks = {"chang_zhou"};
  std::string file = "inverse.json", figure;
  double amplitude = 0, frequency = 0, step = 5, rate_limit = 0;  // mm, Hz, ms, A/s
  std::uint64_t seed = 1;
  int threads = 0;
};

constexpr std::string_view kInvertExample =
    "# An inverse of a model, and how it follows a wanted force:\n"
    "dashpot invert results/models/tanh_kwok.json --output inverse.json\n"
    "dashpot track results/models/tanh_kwok.json --inverse inverse.json,numeric\n"
    "\n"
    "# Which network does best without a velocity sensor, or with it alone? The best is saved:\n"
    "dashpot invert --parameters spencer1997 --network metered,one_sensor\n"
    "\n"
    "# Taught by the recordings themselves; the model only judges:\n"
    "dashpot invert results/models/tanh_kwok.json --recordings recordings/ --network history";

constexpr double kSampleTime = 1e-3;  // s, of the motions that teach and judge on a model

/// A network taught, and how it follows along the trials when there is a damper to follow with.
struct Candidate {
  std::string name;
  InverseFit fit;
  std::vector<TrackReport> reports;
};

/// The damper that the inverses are made for, and the trials that judge them. Without a damper
/// there are no trials.
struct Bench {
  Damper damper;
  DriverOptions driver;
  MotionRange range;
  std::vector<InverseTrial> trials;
  std::optional<Dataset> recordings;
  DriveUnit drive_unit = DriveUnit::None;
};

/// Throws UsageError at what only a damper has an effect of, where recordings teach alone.
void require_no_damper(const InvertSettings& settings) {
  for (const auto& [option, is_said] : {std::pair{"--amplitude", settings.amplitude > 0},
                                        {"--frequency", settings.frequency > 0},
                                        {"--current-max", settings.damper.current_max > 0},
                                        {"--lag-rate", settings.damper.lag_rate >= 0},
                                        {"--figure", !settings.figure.empty()}})
    if (is_said)
      throw UsageError(option, "is of a damper, and recordings alone are given",
                       "name a MODEL beside them, or leave it out");
}

Bench make_bench(const InvertSettings& settings, Console& console) {
  Bench bench;
  const bool recorded = !settings.recordings.paths.empty();
  if (recorded) {
    bench.recordings = load_recordings(settings.recordings, console);
    bench.drive_unit = bench.recordings->drive_unit;
    if (!settings.damper.is_made()) {
      require_no_damper(settings);
      return bench;
    }
  }

  // A damper judges what recordings have taught, so both must be driven in one unit.
  bench.damper = load_damper(settings.damper, "invert", console);
  if (recorded && bench.damper.drive_unit != bench.drive_unit)
    throw Error(bench.damper.name, "is driven by " + to_string(bench.damper.drive_unit) +
                                       ", the recordings by " + to_string(bench.drive_unit));
  bench.drive_unit = bench.damper.drive_unit;

  // The motions cover the range of the model's data, unless the user states another.
  bench.driver = driver_of(bench.damper, settings.damper);
  if (bench.damper.domain) bench.range = motion_range(*bench.damper.domain);
  if (settings.amplitude > 0) bench.range.amplitude = settings.amplitude / 1000;
  if (settings.frequency > 0) bench.range.frequency = settings.frequency;

  bench.trials =
      inverse_trials(*bench.damper.model, bench.range, limits_of(bench.driver, kSampleTime));
  return bench;
}

std::vector<TrackReport> follow(const Bench& bench, const InverseModel& inverse) {
  std::vector<TrackReport> reports;
  for (const InverseTrial& trial : bench.trials)
    reports.push_back(
        track(*bench.damper.model, inverse, Driver(bench.driver), trial.motion, trial.wanted));
  return reports;
}

/// Root mean square over the trials of the error in reach, % of span.
double mean_error_in_reach(const std::vector<TrackReport>& reports) {
  double squares = 0;
  for (const TrackReport& r : reports) squares += r.reachable.rms_span * r.reachable.rms_span;
  return std::sqrt(squares / static_cast<double>(reports.size()));
}

Candidate teach(const InvertSettings& settings, const Bench& bench, const std::string& network,
                Console& console) {
  InverseFitOptions options;
  options.network = network;
  options.rate_max = settings.rate_limit;
  options.training.spacing = settings.step / 1000;
  options.training.seed = settings.seed;
  options.training.threads = settings.threads;
  options.training.monitor = console.monitor();

  // Recordings teach where there are any; else the model itself does.
  const DamperModel* forward = bench.damper.model.get();
  const InverseLimits limits = limits_of(bench.driver, kSampleTime);
  Candidate candidate{
      network,
      bench.recordings
          ? fit_inverse(*bench.recordings, default_leave_out(*bench.recordings), forward, options)
          : fit_inverse(*forward, bench.range, limits, options),
      {}};

  // Only with a damper can the force be followed.
  if (forward) candidate.reports = follow(bench, HistoryNetwork(candidate.fit.network, limits));
  return candidate;
}

std::vector<std::string> chosen_networks(const InvertSettings& settings) {
  if (std::ranges::find(settings.networks, "all") == settings.networks.end())
    return settings.networks;
  return inverse_network_names();
}

/// The best first: by the force that it makes, else by its current.
std::vector<Candidate> teach_all(const InvertSettings& settings, const Bench& bench,
                                 Console& console) {
  std::vector<Candidate> candidates;
  for (const std::string& network : chosen_networks(settings)) {
    console.check_stop();
    try {
      candidates.push_back(teach(settings, bench, network, console));
    } catch (const Error& error) {
      if (settings.networks.front() != "all") throw;
      console.note(network + " is left out: " + error.what());
    }
  }

  // The error of the force counts; the current's only where no damper gives a force.
  if (candidates.empty()) throw Error("invert", "no network can be taught with these data");
  std::ranges::stable_sort(candidates, {}, [](const Candidate& c) {
    return c.reports.empty() ? c.fit.left_out_rmse : mean_error_in_reach(c.reports);
  });
  return candidates;
}

std::string table_of(const std::vector<Candidate>& candidates,
                     const std::vector<TrackReport>& numeric, const Bench& bench, int width) {
  std::vector<std::string> titles{"inverse", ">current rms " + to_string(bench.drive_unit)};
  for (const InverseTrial& trial : bench.trials) titles.push_back(">" + trial.name + " %");
  Table table(titles);
  const auto row = [&](const std::string& name, const std::string& current,
                       const std::vector<TrackReport>& reports) {
    std::vector<std::string> cells{name, current};
    for (const TrackReport& r : reports) cells.push_back(percent_text(r.reachable.rms_span));
    table.row(cells);
  };
  for (const Candidate& c : candidates) row(c.name, number_text(c.fit.left_out_rmse), c.reports);
  if (!numeric.empty()) row("numeric", "-", numeric);
  return table.text(static_cast<std::size_t>(width));
}

/// Explains the columns of the table.
std::string heading(const Candidate& best, const Bench& bench) {
  std::string text = "\nTaught by " + best.fit.teacher +
                     "\n\nCurrent: rms on what was left out, weighted by its effect on the force\n";
  if (!bench.trials.empty())
    text += "Force: rms where it is in reach, % of the wanted span, behind the driver, along\n";
  for (const InverseTrial& trial : bench.trials)
    text += "  " + trial.name + ": " + trial.motion.description + '\n';
  return text + '\n';
}

Value json_of(const Candidate& candidate, const Bench& bench) {
  Value trials = Value::array();
  for (std::size_t k = 0; k < candidate.reports.size(); ++k)
    trials.push_back(
        Value::object({{"motion", bench.trials[k].motion.description},
                       {"rms_span_percent_in_reach", candidate.reports[k].reachable.rms_span},
                       {"reachable_percent", candidate.reports[k].reachable_share}}));
  return Value::object({{"teacher", candidate.fit.teacher},
                        {"training_current_rmse", candidate.fit.training_rmse},
                        {"left_out_current_rmse", candidate.fit.left_out_rmse},
                        {"tracking", std::move(trials)}});
}

void save(const Candidate& best, const Bench& bench, const InvertSettings& settings,
          Console& console) {
  InverseFile file{.network = best.fit.network,
                   .drive_unit = bench.drive_unit,
                   .domain = best.fit.domain,
                   .provenance = {},
                   .quality = json_of(best, bench)};
  if (bench.recordings)
    file.provenance = provenance_of(*bench.recordings, best.fit.records, console.command_line());
  file.provenance.command = console.command_line();
  file.provenance.created = date_now();
  save_inverse(file, settings.file);
  console.print("\nInverse  " + settings.file + " (" + best.name + ", steps of " +
                format_number(settings.step) + " ms)\n");
}

void write_figure(const std::vector<Candidate>& candidates, const std::vector<TrackReport>& numeric,
                  const Bench& bench, const std::string& folder, Console& console) {
  if (numeric.empty())
    throw Error("--figure", "there is nothing to follow with", "give a damper, too");
  std::vector<TrackedScheme> schemes{{"numeric", numeric.front()}};
  for (const Candidate& c : candidates)
    schemes.insert(schemes.end() - 1, {c.name, c.reports.front()});
  console.print("Picture  " +
                write_track_figure(schemes, bench.drive_unit, folder).front().string() + '\n');
}

int run_invert(const InvertSettings& settings, Console& console) {
  const Bench bench = make_bench(settings, console);
  const std::vector<Candidate> candidates = teach_all(settings, bench, console);

  // The search on the model itself shows what any inverse could reach.
  std::vector<TrackReport> numeric;
  if (bench.damper.model)
    numeric =
        follow(bench, NumericInverse(*bench.damper.model, limits_of(bench.driver, kSampleTime)));

  const Candidate& best = candidates.front();
  console.print(heading(best, bench) + table_of(candidates, numeric, bench, console.width()));
  for (const std::string& warning : best.fit.warnings) console.warn(warning);
  if (numeric.empty())
    console.note(
        "no damper was given, so that how the force follows was not measured: give a model, too");

  // Only the best network is kept.
  save(best, bench, settings, console);
  if (!settings.figure.empty()) write_figure(candidates, numeric, bench, settings.figure, console);

  if (console.json) {
    Value all = Value::object();
    for (const Candidate& c : candidates) all.add(c.name, json_of(c, bench));
    console.print_json(
        Value::object({{"file", settings.file}, {"saved", best.name}, {"networks", all}}));
  }
  return kDone;
}

std::vector<Option> network_options(InvertSettings& s) {
  std::vector<std::string> names = inverse_network_names();
  names.emplace_back("all");

  return {{.names = "--network",
           .target = &s.networks,
           .help = "the networks to teach, of which the best is saved",
           .value = "LIST",
           .choices = names,
           .noun = "inverse network",
           .default_text = join(s.networks, ",")},
          {.names = "--step",
           .target = &s.step,
           .help = "time between two delays, ms: a multiple of the sample time at which the "
                   "inverse is to work",
           .value = "MS",
           .minimum = 0.01},
          {.names = "--rate-limit",
           .target = &s.rate_limit,
           .help = "largest rate of the inverse's current, A/s; 0: no limit",
           .value = "A/S",
           .minimum = 0},

          // The motions on a model, which both teach and judge.
          {.names = "--amplitude",
           .target = &s.amplitude,
           .help = "amplitude of the motions that teach and judge, mm",
           .value = "MM",
           .minimum = 0,
           .default_text = "that of the model's data, else 20"},
          {.names = "--frequency",
           .target = &s.frequency,
           .help = "highest frequency of such a random motion",
           .value = "HZ",
           .minimum = 0,
           .default_text = "so that its speed is that of the model's data, else 3"},

          seed_option(s.seed),
          threads_option(s.threads)};
}

}  // namespace

Command invert_command() {
  auto settings = std::make_shared<InvertSettings>();
  InvertSettings& s = *settings;
  Command command{.name = "invert",
                  .title = "Train a network that gives the current for a wanted force",
                  .description =
                      "Makes an inverse of a damper: a small network from motion, wanted force and "
                      "their past to the current, taught on a model that is moved over its range, "
                      "or on recordings. Judges it by its current on what it had not seen and, "
                      "where there is a model, by the force that comes of it behind the coil's "
                      "driver, beside the search on the model. Saves it as a file for 'dashpot "
                      "track'. Recordings at a single current cannot teach it; recordings with a "
                      "constant current each cannot teach a network that feeds its currents back.",
                  .options = damper_options(s.damper),
                  .example = std::string(kInvertExample),
                  .run = [settings](Console& console) { return run_invert(*settings, console); }};

  // The recordings, where they teach in place of the model.
  command.options.push_back(
      {.names = "--recordings",
       .target = &s.recordings.paths,
       .help = "teach it with these files or folders; a model then weighs and judges",
       .value = "LIST",
       .takes = Takes::File});
  command.options.push_back({.names = "--dataset",
                             .target = &s.recordings.load.dataset_file,
                             .help = "a dataset file that states channels, units and conditions",
                             .value = "FILE",
                             .takes = Takes::File,
                             .default_text = "dataset.yaml beside the recordings, if there",
                             .needs = "--recordings"});

  // The networks and the coil in front of the damper.
  append(command.options, network_options(s));
  append(command.options, coil_options(s.damper));

  // The files of the results.
  command.options.push_back({.names = "-o,--output",
                             .target = &s.file,
                             .help = "the file of the inverse",
                             .value = "FILE",
                             .takes = Takes::File});
  command.options.push_back(
      {.names = "--figure",
       .target = &s.figure,
       .help = "also draw how the force follows along the first motion (needs gnuplot)",
       .value = "DIR",
       .takes = Takes::Folder});
  return command;
}

}  // namespace dashpot::cli
