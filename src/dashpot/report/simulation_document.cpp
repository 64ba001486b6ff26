#include "dashpot/report/simulation_document.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ride_parts.h"
#include "dashpot/suspension/ride/weighting.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

constexpr double kMillimetres = 1000;  // per metre

/// The runs as figures show them: the reference below.
std::vector<DrawnRun> drawn_runs(const Simulation& s) {
  std::vector<DrawnRun> runs;
  if (s.against) runs.push_back({&*s.against, passive_look(s.against->name)});
  runs.push_back({&s.run, controller_look(s.run.name, 0)});
  return runs;
}

/// The run, and the one that it is compared with.
std::vector<const SimulatedRun*> runs_of(const Simulation& s) {
  std::vector<const SimulatedRun*> runs{&s.run};
  if (s.against) runs.push_back(&*s.against);
  return runs;
}

DocumentTable measure_table(const Simulation& s) {
  DocumentTable table{.title = "",
                      .columns = {{.title = "measure", .elastic = true},
                                  {.title = "unit"},
                                  {.title = s.run.name, .numeric = true}},
                      .rows = {}};
  if (s.against) {
    table.columns.push_back({.title = s.against->name, .numeric = true});
    table.columns.push_back({.title = "ratio", .numeric = true});
  }

  // Each measure beside that of the reference.
  for (const RideMeasure& measure : s.run.measures) {
    const bool is_length = measure.unit == "mm";
    const std::string si_unit = is_length ? "m" : measure.unit == "1" ? "" : measure.unit;
    const auto shown = [&](double value) {
      return quantity(is_length ? value / kMillimetres : value, si_unit, 4);
    };
    std::vector<std::string> row{measure.title, unit_name(si_unit), shown(measure.value)};
    if (s.against) {
      const double reference = measure_named(s.against->measures, measure.name);
      row.push_back(shown(reference));
      row.push_back(ratio_text(measure.value, reference));
    }
    table.rows.push_back(std::move(row));
  }
  if (s.discard > 0)
    table.note =
        "The first " + format_number(s.discard) + " s do not count: the weighting's own start.";
  return table;
}

FigurePanel time_panel(const Simulation& s, const std::string& channel, const std::string& title,
                       const std::string& si_unit) {
  return channel_panel(drawn_runs(s), channel, title, si_unit,
                       shown_stretch(s.duration, s.discard));
}

/// The motion of the ground, which is the same for both runs: under each of several tyres.
FigurePanel ground_panel(const Simulation& s) {
  const std::vector<Tyre>& tyres = s.run.vehicle->set.plant.tyres;
  const FigureSeries alone{"", "measured", {}, {}, FigureSeries::Mark::Line, 1.2};
  const auto panel_of = [&](const std::string& channel, const char* si_unit,
                            const FigureSeries& look) {
    return channel_panel({{&s.run, look}}, channel, "Ground", si_unit,
                         shown_stretch(s.duration, s.discard));
  };
  if (tyres.empty()) return panel_of("ground_acceleration", "m/s^2", alone);
  FigurePanel panel = panel_of(tyres.front().name + "_road", "m", alone);
  if (tyres.size() == 1) return panel;

  // The colours of the runs stay theirs.
  panel.series.clear();
  for (std::size_t k = 0; k < tyres.size(); ++k) {
    const FigureSeries look = controller_look("under " + tyres[k].name, k + 1);
    panel.series.push_back(panel_of(tyres[k].name + "_road", "m", look).series.front());
  }
  return panel;
}

/// The acceleration of a floor with the ground's, of which the measures are.
FigurePanel floor_acceleration_panel(const Simulation& s, const std::string& floor) {
  FigurePanel panel{.title = floor + ", acceleration, absolute",
                    .x_label = "time, s",
                    .y_label = {},
                    .series = {},
                    .y_unit = "m/s^2"};
  for (const auto& [run, look] : drawn_runs(s)) {
    const Record& trace = run->trace.record;
    std::vector<double> absolute = trace.channel(floor + "_acceleration").samples;
    const std::vector<double>& ground = trace.channel("ground_acceleration").samples;
    for (std::size_t k = 0; k < absolute.size(); ++k) absolute[k] += ground[k];
    panel.series.push_back(
        over_time(trace.time, absolute, shown_stretch(s.duration, s.discard), look));
  }
  return panel;
}

