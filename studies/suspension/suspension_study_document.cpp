#include "studies/suspension/suspension_study_document.h"

#include <cmath>

#include <fmt/format.h>

#include "dashpot/report/words.h"
#include "studies/suspension/suspension_study_parts.h"

namespace dashpot {
namespace {

FigureSeries force_curve(const DamperModel& model, double current, const std::string& label,
                         const std::string& colour) {
  FigureSeries series{.label = label, .colour = colour, .x = {}, .y = {}};
  for (int k = -75; k <= 75; ++k) {
    const double v = 0.02 * k;
    series.x.push_back(v);
    series.y.push_back(model.force({0, v, current}, {}));
  }
  return series;
}

std::string verdict_of(const SuspensionStudy& study) {
  // Mix-1-sensor against the linear damper; the bound is for any damper on the step.
  const SchemeRide &linear = study.rides[study.place("linear")],
                   &mix1 = study.rides[study.place("mix1")];
  const ClairvoyantBound& holding = study.any_damper.back();
  const auto tyre = [](const SchemeRide& ride) {
    return greatest_gain(ride.large, &GainPoint::tyre_deflection, 0.5, 20);
  };

  // The least damping that the claim needs, and whether the other claim can be reached at all.
  const double needed = least_damping_for(study, paper::kWheelGain);
  return fmt::format(
      "Mix-1-sensor with the identified damper against the linear damper that has the paper's "
      "passive gain: at the wheel's resonance the tyre's gain {} (the paper: by 40.4 %), on the "
      "road the tyre's force {} and the body's acceleration {}. Those 40.4 % need a damper whose "
      "least damping is {}. The 64.9 % of road holding after a step, if the tyre's force is meant, "
      "{}; the tyre settles in {} s instead of {} s. MR2 here is a virtual damper, shaped after "
      "the paper's words.",
      change_words(tyre(linear), tyre(mix1)),
      change_words(std::sqrt(linear.on_road.tyre_force), std::sqrt(mix1.on_road.tyre_force)),
      change_words(std::sqrt(linear.on_road.acceleration), std::sqrt(mix1.on_road.acceleration)),
      needed > 0 ? number_text(std::round(needed), 4) + " N*s/m" : "beyond the sweep",
      less_percent(std::sqrt(linear.on_step.tyre_force),
                   std::sqrt(holding.bound / holding.index.holding)) < paper::kHoldingRmsLess
          ? "no damper reaches from there, had it known the road: that is proven"
          : "are not ruled out",
      number_text(mix1.holding.settling_time, 2), number_text(linear.holding.settling_time, 2));
}

Value step_json(const StepMeasures& step) {
  return Value::object({{"settling_time", step.settling_time},
                        {"decay_ratio", step.decay_ratio ? Value(*step.decay_ratio) : Value()},
                        {"greatest_deviation", step.greatest_deviation}});
}

}  // namespace

double less_percent(double from, double to) { return 100 * (1 - to / from); }

std::string change_words(double from, double to) {
  const double less = less_percent(from, to);
  if (std::abs(less) < 0.05) return "stays";
  return fmt::format("{} by {} %", less > 0 ? "falls" : "rises", number_text(std::abs(less), 3));
}

DocumentSection suspension_protocol(const SuspensionStudy& study) {
  DocumentSection section{"protocol", "How it was done", {}};

  // The paper's task, the damper and its control, the passive damper, the inputs.
  section.paragraphs = {
      "The paper (MR Damper Identification using ANN based on 1-Sensor) closes with a quarter car, "
      "its equations 3 and 4 with table 7, whose damper is the network that it identified, under "
      "Mix-1-sensor control, against a passive damper identified by the same technique. Its "
      "figures and table stand beside ours.",
      fmt::format(
          "The damper is MR2, a virtual one, recorded in the paper's five experiments on a virtual "
          "bench and identified by its network: velocity and current, ten neurons. Its coil lags "
          "by 10 ms. Mix-1-sensor and the other two-level laws switch between 0 and 2.5 A at 1 "
          "kHz; the crossover is {} Hz, 1.75 times the body's resonance.",
          number_text(study.crossover)),
      "The passive damper is not printed. Here it is the " + study.passive.description +
          ", recorded in the first two experiments and identified like MR2. 1804 N*s/m is the "
          "linear damper with the paper's passive gain at the wheel's resonance; it stands as a "
          "row of its own.",
      fmt::format("Inputs: a chirp of 2 cm from 0.5 to 20 Hz and a step of 3 cm, as in the paper, "
                  "and {}. The clairvoyant bound and optimum are explained in docs/bound.md.",
                  study.road)};
  return section;
}

DocumentSection suspension_dampers(const SuspensionStudy& study) {
  DocumentSection section{"dampers", "The dampers", {}};

  // The quality of both networks on recordings left out.
  DocumentTable table{"The networks on recordings that they have not seen",
                      {{"Damper", false, 0, true},
                       {"RMS, N", true},
                       {"half-span %", true},
                       {"ESR %", true},
                       {"Numbers", true, 2}},
                      {}};
  for (const NetworkDamper* damper : {&study.damper, &study.passive})
    table.rows.push_back({damper->name, number_text(damper->quality.rmse),
                          number_text(100 * damper->quality.rmse / damper->half_span),
                          number_text(damper->quality.esr),
                          std::to_string(damper->model->parameter_count())});

  // The identified damper's damping at the ends of its current.
  table.note = fmt::format(
      "Along a sine of 20 mm at 0.2 m/s MR2 damps like {} N*s/m at 0 A and {} N*s/m at 2.5 A. The "
      "force that a network shows at rest without current was taken off.",
      number_text(study.limits.damping_min, 4), number_text(study.limits.damping_max, 4));
  section.tables.push_back(std::move(table));

  // The curves that the car is driven with.
  section.figures.push_back(
      {.name = "dampers",
       .title = "Force over velocity",
       .caption = "What the car is driven with.",
       .panels = {{.title = "",
                   .x_label = "velocity, m/s",
                   .y_label = "force, N",
                   .series = {force_curve(*study.damper.model, 0, "MR2, 0 A", "series-1"),
                              force_curve(*study.damper.model, study.limits.current_max,
                                          "MR2, 2.5 A", "series-2"),
                              force_curve(*study.passive.model, 0, "passive", "series-6")}}}});
  return section;
}

Document suspension_study_document(const SuspensionStudy& study) {
  Document document;
  document.title = "The one-sensor paper's suspension, repeated";
  document.subtitle = "quarter car, identified damper, Mix-1-sensor";
  document.verdict = verdict_of(study);
  document.sections = {suspension_protocol(study), suspension_dampers(study),
                       frequency_section(study),   step_section(study),
                       possible_section(study),    least_damping_section(study),
                       claims_section(study)};
  return document;
}

Value suspension_study_json(const SuspensionStudy& study) {
  // Every scheme with its gains, shares of the chirp, step measures and mean squares.
  Value schemes = Value::array();
  for (std::size_t k = 0; k < study.rides.size(); ++k) {
    const SchemeRide& ride = study.rides[k];
    const auto gain = [](const std::vector<GainPoint>& gains, Gain GainPoint::* signal, double to) {
      return greatest_gain(gains, signal, 0.5, to);
    };
    schemes.push_back(
        Value::object({{"name", study.schemes[k].key},
                       {"title", study.schemes[k].title},
                       {"within_range", study.schemes[k].within_range},
                       {"body_gain", gain(ride.large, &GainPoint::body_acceleration, 2)},
                       {"tyre_gain", gain(ride.large, &GainPoint::tyre_deflection, 20)},
                       {"tyre_gain_small", gain(ride.small, &GainPoint::tyre_deflection, 20)},
                       {"tyre_pulls", ride.contact_lost},
                       {"damper_beyond_data", ride.too_fast},
                       {"step_comfort", step_json(ride.comfort)},
                       {"step_holding", step_json(ride.holding)},
                       {"step", squares_json(ride.on_step)},
                       {"road", squares_json(ride.on_road)}}));
  }

  // The sweep of the least damping.
  Value sweep = Value::array();
  for (const LeastDamping& one : study.least_damping)
    sweep.push_back(Value::object({{"least_damping", one.least},
                                   {"tyre_gain", one.wheel_gain},
                                   {"body_gain", one.body_gain},
                                   {"step", squares_json(one.on_step)},
                                   {"road", squares_json(one.on_road)}}));

  // Settings, both lists and the three fronts.
  return Value::object({{"road", study.road},
                        {"crossover", study.crossover},
                        {"damping_min", study.limits.damping_min},
                        {"damping_max", study.limits.damping_max},
                        {"schemes", schemes},
                        {"least_damping", sweep},
                        {"least_damping_for_claim", least_damping_for(study, paper::kWheelGain)},
                        {"road_front", front_json(study.road_front)},
                        {"step_front", front_json(study.step_front)},
                        {"step_front_any_damper", front_json(study.any_damper)}});
}

}  // namespace dashpot
