#include "dashpot/report/ride_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/report/front_parts.h"
#include "dashpot/report/ride_parts.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

constexpr double kWhole = std::numeric_limits<double>::infinity();

/// A vehicle of the study as all its curves look.
struct Drawn {
  const RiddenVehicle* ridden;
  FigureSeries look;
};

std::vector<Drawn> drawn(const RideStudy& study) {
  std::vector<Drawn> all{{&study.passive, passive_look(study.passive.name())}};
  for (std::size_t k = 0; k < study.controlled.size(); ++k)
    all.push_back({&study.controlled[k], controller_look(study.controlled[k].name(), k)});
  return all;
}

using Read = std::function<double(const GainPoint&)>;

Read fundamental(Gain GainPoint::* signal) {
  return [signal](const GainPoint& point) { return (point.*signal).fundamental; };
}

FigureSeries gain_curve(const std::vector<GainPoint>& points, const Read& read, double to,
                        FigureSeries series) {
  for (const GainPoint& point : points)
    if (point.frequency <= to) {
      series.x.push_back(point.frequency);
      series.y.push_back(read(point));
    }
  return series;
}

FigurePanel gain_panel(const RideStudy& study, const std::string& title, const std::string& unit,
                       const Read& read, double to = kWhole) {
  FigurePanel panel{title, "frequency, Hz", unit, {}};
  for (const auto& [ridden, look] : drawn(study))
    panel.series.push_back(gain_curve(ridden->sines, read, to, look));
  return panel;
}

/// A level that the paper draws.
FigureSeries limit_line(const std::string& label, double from, double to, double level) {
  return {label, "measured", {from, to}, {level, level}, FigureSeries::Mark::Dashes, 1.6};
}

FigureSeries dot(const std::string& label, const std::string& colour, double x, double y,
                 double size) {
  return {label, colour, {x}, {y}, FigureSeries::Mark::Dots, size};
}

/// The mark of a vehicle's points: rings are to dots what dashes are to lines.
FigureSeries::Mark point_mark(const FigureSeries& look) {
  return look.mark == FigureSeries::Mark::Dashes ? FigureSeries::Mark::Rings
                                                 : FigureSeries::Mark::Dots;
}

/// A vehicle as a point.
FigureSeries point_of(const FigureSeries& look, double x, double y) {
  FigureSeries point = dot(look.label, look.colour, x, y, 5);
  point.mark = point_mark(look);
  return point;
}

/// One run of each of these vehicles.
std::vector<DrawnRun> runs_of(const std::vector<Drawn>& vehicles,
                              const SimulatedRun RiddenVehicle::* run) {
  std::vector<DrawnRun> runs;
  for (const auto& [ridden, look] : vehicles) runs.push_back({&(ridden->*run), look});
  return runs;
}

}  // namespace

double greatest_gain(const RiddenVehicle& ridden, Gain GainPoint::* signal, double to) {
  double top = 0;
  for (const GainPoint& point : ridden.sines)
    if (point.frequency <= to) top = std::max(top, (point.*signal).fundamental);
  return top;
}

