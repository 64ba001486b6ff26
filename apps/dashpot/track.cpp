#include "dashpot/identify/judge/track.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "commands.h"
#include "console.h"
#include "damper_choice.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/dataset.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/report/track_figure.h"
#include "dashpot/report/words.h"
#include "data.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

struct TrackSettings {
  DamperChoice damper;
  std::string recording, folder;
  std::vector<std::string> inverses;
  std::string wanted = "random", motion = "random";
  double force = 0, band = 2;                             // N, Hz
  double amplitude = 20, frequency = 3, duration = 10;    // mm, Hz, s
  double sample_rate = 1000, rate_limit = 0, period = 0;  // Hz, A/s, s
  std::uint64_t seed = 1;
};

constexpr std::string_view kTrackExample =
    "# Which way from a wanted force to a voltage follows best?\n"
    "dashpot track --parameters spencer1997\n"
    "\n"
    "# A model of your own, one scheme, with curves as CSV and a picture:\n"
    "dashpot track results/models/tanh_kwok.json --inverse numeric --output tracking\n"
    "\n"
    "# A network of your own beside the search on the model:\n"
    "dashpot track --parameters spencer1997 --inverse inverse.json,numeric\n"
    "\n"
    "# A sine of 800 N, which the damper cannot always give, behind a slow amplifier:\n"
    "dashpot track --parameters spencer1997 --wanted sine --force 800 --rate-limit 50";

/// A motion and the force that is wanted along it.
struct Task {
  Motion motion;
  std::vector<double> wanted;
  std::string description;
};

Task recorded_task(const std::string& path, Console& console) {
  DataSettings data;
  data.paths = {path};
  const Dataset dataset = load_recordings(data, console);
  const Record& record = dataset.records.front();
  if (record.sample_time == 0)
    throw Error(record.name, "is not sampled at equal steps of time",
                "state 'resample: RATE' (Hz) in a dataset file beside it");
  return {{record.sample_time,
           record.channel("displacement").samples,
           record.channel("velocity").samples,
           {}},
          record.channel("force").samples,
          "measured, " + record.name};
}

/// Throws UsageError at an amplitude of the wanted force where that is no sine.
void require_effect(const TrackSettings& settings) {
  if (settings.force > 0 && settings.wanted != "sine")
    throw UsageError("--force", "is the amplitude of a sine, and the wanted force is random",
                     "with --wanted sine");
}

Task make_task(const TrackSettings& settings, const DamperModel& damper, DriverOptions driver,
               Console& console) {
  if (!settings.recording.empty()) return recorded_task(settings.recording, console);

  // The motion comes first: what force is possible depends on it.
  const MotionOptions options{settings.amplitude / 1000, settings.frequency, settings.duration,
                              1 / settings.sample_rate, settings.seed};
  Task task;
  task.motion = settings.motion == "sine" ? sine_motion(options) : random_motion(options);

  // A random force stays within reach; a sine may leave it, which tests the limits.
  const InverseLimits limits = limits_of(driver, task.motion.sample_time);
  if (settings.wanted == "random") {
    task.wanted = admissible_force(damper, task.motion, limits, settings.band, settings.seed + 1);
    task.description =
        "random within what the damper can give, 0 to " + format_number(settings.band) + " Hz";
  } else {
    const double half = 0.5 * Observer(damper, limits).force_max();
    const double force = settings.force > 0 ? settings.force : half;
    task.wanted = sine_force(force, settings.band, task.motion);
    task.description =
        "sine of " + format_number(force) + " N at " + format_number(settings.band) + " Hz";
  }

  task.description += "; " + task.motion.description;
  return task;
}

