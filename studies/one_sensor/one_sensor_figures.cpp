// Figures of the one-sensor paper that show signals: 3, 4 and 7 to 10.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/evaluate.h"
#include "dashpot/record/differentiate.h"
#include "dashpot/report/words.h"
#include "studies/one_sensor/one_sensor_parts.h"

namespace dashpot {
namespace {

constexpr std::size_t kPoints = 1500;  // of a curve: print shows no more
constexpr std::size_t kDots = 700;     // of a cloud
constexpr std::size_t kMostShown = 6;  // sequences, of which other data may hold dozens

struct Window {
  std::size_t first, last, step;
};

/// The samples from `from` on for `seconds`, both s, thinned evenly to what print can show.
Window window_of(const Record& record, double from, double seconds) {
  const auto at = [&](double time) {
    return static_cast<std::size_t>(std::ranges::lower_bound(record.time, time) -
                                    record.time.begin());
  };
  const double begin = std::max(record.time.front(), std::min(from, record.time.back() - seconds));
  const std::size_t first = std::max(at(begin), record.warm_up),
                    last = std::max(at(begin + seconds), first);
  return {first, last, (last - first) / kPoints + 1};
}

std::vector<double> taken(const std::vector<double>& samples, const Window& window,
                          double factor = 1) {
  std::vector<double> result;
  for (std::size_t i = window.first; i < window.last && i < samples.size(); i += window.step)
    result.push_back(factor * samples[i]);
  return result;
}

std::string damper_title(const StudiedDamper& damper) {
  return damper.name + (damper.is_virtual ? ", virtual damper" : "");
}

/// A channel of an experiment's training record, from its start.
std::optional<FigurePanel> sequence_panel(const StudiedDamper& damper, std::size_t experiment,
                                          const Channel& label, double seconds, double factor) {
  const Fold& fold = damper.experiments[experiment];
  const Record& record = fold.training.front();
  const Channel* samples = record.find(label.name);
  if (!samples) return std::nullopt;
  const Window window = window_of(record, 0, seconds);
  return FigurePanel{damper.name + ", " + fold.name + ": " + record.condition,
                     "Time (s)",
                     label.unit,
                     {{"", "modelled", taken(record.time, window),
                       taken(samples->samples, window, factor), FigureSeries::Mark::Line, 1}}};
}

/// Seconds of a signal that a figure can show: all of it with up to a hundred changes, else its
/// first four; more would be a black patch.
double legible_seconds(const Record& record, const std::string& channel) {
  constexpr double kBeginning = 4;
  constexpr std::size_t kLegible = 100;
  const Channel* samples = record.find(channel);
  std::size_t changes = 0;
  for (std::size_t i = 1; samples && i < samples->samples.size(); ++i)
    changes += samples->samples[i] != samples->samples[i - 1];
  return changes > kLegible ? kBeginning : INFINITY;
}

/// The paper shows each kind of current once: stepped constants and transients of either damper.
std::vector<std::size_t> shown_currents(const StudiedDamper& damper) {
  if (damper.is_virtual) return {0, 2};
  std::vector<std::size_t> all(std::min(damper.experiments.size(), kMostShown));
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// A model's forces on one left-out record.
const std::vector<double>* forces_of(const OneSensorView& view, std::size_t damper,
                                     std::size_t experiment, const char* key, std::size_t record) {
  const StudiedResult* result = view.study.result(damper, key, experiment);
  return result && record < result->forces.size() ? &result->forces[record] : nullptr;
}

constexpr std::array<std::array<const char*, 3>, 2> kShown{
    {{kStatic, "static network, 1 sensor", "series-2"},
     {kHysteresis, "hysteresis network, 1 sensor", "modelled"}}};

FigurePanel trace_panel(const OneSensorView& view, std::size_t damper, std::size_t experiment,
                        double seconds) {
  const StudiedDamper& studied = view.study.dampers[damper].damper;
  const Fold& fold = studied.experiments[experiment];
  const Record& record = fold.left_out.front();

  // A window behind the first tenth of the record.
  const double duration = record.time.back() - record.time.front();
  const Window window = window_of(record, record.time.front() + 0.1 * duration, seconds);

  // The measured force, and both networks over it.
  FigurePanel panel{
      damper_title(studied) + ", " + fold.name,
      "Time (s)",
      "Force (N)",
      {{"measured", "measured", taken(record.time, window),
        taken(record.channel("force").samples, window), FigureSeries::Mark::Line, 2.4}}};
  for (const auto& [key, label, colour] : kShown)
    if (const auto* forces = forces_of(view, damper, experiment, key, 0))
      panel.series.push_back({label, colour, taken(record.time, window), taken(*forces, window),
                              FigureSeries::Mark::Line, 1.2});
  return panel;
}

/// Force against velocity over all left-out records of an experiment, evenly thinned.
FigurePanel velocity_panel(const OneSensorView& view, std::size_t damper, std::size_t experiment,
                           const char* key, const std::string& label, const std::string& colour) {
  const StudiedDamper& studied = view.study.dampers[damper].damper;
  const Fold& fold = studied.experiments[experiment];
  FigureSeries measured{"measured", "measured", {}, {}, FigureSeries::Mark::Dots, 1.6},
      modelled{label, colour, {}, {}, FigureSeries::Mark::Dots, 1.1};

  // All records share the number of dots that print can show.
  std::size_t samples = 0;
  for (const Record& record : fold.left_out) samples += record.size();
  for (std::size_t r = 0; r < fold.left_out.size(); ++r) {
    // Measured and modelled forces over the same velocities.
    const Record& record = fold.left_out[r];
    const Window window{record.warm_up, record.size(), samples / kDots + 1};
    const auto* forces = forces_of(view, damper, experiment, key, r);
    for (const auto& [series, values] :
         {std::pair(&measured, &record.channel("force").samples), std::pair(&modelled, forces)}) {
      if (!values) continue;
      const std::vector<double> x = taken(record.channel("velocity").samples, window),
                                y = taken(*values, window);
      series->x.insert(series->x.end(), x.begin(), x.end());
      series->y.insert(series->y.end(), y.begin(), y.end());
    }
  }

  // The cloud that was measured, and the model's over it.
  return {damper_title(studied) + ", " + fold.name,
          "Velocity (m/s)",
          "Force (N)",
          {std::move(measured), std::move(modelled)}};
}

DocumentFigure velocity_figure(const OneSensorView& view, const std::string& name,
                               const std::string& title,
                               const std::vector<std::pair<std::size_t, std::size_t>>& shown) {
  DocumentFigure figure{name,
                        title,
                        "Left: the paper's static network with one sensor. Right: the hysteresis "
                        "network with the same sensor. Records that were left out.",
                        {},
                        2};
  for (const auto& [damper, experiment] : shown)
    for (const auto& [key, label, colour] : kShown)
      figure.panels.push_back(velocity_panel(view, damper, experiment, key, label, colour));
  return figure;
}

std::vector<double> central_difference(const std::vector<double>& x, double dt) {
  std::vector<double> v(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, x.size() - 1);
    v[i] = (x[after] - x[before]) / (static_cast<double>(after - before) * dt);
  }
  return v;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

/// The record of figure 10: of experiment 3 of MR2, or the first of other data.
const Record& velocity_record(const OneSensorView& view) {
  return view.is_virtual() ? view.study.dampers[1].damper.experiments[2].left_out.front()
                           : view.study.dampers[0].damper.experiments[0].left_out.front();
}

}  // namespace

DocumentSection excitation_section(const OneSensorView& view) {
  DocumentSection section{"excitation", "Table 2, figures 3 and 4: the experiments", {}};
  constexpr double kSeconds = 16;

  // Two figures of sequences and one table of recordings.
  DocumentFigure motion{
      "figure-3", "Figure 3: displacement sequences", "The first seconds of each.", {}, 2},
      drive{"figure-4", "Figure 4: current sequences", "From their beginning.", {}, 2};
  DocumentTable table{"Table 2: recordings",
                      {{"Damper"},
                       {"Experiment"},
                       {"Learnt from", false, 0, true},
                       {"Judged on", false, 0, true},
                       {"s", true}},
                      {}};

  // Motion and drive, by their own names and units.
  for (const DamperStudy& one : view.study.dampers) {
    const StudiedDamper& damper = one.damper;
    const bool is_voltage = damper.drive_unit == DriveUnit::Volt;
    const Channel moved{"displacement", "Displacement (mm)", {}, {}},
        driven{
            is_voltage ? "voltage" : "current", is_voltage ? "Voltage (V)" : "Current (A)", {}, {}};

    // All dampers move alike: the motion is shown for the first.
    if (&one == &view.study.dampers.front())
      for (std::size_t e = 0; e < std::min(damper.experiments.size(), kMostShown); ++e)
        if (auto panel = sequence_panel(damper, e, moved, kSeconds, 1000))
          motion.panels.push_back(*panel);

    // The drive as far as it can be read.
    for (const std::size_t e : shown_currents(damper)) {
      const double seconds = legible_seconds(damper.experiments[e].training.front(), driven.name);
      if (auto panel = sequence_panel(damper, e, driven, seconds, 1))
        drive.panels.push_back(*panel);
    }

    // The records that each experiment learns from, those that judge it, and their length.
    for (const Fold& fold : damper.experiments) {
      const auto said = [](const std::vector<Record>& records) {
        return records.size() == 1 ? records.front().name : counted(records.size(), "record");
      };
      double seconds = 0;
      for (const Record& record : fold.left_out)
        seconds += record.time.back() - record.time.front();
      table.rows.push_back({damper_title(damper), fold.name, said(fold.training),
                            said(fold.left_out), number_text(seconds)});
    }
  }

  // Records without a displacement have no figure 3.
  section.tables.push_back(std::move(table));
  if (!motion.panels.empty()) section.figures.push_back(std::move(motion));
  section.figures.push_back(std::move(drive));
  return section;
}

DocumentSection curves_section(const OneSensorView& view) {
  DocumentSection section{"figures", "Figures 7 to 9: force in time and against velocity", {}};
  constexpr double kSeconds = 0.6;

  // The figure in time shows the last experiment of a damper.
  const auto last = [&](std::size_t d) {
    return view.study.dampers[d].damper.experiments.size() - 1;
  };
  DocumentFigure traces{"figure-7", "Figure 7: force in time", "Parts of left-out recordings.", {}};

  // The paper's own choice of experiments, where these are its dampers.
  if (view.is_virtual()) {
    for (std::size_t d = 0; d < view.study.dampers.size(); ++d)
      traces.panels.push_back(trace_panel(view, d, last(d), kSeconds));
    section.figures = {
        std::move(traces),
        velocity_figure(view, "figure-8",
                        "Figure 8: force against velocity, experiment 2, both dampers",
                        {{0, 1}, {1, 1}}),
        velocity_figure(view, "figure-9",
                        "Figure 9: force against velocity, MR1, experiments 2 and 4",
                        {{0, 1}, {0, 3}})};
    section.paragraphs.push_back(
        "The paper sees in its figure 8 that its network cannot follow the hysteresis of MR1 at "
        "velocities within 0.5 m/s, and proposes an acceleration sensor. The right-hand panels "
        "show that internal states serve as well.");
    return section;
  }

  // Other data: the first divisions in time, and more of them over the velocity.
  for (std::size_t e = 0; e <= std::min<std::size_t>(last(0), 1); ++e) {
    const Record& record = view.study.dampers[0].damper.experiments[e].left_out.front();
    traces.panels.push_back(
        trace_panel(view, 0, e, 0.2 * (record.time.back() - record.time.front())));
  }
  std::vector<std::pair<std::size_t, std::size_t>> shown;
  for (std::size_t e = 0; e < std::min(last(0) + 1, kMostShown); ++e) shown.emplace_back(0, e);
  section.figures = {
      std::move(traces),
      velocity_figure(view, "figure-8", "Figures 8 and 9: force against velocity", shown)};
  return section;
}

DocumentSection velocity_section(const OneSensorView& view) {
  DocumentSection section{"figure-10", "Figure 10: velocity measured and estimated", {}};

  // Needs a velocity that was measured, and evenly sampled records.
  const Record& record = velocity_record(view);
  const Channel *displacement = record.find("displacement"), &velocity = record.channel("velocity");
  if (!displacement || velocity.origin.starts_with("derived") || record.sample_time <= 0) {
    section.paragraphs.push_back(
        "These recordings hold no velocity beside the displacement: the velocity is derived, and "
        "there is nothing to compare it with.");
    return section;
  }

  // The velocity by differences of the displacement, plain and smoothed.
  constexpr double kSeconds = 1;
  const double dt = record.sample_time, cutoff = choose_cutoff_hz(displacement->samples, dt);
  const std::vector<double> plain = central_difference(displacement->samples, dt),
                            smooth = differentiate_zero_phase(displacement->samples, dt, cutoff);
  const std::vector<double>& measured = velocity.samples;
  const double swing = rms_difference(measured, std::vector<double>(measured.size(), 0.0));

  // The difference of each from the measured one.
  DocumentTable table{"Estimated against measured velocity: " + record.name,
                      {{"From the displacement by"},
                       {"RMS difference, mm/s", true},
                       {"of the velocity's RMS, %", true}},
                      {}};
  for (const auto& [name, values] :
       {std::pair<std::string, const std::vector<double>*>{"central difference, as the paper",
                                                           &plain},
        {fmt::format("the same behind a zero-phase low-pass of {} Hz", number_text(cutoff)),
         &smooth}}) {
    const double rms = rms_difference(*values, measured);
    table.rows.push_back({name, number_text(1000 * rms), number_text(100 * rms / swing, 2)});
  }

  // One second of all three.
  section.tables.push_back(std::move(table));
  const Window window = window_of(record, record.time.front() + 2, kSeconds);
  const std::vector<double> time = taken(record.time, window);
  section.figures.push_back(
      {"figure-10",
       "Figure 10: velocity",
       record.name,
       {{"",
         "Time (s)",
         "Velocity (m/s)",
         {{"measured", "measured", time, taken(measured, window), FigureSeries::Mark::Line, 2.6},
          {"central difference", "series-2", time, taken(plain, window), FigureSeries::Mark::Line,
           1},
          {"zero-phase", "modelled", time, taken(smooth, window), FigureSeries::Mark::Line,
           1.2}}}}});

  // Near enough: within 5 % of the velocity's root mean square.
  section.paragraphs.push_back(
      fmt::format("The paper: a displacement sensor serves as well as a velocity sensor. {}",
                  rms_difference(smooth, measured) < 0.05 * swing
                      ? "Agrees here, the derivative being smoothed."
                      : "Does not agree here."));
  return section;
}

}  // namespace dashpot
