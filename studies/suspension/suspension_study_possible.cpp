// Bounds on the ride, and the least damping that the paper's claim needs.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "dashpot/report/words.h"
#include "studies/suspension/suspension_study_parts.h"

namespace dashpot {
namespace {

using Front = std::vector<ClairvoyantBound>;

constexpr std::size_t kMiddle = 2;  // of kFrontWeights: both alike

std::vector<std::string> front_row(const std::string& name, const ClairvoyantBound& best,
                                   double unit) {
  const int digits = 4;
  return {name, number_text(std::sqrt(best.bound) * unit, digits),
          number_text(std::sqrt(best.optimum) * unit, digits),
          number_text(100 * (1 - std::sqrt(best.bound / best.optimum)), 2)};
}

/// rms m/s^2, N, and of both alike as a share of passive.
double unit_of(const ClairvoyantBound& best) {
  if (best.index.holding == 0) return 1 / std::sqrt(best.index.comfort);
  if (best.index.comfort == 0) return 1 / std::sqrt(best.index.holding);
  return 1;
}

DocumentTable bound_table(const SuspensionStudy& study) {
  // Comfort alone, both alike and road holding alone, of each front.
  DocumentTable table{
      "Bound and optimum, root mean squares",
      {{"Index", false, 0, true}, {"Proven bound", true}, {"Reached", true}, {"Gap, %", true}},
      {}};
  const auto add = [&](const std::string& where, const Front& front) {
    const std::pair<std::string, std::size_t> shown[] = {{"body acceleration, m/s^2", 0},
                                                         {"both alike, over passive", kMiddle},
                                                         {"tyre force, N", front.size() - 1}};
    for (const auto& [name, k] : shown)
      table.rows.push_back(front_row(where + ": " + name, front[k], unit_of(front[k])));
  };

  // The identified damper on both inputs, and any damping on the step.
  add("road, this damper", study.road_front);
  add("step, this damper", study.step_front);
  add(fmt::format("step, any damping to {} N*s/m", number_text(study.greatest_possible, 5)),
      study.any_damper);
  table.note =
      "Proven: no force within the damper's range does better, whatever made it. Reached: "
      "simulated, by demands that were found knowing the road. The truth about the best lies "
      "between.";
  return table;
}

DocumentTable share_table(const SuspensionStudy& study, const std::string& title,
                          const Front& front, RideSquares SchemeRide::* where) {
  DocumentTable table{title,
                      {{"Suspension", false, 0, true},
                       {"Body rms, m/s^2", true},
                       {"% of possible", true},
                       {"Tyre rms, N", true},
                       {"% of possible", true},
                       {"Both, over passive", true, 2},
                       {"% of possible", true, 2}},
                      {}};

  // Shares between the same damper at 0 A and the best that knew the road.
  const RideSquares& off = study.rides[study.place("off")].*where;
  const ClairvoyantBound &comfort = front.front(), &both = front[kMiddle], &holding = front.back();

  // Only schemes with that damper have such shares.
  const auto add = [&](const std::string& name, const RideSquares& squares, bool within) {
    const auto share = [&](const ClairvoyantBound& best) {
      return within ? possible_text(best, off, squares) : "-";
    };
    table.rows.push_back({name, number_text(std::sqrt(squares.acceleration)), share(comfort),
                          whole_text(std::sqrt(squares.tyre_force)), share(holding),
                          number_text(root_of(both.index, squares)), share(both)});
  };

  // Every scheme, then the optima themselves.
  for (std::size_t k = 0; k < study.rides.size(); ++k)
    add(study.schemes[k].title, study.rides[k].*where, study.schemes[k].within_range);
  add("knew the road: best for comfort", comfort.squares, true);
  add("knew the road: best for both", both.squares, true);
  add("knew the road: best for holding", holding.squares, true);
  table.note =
      "% of possible = (off - controller) / (off - optimum), of root mean squares, off being the "
      "same damper at 0 A; - where the damper is another one. Both: the two mean squares, each "
      "over that of passive.";
  return table;
}

/// One entry of the legend for schemes of a kind.
FigureSeries look_of(const SuspensionScheme& scheme) {
  const auto dots = [](const char* label, const char* colour) {
    return FigureSeries{.label = label,
                        .colour = colour,
                        .x = {},
                        .y = {},
                        .mark = FigureSeries::Mark::Dots,
                        .width = 6};
  };
  if (scheme.key.starts_with("mix1")) return dots("Mix-1-sensor", "series-1");
  if (scheme.key == "off" || scheme.key == "on") return dots("MR2 at 0 A, at 2.5 A", "series-3");
  if (scheme.within_range) return dots("other controllers", "series-2");
  return dots("other dampers: passive, ideal", "series-6");
}

DocumentFigure front_figure(const SuspensionStudy& study) {
  FigurePanel panel{.title = "Road, class C",
                    .x_label = "body acceleration, rms, m/s^2",
                    .y_label = "tyre force, rms, N",
                    .series = {}};

  // The front of the road, bound and optimum, and a point for each scheme.
  panel.series = front_lines(study.road_front, {1, 1});
  for (std::size_t k = 0; k < study.rides.size(); ++k) {
    FigureSeries point = look_of(study.schemes[k]);
    point.x = {std::sqrt(study.rides[k].on_road.acceleration)};
    point.y = {std::sqrt(study.rides[k].on_road.tyre_force)};
    panel.series.push_back(std::move(point));
  }

  // The caption says to which damper the bound belongs.
  return {.name = "front",
          .title = "Comfort against road holding",
          .caption =
              "Below the dashed line there is nothing: proven for forces within the identified "
              "damper's range. Passive and ideal dampers are other dampers.",
          .panels = {std::move(panel)}};
}

/// The ride with the least index among the damper's own schemes on the road.
RideSquares best_within(const SuspensionStudy& study, const ClairvoyantBound& index) {
  RideSquares best = study.rides[study.place("off")].on_road;
  for (std::size_t k = 0; k < study.rides.size(); ++k)
    if (study.schemes[k].within_range &&
        root_of(index.index, study.rides[k].on_road) < root_of(index.index, best))
      best = study.rides[k].on_road;
  return best;
}

}  // namespace

DocumentSection possible_section(const SuspensionStudy& study) {
  DocumentSection section{"possible", "What is possible at best", {}};

  // The ends of the front on the road, and how far controllers come towards them.
  const SchemeRide &passive = study.rides.front(), &mix1 = study.rides[study.place("mix1")],
                   &off = study.rides[study.place("off")];
  const ClairvoyantBound &comfort = study.road_front.front(), &holding = study.road_front.back();
  const auto reached = [&](const RideSquares& squares, const ClairvoyantBound& best) {
    return possible_text(best, off.on_road, squares);
  };
  section.paragraphs.push_back(fmt::format(
      "On {} the least body acceleration that this damper could give, had it known the road, lies "
      "between {} and {} m/s^2 (at 0 A it gives {}, the passive damper {}), the least tyre force "
      "between {} and {} N (at 0 A {}, passive {}). Of what is possible beyond 0 A Mix-1-sensor "
      "reaches {} % for comfort and {} % for road holding, the best controllers {} and {} %.",
      study.road, number_text(std::sqrt(comfort.bound) * unit_of(comfort)),
      number_text(std::sqrt(comfort.optimum) * unit_of(comfort)),
      number_text(std::sqrt(off.on_road.acceleration)),
      number_text(std::sqrt(passive.on_road.acceleration)),
      whole_text(std::sqrt(holding.bound) * unit_of(holding)),
      whole_text(std::sqrt(holding.optimum) * unit_of(holding)),
      whole_text(std::sqrt(off.on_road.tyre_force)),
      whole_text(std::sqrt(passive.on_road.tyre_force)), reached(mix1.on_road, comfort),
      reached(mix1.on_road, holding), reached(best_within(study, comfort), comfort),
      reached(best_within(study, holding), holding)));

  // Bounds, shares on both inputs, and the front as a figure.
  section.tables.push_back(bound_table(study));
  section.tables.push_back(
      share_table(study, "On the road", study.road_front, &SchemeRide::on_road));
  section.tables.push_back(
      share_table(study, "On the step", study.step_front, &SchemeRide::on_step));
  section.figures.push_back(front_figure(study));

  // A reason for the gap between bound and optimum.
  section.remarks.push_back(
      "The range is the network's own, from its least to its greatest force over all currents at "
      "each velocity up to twice the fastest on the bench, straight on beyond that: the bounds are "
      "for rides that stay within. They are proven with a limit on every rounding.");
  return section;
}

double least_damping_for(const SuspensionStudy& study, double wheel_gain) {
  const std::vector<LeastDamping>& sweep = study.least_damping;
  for (std::size_t k = 0; k < sweep.size(); ++k) {
    if (sweep[k].wheel_gain > wheel_gain) continue;
    if (k == 0) return sweep[k].least;
    const double share =
        (sweep[k - 1].wheel_gain - wheel_gain) / (sweep[k - 1].wheel_gain - sweep[k].wheel_gain);
    return sweep[k - 1].least + share * (sweep[k].least - sweep[k - 1].least);
  }
  return 0;
}

DocumentSection least_damping_section(const SuspensionStudy& study) {
  DocumentSection section{"least-damping", "Which least damping the paper's claim needs", {}};

  // The least damping for the paper's gain and for its limit, read from the sweep.
  const double needed = least_damping_for(study, paper::kWheelGain),
               limit = least_damping_for(study, paper::kWheelGainLimit);
  const auto text = [](double damping) {
    return damping > 0 ? number_text(std::round(damping), 4) + " N*s/m" : "more than the sweep has";
  };

  // The same gains by linear dampers, for comparison.
  section.paragraphs.push_back(
      fmt::format("At the wheel's resonance Mix-1-sensor asks for the least damping nearly all the "
                  "time, so the least damping alone decides on the tyre's gain there. A linear "
                  "damper gives the paper's passive gain of 3.36 with {} N*s/m, its limit of 2.5 "
                  "with {}, its 2.0 with {}. Mix-1-sensor gives 2.5 from a least damping of {} on, "
                  "and 2.0 from {} on: twice the passive damper's, with the current off.",
                  number_text(damping_for_wheel_gain(study.plant, 3.3557), 4),
                  number_text(damping_for_wheel_gain(study.plant, paper::kWheelGainLimit), 4),
                  number_text(damping_for_wheel_gain(study.plant, paper::kWheelGain), 4),
                  text(limit), text(needed)));
  section.paragraphs.push_back(fmt::format(
      "The paper says that the gain \"reduces until 2 units\" and calls that 40.4 %, which also "
      "reads as by 2 units: from {} to {}. Linear dampers give these with {} and {} N*s/m, "
      "Mix-1-sensor the latter from a least damping of {} on.",
      number_text(paper::kWheelGainPassiveBy), number_text(paper::kWheelGainBy),
      number_text(damping_for_wheel_gain(study.plant, paper::kWheelGainPassiveBy), 4),
      number_text(damping_for_wheel_gain(study.plant, paper::kWheelGainBy), 4),
      text(least_damping_for(study, paper::kWheelGainBy))));

  // The sweep as a table and as curves: gains and mean squares against the linear damper.
  DocumentTable table{"Mix-1-sensor on ideal dampers",
                      {{"Least damping, N*s/m", true},
                       {"Tyre's greatest gain", true},
                       {"less than 3.36, %", true},
                       {"Body to 2 Hz, 1/s^2", true},
                       {"Step: body rms less, %", true},
                       {"Step: tyre rms less, %", true},
                       {"Road: body rms less, %", true, 2},
                       {"Road: tyre rms less, %", true, 2}},
                      {}};
  const SchemeRide& linear = study.rides[study.place("linear")];
  FigurePanel panel{
      .title = "",
      .x_label = "least damping, N*s/m",
      .y_label = "less than passive, %",
      .series = {{.label = "tyre's greatest gain", .colour = "series-1", .x = {}, .y = {}},
                 {.label = "step: tyre force rms", .colour = "series-2", .x = {}, .y = {}},
                 {.label = "step: body rms", .colour = "series-3", .x = {}, .y = {}},
                 {.label = "road: body rms", .colour = "series-4", .x = {}, .y = {}}}};
  const auto less = [](double from, double to) {
    return less_percent(std::sqrt(from), std::sqrt(to));
  };

  // Four values make the curves; the table has further ones.
  for (const LeastDamping& one : study.least_damping) {
    const double values[] = {
        less_percent(paper::kWheelGain / (1 - paper::kWheelGainLess / 100), one.wheel_gain),
        less(linear.on_step.tyre_force, one.on_step.tyre_force),
        less(linear.on_step.acceleration, one.on_step.acceleration),
        less(linear.on_road.acceleration, one.on_road.acceleration)};
    table.rows.push_back({number_text(one.least, 4), number_text(one.wheel_gain),
                          whole_text(values[0]), number_text(one.body_gain), whole_text(values[2]),
                          whole_text(values[1]), whole_text(values[3]),
                          whole_text(less(linear.on_road.tyre_force, one.on_road.tyre_force))});
    for (std::size_t k = 0; k < panel.series.size(); ++k) {
      panel.series[k].x.push_back(one.least);
      panel.series[k].y.push_back(values[k]);
    }
  }

  // The paper's claim as a line across the figure.
  table.note = "Against the linear damper of 1804 N*s/m; below 0: worse than passive.";
  panel.series.push_back(
      {.label = "the paper's 40.4 %",
       .colour = "measured",
       .x = {study.least_damping.front().least, study.least_damping.back().least},
       .y = {paper::kWheelGainLess, paper::kWheelGainLess},
       .mark = FigureSeries::Mark::Dashes});
  section.tables.push_back(std::move(table));
  section.figures.push_back(
      {.name = "least-damping",
       .title = "What Mix-1-sensor gains by the least damping",
       .caption = "Greatest damping as the identified damper's, or a fifth above the least.",
       .panels = {std::move(panel)}});

  // The comfort that such a damper gives up.
  section.remarks.push_back(
      "A damper so stiff without current gives up the comfort that it is controlled for: the "
      "claims of more comfort and of 40.4 % at the wheel's resonance do not go together here.");
  return section;
}

}  // namespace dashpot