/// Says where the motion leaves the domain of the damper's model or of an inverse for it.
void warn_outside(const Domain& domain, const std::string& whose, const Damper& damper,
                  const Motion& motion, Console& console) {
  std::vector<DamperInput> inputs;
  for (std::size_t k = 0; k < motion.size(); ++k)
    inputs.push_back({.displacement = motion.displacement[k],
                      .velocity = motion.velocity[k],
                      .current = domain.current_min});
  for (const Extrapolation& e : extrapolations(*damper.model, domain, damper.drive_unit, {inputs}))
    console.warn(percent_text(100 * e.share) + " % of the time the " + e.quantity + " is outside " +
                 whose + " range " + format_number(e.low, 3) + " ... " + format_number(e.high, 3) +
                 " " + e.unit + ": it extrapolates there");
}

/// Says where the motion, or what the coil may get, leaves the data that the model knows.
void warn_beyond_data(const Damper& damper, const DriverOptions& driver, const Motion& motion,
                      Console& console) {
  if (!damper.domain) return;
  const Domain& domain = *damper.domain;
  warn_outside(domain, "the model's", damper, motion, console);

  constexpr double kRounding = 1e-9;
  if (driver.current_max > domain.current_max * (1 + kRounding))
    console.warn("the coil gets up to " + format_number(driver.current_max) + ' ' +
                 to_string(damper.drive_unit) + ", beyond the model's " +
                 format_number(domain.current_max) + ": it extrapolates there");
}

/// "0 ... 2 A, coil lag 5 ms": the limits of coil and driver are part of the result.
std::string coil_text(const DriverOptions& driver, const std::string& unit) {
  std::string text = format_number(driver.current_min) + " ... " +
                     format_number(driver.current_max) + ' ' + unit + ", coil lag " +
                     (driver.lag_rate > 0 ? format_number(1000 / driver.lag_rate) + " ms" : "none");
  if (std::isfinite(driver.rate_max))
    text += ", at most " + format_number(driver.rate_max) + ' ' + unit + "/s";
  if (driver.period > 0)
    text += ", its command read every " + format_number(1000 * driver.period) + " ms";
  return text;
}

DriverOptions make_driver(const TrackSettings& settings, const Damper& damper) {
  DriverOptions driver{.period = settings.period};
  if (settings.rate_limit > 0) driver.rate_max = settings.rate_limit;
  return driver_of(damper, settings.damper, driver);
}

/// The RMS error in reach, N; that of the whole run where nothing is in reach.
double error_in_reach(const TrackedScheme& tracked) {
  const TrackReport& r = tracked.report;
  return r.reachable.samples > 0 ? r.reachable.rmse : r.all.rmse;
}

/// A scheme made for the damper, or an inverse of its own from a file, which was taught over a
/// range of motions.
std::unique_ptr<InverseModel> make_inverse(const std::string& word, const Damper& damper,
                                           const InverseLimits& limits, const Motion& motion,
                                           Console& console) {
  if (!is_path(word)) return find_inverse(word).make(*damper.model, limits);
  InverseFile file = load_inverse(word);
  require_drive(file, damper.drive_unit, word);
  warn_outside(file.domain, word + "'s", damper, motion, console);
  return std::make_unique<HistoryNetwork>(std::move(file.network), limits);
}

/// Tracks with the schemes asked for, or with all that apply. The best comes first.
std::vector<TrackedScheme> track_all(const TrackSettings& settings, const Damper& damper,
                                     const Driver& driver, const Task& task, Console& console) {
  const InverseLimits limits = limits_of(driver.options(), task.motion.sample_time);
  const bool asked = !settings.inverses.empty();
  std::vector<TrackedScheme> tracked;

  // A scheme that does not suit the damper is an error only where the user named it.
  for (const std::string& word : asked ? settings.inverses : inverse_names()) {
    console.check_stop();
    try {
      const auto inverse = make_inverse(word, damper, limits, task.motion, console);
      const std::string name = is_path(word) ? std::filesystem::path(word).stem().string() : word;
      tracked.push_back({name, track(*damper.model, *inverse, driver, task.motion, task.wanted)});
    } catch (const Error& error) {
      if (asked) throw;
      console.note(word + " is left out: " + error.what());
    }
  }

  std::ranges::stable_sort(tracked, {}, error_in_reach);
  return tracked;
}