bool is_driven(const Vehicle& vehicle) {
  return vehicle.limits.current_min < vehicle.limits.current_max;
}

std::vector<FigurePanel> time_panels(const Simulation& s) {
  const Plant& plant = s.run.vehicle->set.plant;
  std::vector<FigurePanel> panels{ground_panel(s)};
  if (plant.tyres.empty()) {
    const std::string top = plant.coordinates.back().name;
    panels.push_back(time_panel(s, top, top + ", displacement", "m"));
    panels.push_back(floor_acceleration_panel(s, top));
  } else {
    const std::string body = plant.coordinates.front().name;
    panels.push_back(time_panel(s, body + "_acceleration", body + ", acceleration", "m/s^2"));
  }
  for (FigurePanel& panel :
       tyre_and_strut_panels(drawn_runs(s), plant, shown_stretch(s.duration, s.discard)))
    panels.push_back(std::move(panel));

  // The drives of the dampers that have one.
  std::vector<DrawnRun> driven = drawn_runs(s);
  std::erase_if(driven, [](const DrawnRun& one) { return !is_driven(*one.run->vehicle); });
  if (!is_driven(*s.run.vehicle)) return panels;
  const DriveUnit drive = s.run.vehicle->drive_unit;
  const std::string unit = drive == DriveUnit::None ? "0 to 1" : to_string(drive);
  for (const Strut& strut : plant.struts)
    panels.push_back(channel_panel(driven, strut.name + "_current", strut.name + ", drive", unit,
                                   shown_stretch(s.duration, s.discard)));
  return panels;
}

/// The work of each damper: force over velocity.
DocumentFigure work_figure(const Simulation& s) {
  const std::vector<Strut>& struts = s.run.vehicle->set.plant.struts;
  DocumentFigure figure{.name = "force-velocity",
                        .title = struts.size() == 1 ? "The damper at work" : "The dampers at work",
                        .caption = "Force over velocity, sample by sample.",
                        .panels = {},
                        .columns = std::min<std::size_t>(2, struts.size())};
  for (const Strut& strut : struts) {
    FigurePanel& panel =
        figure.panels.emplace_back(FigurePanel{.title = struts.size() == 1 ? "" : strut.name,
                                               .x_label = "velocity",
                                               .y_label = "damper force",
                                               .series = {},
                                               .x_unit = "m/s",
                                               .y_unit = "N"});

    // A few thousand samples of each run are enough to see the curve.
    for (const auto& [run, look] : drawn_runs(s)) {
      FigureSeries dots = look;
      dots.mark = FigureSeries::Mark::Dots;
      const std::vector<double>&v = run->trace.record.channel(strut.name + "_velocity").samples,
            &f = run->trace.record.channel(strut.name + "_force").samples;
      for (std::size_t k = 0; k < v.size(); k += v.size() / 4000 + 1) {
        dots.x.push_back(v[k]);
        dots.y.push_back(f[k]);
      }
      panel.series.push_back(std::move(dots));
    }
  }
  return figure;
}

/// "drift at most 1.57 mm (floor_2), 71 % less": of the measures FLOOR_drift of all floors.
std::string worst_floor(const Simulation& s, const std::string& ending, const std::string& what,
                        double in_si, const std::string& si_unit) {
  const auto worst_of = [&](const SimulatedRun& run) {
    const RideMeasure* worst = nullptr;
    for (const RideMeasure& one : run.measures)
      if (one.name.ends_with(ending) && (!worst || one.value > worst->value)) worst = &one;
    return worst;
  };
  const RideMeasure* worst = worst_of(s.run);
  if (!worst) return {};
  const std::string floor = worst->name.substr(0, worst->name.size() - ending.size());
  const std::string text = what + " at most " + quantity(in_si * worst->value, si_unit) + ' ' +
                           unit_name(si_unit) + " (" + floor + ")";
  const RideMeasure* reference = s.against ? worst_of(*s.against) : nullptr;
  return reference ? text + ", " + against_text(worst->value, reference->value) : text;
}