DocumentFigure gain_figure(const RideStudy& study) {
  const std::vector<double>& f = study.options.frequencies;
  const Plant& plant = study.plant();
  const auto &body = &GainPoint::body_acceleration, &tyre = &GainPoint::tyre_deflection;
  const std::string &body_name = plant.coordinates.front().name,
                    &tyre_name = plant.tyres.front().name;
  const std::string acceleration = body_name + ", acceleration";
  std::vector<FigurePanel> panels;

  // The signals that the paper limits, each with its limit.
  panels.push_back(gain_panel(study, acceleration, "gain, 1/s^2", fundamental(body)));
  panels.push_back(
      gain_panel(study, acceleration + " at its resonance", "gain, 1/s^2", fundamental(body), 4));
  panels.back().series.push_back(limit_line("passive, greatest to 2 Hz", f.front(), kPaperComfortTo,
                                            greatest_gain(study.passive, body, kPaperComfortTo)));
  panels.push_back(gain_panel(study, tyre_name + ", deflection", "gain", fundamental(tyre)));
  panels.back().series.push_back(limit_line("one-sensor paper: 2.5 at most", f.front(),
                                            std::min(f.back(), kPaperHoldingTo),
                                            kPaperHoldingLimit));

  // Signals without a limit, and the harmonics that a law adds.
  panels.push_back(
      gain_panel(study, body_name + ", displacement", "gain", fundamental(&GainPoint::body), 5));
  panels.push_back(gain_panel(study, plant.struts.front().name + ", travel", "gain",
                              fundamental(&GainPoint::travel)));
  panels.push_back(gain_panel(study, acceleration + ": variance over fundamental gain", "ratio",
                              [](const GainPoint& point) {
                                return point.body_acceleration.variance /
                                       point.body_acceleration.fundamental;
                              }));
  return {
      "gains", "Gains by sines",
      "Fundamental gain over the road's height, " +
          format_number(1000 * study.options.gains.amplitude) +
          " mm. The last panel shows how much a law adds at other frequencies: 1 is none; a law "
          "that chatters shows there, and not in its fundamental.",
      std::move(panels), 2};
}

DocumentFigure chirp_figure(const RideStudy& study) {
  const Plant& plant = study.plant();
  const std::string body = plant.coordinates.front().name, tyre = plant.tyres.front().name;
  std::vector<FigurePanel> panels;
  for (const auto& [signal, title, unit] :
       {std::tuple{&GainPoint::body_acceleration, body + ", acceleration", "gain, 1/s^2"},
        std::tuple{&GainPoint::tyre_deflection, tyre + ", deflection", "gain"}}) {
    FigurePanel panel{title, "frequency, Hz", unit, {}};

    // The chirp as a line, the sines as points on it.
    for (const auto& [ridden, look] : drawn(study)) {
      panel.series.push_back(gain_curve(ridden->chirp, fundamental(signal), kWhole, look));
      FigureSeries sines = gain_curve(ridden->sines, fundamental(signal), kWhole, look);
      sines.mark = point_mark(look);
      sines.width = 2.5;
      panel.series.push_back(std::move(sines));
    }
    panels.push_back(std::move(panel));
  }
  return {
      "chirp", "Gains by one chirp",
      "Lines: " + format_number(study.options.gains.chirp) +
          " s of exponential chirp, read over four periods about each frequency. Points: by sines.",
      std::move(panels), 2};
}

DocumentFigure trade_off_figure(const RideStudy& study) {
  const auto x = [&](const RiddenVehicle& one) {
    return measure_named(one.road.measures, "weighted_acceleration");
  };
  const auto y = [&](const RiddenVehicle& one) {
    return measure_named(one.road.measures, "tyre_load");
  };
  const double x0 = x(study.passive), y0 = y(study.passive);
  const Plant& plant = study.plant();
  FigurePanel panel{
      "",
      "weighted " + plant.coordinates.front().name + " acceleration, ratio to passive",
      "dynamic " + foot_of(plant) + " load, ratio to passive",
      {}};

  // The dampers held at each drive, as a line with its points.
  FigureSeries line{"held without control", "series-6", {}, {}, FigureSeries::Mark::Line, 1.4};
  for (const TradeOff& point : study.held) {
    line.x.push_back(point.weighted / x0);
    line.y.push_back(point.tyre / y0);
  }
  FigureSeries dots = line;
  dots.mark = FigureSeries::Mark::Dots;
  dots.width = 2.5;
  panel.series = {line, dots, dot(study.passive.name(), "measured", 1, 1, 5)};

  // Every controller as a point of its own.
  for (const auto& [ridden, look] : drawn(study))
    if (ridden != &study.passive)
      panel.series.push_back(point_of(look, x(*ridden) / x0, y(*ridden) / y0));
  return {"trade-off",
          "The trade-off on the road",
          "To the left: more comfort; down: better road holding. The grey line is what the same "
          "dampers do at any one drive, from the softest to the hardest: a controller pays where "
          "it lies below and left of it.",
          {std::move(panel)},
          1};
}