std::string table_of(const std::vector<TrackedScheme>& tracked, int width) {
  Table table({"inverse", ">RMSE N", ">% span", ">in reach", ">largest", ">time out", ">at limit"});
  for (const auto& [name, r] : tracked)
    table.row({name, number_text(r.all.rmse), percent_text(r.all.rms_span),
               percent_text(r.reachable.rms_span),
               percent_text(100 * r.reachable.max_error / r.span),
               percent_text(100 - r.reachable_share), percent_text(r.saturated_share)});
  return table.text(static_cast<std::size_t>(width)) +
         paragraph(
             "In reach, largest: RMSE and largest error where the wanted force is in reach, % "
             "of the span. Time out: % of the time that it is out of reach; at limit: that "
             "the command is at a limit.",
             static_cast<std::size_t>(width));
}

std::string csv_of(const TrackReport& r, const Motion& motion, DriveUnit unit) {
  const std::string drive = unit == DriveUnit::Volt ? "voltage_V" : "current_A";
  std::string text = "t_s,x_mm,v_m/s,F_wanted_N,F_obtained_N,command_" + drive + ",coil_" + drive +
                     ",F_least_N,F_greatest_N\n";
  constexpr int kDigits = 9;
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    text += format_number(r.time[k], kDigits);
    for (const double value :
         {1000 * motion.displacement[k], motion.velocity[k], r.wanted[k], r.obtained[k],
          r.command[k], r.current[k], r.least[k], r.greatest[k]})
      text += ',' + format_number(value, kDigits);
    text += '\n';
  }
  return text;
}

void write_curves(const std::vector<TrackedScheme>& tracked, const Task& task, DriveUnit unit,
                  const std::filesystem::path& folder, Console& console) {
  for (const auto& [name, report] : tracked)
    write_file(folder / (name + ".csv"), csv_of(report, task.motion, unit));
  console.print("\nCurves   " + (folder / "*.csv").string() + '\n');
  console.print("Picture  " + write_track_figure(tracked, unit, folder).front().string() + '\n');
}

Value json_of(const std::vector<TrackedScheme>& tracked, const Damper& damper, const Task& task,
              const std::vector<std::string>& remarks) {
  Value schemes = Value::array();
  for (const auto& [name, r] : tracked)
    schemes.push_back(Value::object({{"inverse", name},
                                     {"all", to_json(r.all)},
                                     {"reachable", to_json(r.reachable)},
                                     {"reachable_percent", r.reachable_share},
                                     {"saturated_percent", r.saturated_share}}));
  return Value::object({{"damper", damper.name},
                        {"wanted", task.description},
                        {"span_N", tracked.front().report.span},
                        {"schemes", std::move(schemes)},
                        {"remarks", Value::array(remarks)}});
}

int run_track(const TrackSettings& settings, Console& console) {
  require_effect(settings);
  const Damper damper = load_damper(settings.damper, "track", console);
  const DriverOptions options = make_driver(settings, damper);
  const Driver driver(options);
  const Task task = make_task(settings, *damper.model, options, console);
  warn_beyond_data(damper, options, task.motion, console);

  const std::vector<TrackedScheme> tracked = track_all(settings, damper, driver, task, console);

  // A diverged run has no error that could be compared.
  for (const auto& [name, report] : tracked)
    if (!std::isfinite(report.all.rmse)) {
      console.error("the damper diverged behind the inverse " + name);
      return kNotUsable;
    }

  console.print('\n' + console.bold(damper.name) + ", " +
                coil_text(options, to_string(damper.drive_unit)) + '\n' +
                paragraph("Wanted force: " + task.description + ", span " +
                              format_number(tracked.front().report.span) + " N",
                          static_cast<std::size_t>(console.width())) +
                '\n');
  console.print(table_of(tracked, console.width()));

  if (!settings.folder.empty())
    write_curves(tracked, task, damper.drive_unit, settings.folder, console);
  if (console.json) console.print_json(json_of(tracked, damper, task, console.remarks()));
  return kDone;
}