std::string building_verdict(const Simulation& s) {
  const std::string drift = worst_floor(s, "_drift", s.against ? "drift" : "Drift",
                                        1 / kMillimetres, "m"),
                    acceleration =
                        worst_floor(s, "_acceleration", "absolute acceleration", 1, "m/s^2");
  return (s.against ? "Against " + s.against->name + ": " : "") + drift + "; " + acceleration + '.';
}

std::string verdict_of(const Simulation& s) {
  if (std::string why = unusable(s.run); !why.empty()) return why;
  const Plant& plant = s.run.vehicle->set.plant;
  if (plant.tyres.empty()) return building_verdict(s);
  if (!s.against) {
    const double a = measure_named(s.run.measures, "weighted_acceleration");
    if (!std::isfinite(a)) return "";
    return "a_w " + quantity(a, "m/s^2") + ' ' + unit_name("m/s^2") + ": " +
           std::string(RideComfort{.weighted_rms = a}.feeling()) +
           " by ISO 2631-1 (bands as recalled).";
  }

  // Beside a reference, the change counts.
  const auto change = [&](const char* measure) {
    return against_text(measure_named(s.run.measures, measure),
                        measure_named(s.against->measures, measure));
  };
  return "Against " + s.against->name + ": " + change("weighted_acceleration") +
         " weighted acceleration, " + change("tyre_load") + " dynamic " + foot_of(plant) + " load.";
}

}  // namespace

Document simulation_document(const Simulation& s) {
  const Vehicle& vehicle = *s.run.vehicle;
  Document document{
      .title = vehicle.set.plant.title.empty() ? vehicle.set.name : vehicle.set.plant.title,
      .subtitle = s.run.name + " on " + s.ground,
      .verdict = verdict_of(s),
      .sections = {},
      .command = {},
      .version = {},
      .date = {}};

  // Wheels that share a damper name it once.
  std::vector<std::string> names = vehicle.damper_names;
  names.erase(std::unique(names.begin(), names.end()), names.end());
  document.sections.push_back(
      {.name = "measures",
       .title = "Measures",
       .paragraphs = {"Ground: " + s.ground + ", " + format_number(s.duration) +
                      " s. Damper: " + join(names, "; ") + "."},
       .tables = {measure_table(s)},
       .figures = {},
       .remarks = run_remarks(runs_of(s))});

  // Over time, and the damper at work.
  DocumentSection time{.name = "time", .title = "Over time", .paragraphs = {}};
  const auto [from, to] = shown_stretch(s.duration, s.discard);
  time.figures.push_back({"time", "From " + format_number(from) + " to " + format_number(to) + " s",
                          "Drag to enlarge. The traces beside this page hold all of it.",
                          time_panels(s), 2});
  if (!vehicle.set.plant.struts.empty()) time.figures.push_back(work_figure(s));
  document.sections.push_back(std::move(time));
  return document;
}

Value simulation_json(const Simulation& s) {
  const auto json_of = [](const SimulatedRun& run) {
    Value measures = Value::array();
    for (const RideMeasure& m : run.measures)
      measures.push_back(
          Value::object({{"name", m.name},
                         {"unit", m.unit},
                         {"value", std::isfinite(m.value) ? Value(m.value) : Value()}}));
    return Value::object(
        {{"name", run.name},
         {"dampers", Value::array(run.vehicle->damper_names)},
         {"damping_min", run.vehicle->limits.damping_min},
         {"damping_max", run.vehicle->limits.damping_max},
         {"measures", std::move(measures)},
         {"diverged_at", run.trace.diverged_at ? Value(*run.trace.diverged_at) : Value()},
         {"warnings", Value::array(run.warnings)}});
  };

  // The run, and the one it is compared with.
  return Value::object({{"plant", s.run.vehicle->set.name},
                        {"ground", s.ground},
                        {"duration", s.duration},
                        {"run", json_of(s.run)},
                        {"against", s.against ? json_of(*s.against) : Value()},
                        {"remarks", Value::array(run_remarks(runs_of(s)))}});
}

}  // namespace dashpot