DocumentFigure possible_figure(const RideStudy& study) {
  const Plant& plant = study.plant();
  const auto roots = [&](const RiddenVehicle& one) {
    const RideSquares squares = ride_squares(one.road.trace, plant);
    return RideRoots{std::sqrt(squares.acceleration), std::sqrt(squares.tyre_force)};
  };
  const RideRoots unit = roots(study.passive);
  FigurePanel panel{
      "", "body acceleration, rms, ratio to passive", "tyre force, rms, ratio to passive", {}};
  panel.series = front_lines(study.front, unit);

  // Every vehicle as a point above the front.
  for (const auto& [ridden, look] : drawn(study)) {
    const RideRoots at = roots(*ridden);
    FigureSeries point =
        point_of(look, at.acceleration / unit.acceleration, at.tyre_force / unit.tyre_force);
    if (!ridden->in_range) point.label += " (outside)";
    panel.series.push_back(std::move(point));
  }
  return {"possible",
          "What is possible on this road",
          "Below and left of the dashed line there is nothing for any controller: proven for "
          "forces within the damper's range, however made. The line beside it was reached in "
          "simulation, by demands found with the road known in advance.",
          {std::move(panel)},
          1};
}

DocumentFigure road_figure(const RideStudy& study) {
  const auto least = [&](const char* measure) {
    return std::ranges::min_element(study.controlled, {},
                                    [&](const RiddenVehicle& one) {
                                      return measure_named(one.road.measures, measure);
                                    }) -
           study.controlled.begin();
  };
  const std::vector<Drawn> all = drawn(study);
  std::vector<Drawn> shown{all.front()};
  const std::ptrdiff_t comfort = least("weighted_acceleration"), holding = least("tyre_load");
  shown.push_back(all[static_cast<std::size_t>(comfort) + 1]);
  if (holding != comfort) shown.push_back(all[static_cast<std::size_t>(holding) + 1]);

  // A few seconds after the start.
  const Plant& plant = study.plant();
  const std::string& body = plant.coordinates.front().name;
  const double duration = study.options.road_duration;
  const Stretch stretch = shown_stretch(duration, std::max(0.0, std::min(5.0, duration - 5)));
  const std::vector<DrawnRun> runs = runs_of(shown, &RiddenVehicle::road);
  DocumentFigure figure{.name = "road",
                        .title = "A stretch of the road",
                        .caption = "Passive, the most comfortable and the best on the road.",
                        .panels = {channel_panel(runs, body + "_acceleration",
                                                 body + ", acceleration", "m/s^2", stretch)},
                        .columns = 2};
  for (FigurePanel& panel : tyre_and_strut_panels(runs, plant, stretch))
    figure.panels.push_back(std::move(panel));
  return figure;
}

DocumentFigure step_figure(const RideStudy& study) {
  const Plant& plant = study.plant();
  const std::string& body = plant.coordinates.front().name;
  const Stretch stretch{0, 2};
  const std::vector<DrawnRun> runs = runs_of(drawn(study), &RiddenVehicle::step);
  DocumentFigure figure{.name = "step",
                        .title = "After the step",
                        .caption = "The road rises at 0 s, at once.",
                        .panels = {channel_panel(runs, body + "_acceleration",
                                                 body + ", acceleration", "m/s^2", stretch)},
                        .columns = 2};
  for (const Tyre& tyre : plant.tyres)
    figure.panels.push_back(
        channel_panel(runs, tyre.name + "_deflection", tyre.name + ", deflection", "m", stretch));
  return figure;
}

}  // namespace dashpot