/// The motion, and the force that is wanted along it.
std::vector<Option> task_options(TrackSettings& s) {
  return {{.names = "--wanted",
           .target = &s.wanted,
           .help = "wanted force: random within what the damper can give, or a sine",
           .value = "KIND",
           .choices = {"random", "sine"}},
          {.names = "--force",
           .target = &s.force,
           .help = "amplitude of the sine, N",
           .value = "N",
           .minimum = 0,
           .default_text = "half of the largest that the damper gives"},
          {.names = "--band",
           .target = &s.band,
           .help = "frequency of the sine, highest of the random force",
           .value = "HZ",
           .minimum = 0},

          // The motion of the piston.
          {.names = "--motion",
           .target = &s.motion,
           .help = "motion of the piston",
           .value = "KIND",
           .choices = {"random", "sine"}},
          {.names = "--amplitude",
           .target = &s.amplitude,
           .help = "amplitude of the motion, mm; for a random one twice its standard deviation",
           .value = "MM",
           .minimum = 0},
          {.names = "--frequency",
           .target = &s.frequency,
           .help = "frequency of the motion; for a random one the highest",
           .value = "HZ",
           .minimum = 0},
          {.names = "--duration",
           .target = &s.duration,
           .help = "duration of the motion, s",
           .value = "S",
           .minimum = 0},

          // A recording in place of both, and the rate of the commands.
          {.names = "--recording",
           .target = &s.recording,
           .help = "take motion and wanted force from the first record of this file or folder",
           .value = "PATH",
           .takes = Takes::File,
           .idles = {{{"--wanted", "--force", "--band", "--motion", "--amplitude", "--frequency",
                       "--duration", "--sample-rate"},
                      ", which is followed as it is"}}},
          {.names = "--sample-rate",
           .target = &s.sample_rate,
           .help = "commands per second; that of the recording where there is one",
           .value = "HZ",
           .minimum = 1},
          seed_option(s.seed)};
}

std::vector<Option> driver_options(TrackSettings& s) {
  return {
      {.names = "--rate-limit",
       .target = &s.rate_limit,
       .help = "rate limit of the driver, A/s; 0: no limit",
       .value = "A/S",
       .minimum = 0},
      {.names = "--period",
       .target = &s.period,
       .help =
           "time between the instants at which the driver reads its command, s; 0: at every sample",
       .value = "S",
       .minimum = 0}};
}

}  // namespace

Command track_command() {
  auto settings = std::make_shared<TrackSettings>();
  Command command{
      .name = "track",
      .title = "Follow a wanted force: inverse models side by side",
      .description =
          "Puts an inverse (wanted force to current), the coil's driver and a damper in series, "
          "moves them, and compares the wanted with the obtained force. Says how often the wanted "
          "force was out of reach of any current at that instant, and how often the command was at "
          "a limit. The first 0.1 s, in which the coil starts, are not scored.",
      .options = {},
      .example = std::string(kTrackExample),
      .run = [settings](Console& console) { return run_track(*settings, console); }};

  // The options refer to the settings, which live as long as the command.
  TrackSettings& s = *settings;
  command.options = damper_options(s.damper);
  command.options.push_back(
      {.names = "--inverse",
       .target = &s.inverses,
       .help = "schemes to compare, and files of inverses that 'dashpot invert' wrote",
       .value = "LIST",
       .choices = inverse_names(),
       .noun = "inverse",
       .takes = Takes::File,
       .default_text = "all that apply"});

  // The task, then the coil and its driver, then the files.
  append(command.options, task_options(s));
  append(command.options, coil_options(s.damper));
  append(command.options, driver_options(s));

  command.options.push_back(
      {.names = "-o,--output",
       .target = &s.folder,
       .help = "also write every scheme's curves (CSV) and a picture (needs gnuplot)",
       .value = "DIR",
       .takes = Takes::Folder});
  return command;
}

}  // namespace dashpot::cli
