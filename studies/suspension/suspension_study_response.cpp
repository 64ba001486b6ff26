// Figures 12 and 13 and table 8 of the one-sensor paper beside ours.
#include <cmath>

#include <fmt/format.h>

#include "dashpot/report/series.h"
#include "dashpot/report/words.h"
#include "studies/suspension/suspension_study_parts.h"

namespace dashpot {
namespace {

const std::vector<std::string> kDrawn{"passive", "linear", "mix1", "skyhook", "sh_add"};
constexpr double kComfortBand = 2;  // Hz, the paper's
constexpr double kFrom = 0.5, kTo = 20;

std::string colour_of(std::size_t k) { return k == 0 ? "series-6" : "series-" + std::to_string(k); }

FigurePanel gain_panel(const SuspensionStudy& study, Gain GainPoint::* signal,
                       const std::string& title, const std::string& label) {
  FigurePanel panel{.title = title, .x_label = "frequency, Hz", .y_label = label, .series = {}};
  for (std::size_t k = 0; k < kDrawn.size(); ++k) {
    const std::size_t place = study.place(kDrawn[k]);
    FigureSeries within{
        .label = study.schemes[place].title, .colour = colour_of(k), .x = {}, .y = {}};
    for (const GainPoint& point : study.rides[place].large) {
      within.x.push_back(point.frequency);
      within.y.push_back((point.*signal).fundamental);
    }

    // Where the damper is faster than in its recordings, a broken line.
    FigureSeries beyond = within;
    beyond.mark = FigureSeries::Mark::Dashes;
    beyond.is_listed = beyond.is_read = false;
    const double fastest = study.schemes[place].fastest;
    const auto is_beyond = [&](std::size_t n) {
      return study.rides[place].large[n].speed > fastest;
    };
    for (std::size_t n = 0; n < within.y.size(); ++n) {
      if (is_beyond(n)) within.y[n] = NAN;
      const bool joins = is_beyond(n) || (n > 0 && is_beyond(n - 1)) ||
                         (n + 1 < within.y.size() && is_beyond(n + 1));
      if (!joins) beyond.y[n] = NAN;
    }
    panel.series.push_back(std::move(within));
    panel.series.push_back(std::move(beyond));
  }
  return panel;
}

FigureSeries limit_line(const std::string& label, std::vector<double> x, std::vector<double> y) {
  return {.label = label,
          .colour = "measured",
          .x = std::move(x),
          .y = std::move(y),
          .mark = FigureSeries::Mark::Dashes};
}

DocumentTable gain_table(const SuspensionStudy& study) {
  DocumentTable table{"Greatest gains",
                      {{"Suspension", false, 0, true},
                       {"Body, to 2 Hz, 1/s^2", true},
                       {"less than passive, %", true},
                       {"Tyre, 2 cm", true},
                       {"less than passive, %", true},
                       {"Tyre, 2 mm", true},
                       {"less than passive, %", true, 2},
                       {"Tyre pulls, % of the time", true, 3},
                       {"Damper beyond its data, %", true, 4}},
                      {}};

  // The body's gain in the paper's comfort band, the tyre's over all frequencies.
  const auto body = [](const SchemeRide& r) {
    return greatest_gain(r.large, &GainPoint::body_acceleration, kFrom, kComfortBand);
  };
  const auto large = [](const SchemeRide& r) {
    return greatest_gain(r.large, &GainPoint::tyre_deflection, kFrom, kTo);
  };
  const auto small = [](const SchemeRide& r) {
    return greatest_gain(r.small, &GainPoint::tyre_deflection, kFrom, kTo);
  };

  // Each scheme, and by how much less than passive it is.
  const SchemeRide& passive = study.rides.front();
  for (std::size_t k = 0; k < study.rides.size(); ++k) {
    const SchemeRide& ride = study.rides[k];
    table.rows.push_back(
        {study.schemes[k].title, number_text(body(ride)),
         whole_text(less_percent(body(passive), body(ride))), number_text(large(ride)),
         whole_text(less_percent(large(passive), large(ride))), number_text(small(ride)),
         whole_text(less_percent(small(passive), small(ride))),
         number_text(100 * ride.contact_lost, 2), number_text(100 * ride.too_fast, 2)});
  }
  table.note =
      "Fundamental gains, read over four periods along an exponential chirp. The paper: tyre 2.0 "
      "controlled, 40.4 % less than passive, so 3.36 passive.";
  return table;
}

FigurePanel step_panel(const SuspensionStudy& study, const std::string& channel, double factor,
                       const std::string& title, const std::string& label) {
  FigurePanel panel{.title = title, .x_label = "time, s", .y_label = label, .series = {}};
  constexpr std::size_t kPoints = 1500;
  for (std::size_t k = 0; k < kDrawn.size(); ++k) {
    // Each scheme for two seconds after the step, as many points as print can show.
    const std::size_t place = study.place(kDrawn[k]);
    const Record& record = study.rides[place].step.record;
    const std::vector<double>& samples = record.channel(channel).samples;
    FigureSeries series{
        .label = study.schemes[place].title, .colour = colour_of(k), .x = {}, .y = {}};
    for (const std::size_t n : thinned_indices({samples}, kPoints)) {
      if (record.time[n] > 2) break;
      series.x.push_back(record.time[n]);
      series.y.push_back(factor * samples[n]);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

std::string decay_text(const std::optional<double>& ratio) {
  return ratio ? number_text(*ratio, 2) : "-";
}

DocumentTable step_table(const SuspensionStudy& study) {
  DocumentTable table{"Table 8",
                      {{"Suspension", false, 0, true},
                       {"Body settles, s", true},
                       {"Decay ratio", true},
                       {"Greatest, m/s^2", true},
                       {"Tyre settles, s", true},
                       {"Decay ratio", true},
                       {"Greatest, cm", true},
                       {"Travel, cm", true},
                       {"Body rms, m/s^2", true, 2},
                       {"less, %", true, 2},
                       {"Tyre force rms, N", true, 3},
                       {"less, %", true, 3}},
                      {}};

  // The paper's two rows; it prints improvements instead of root mean squares.
  const auto printed = [&](const std::string& name, const paper::StepRow& comfort,
                           const paper::StepRow& holding, const std::string& body_less,
                           const std::string& tyre_less) {
    table.rows.push_back({name, number_text(comfort.settling), number_text(comfort.decay),
                          number_text(comfort.deviation), number_text(holding.settling),
                          number_text(holding.decay), number_text(holding.deviation), "-", "-",
                          body_less, "-", tyre_less});
  };
  printed("the paper, semi-active", paper::kComfort, paper::kHolding,
          number_text(paper::kComfortRmsLess), number_text(paper::kHoldingRmsLess));
  printed("the paper, passive", paper::kComfortPassive, paper::kHoldingPassive, "0", "0");

  // Each scheme, its root mean squares against the identified passive damper.
  const RideSquares& passive = study.rides.front().on_step;
  for (std::size_t k = 0; k < study.rides.size(); ++k) {
    const SchemeRide& ride = study.rides[k];
    const double body = std::sqrt(ride.on_step.acceleration),
                 tyre = std::sqrt(ride.on_step.tyre_force);
    table.rows.push_back(
        {study.schemes[k].title, number_text(ride.comfort.settling_time),
         decay_text(ride.comfort.decay_ratio), number_text(ride.comfort.greatest_deviation),
         number_text(ride.holding.settling_time), decay_text(ride.holding.decay_ratio),
         number_text(100 * ride.holding.greatest_deviation), number_text(100 * ride.travel),
         number_text(body), whole_text(less_percent(std::sqrt(passive.acceleration), body)),
         whole_text(tyre), whole_text(less_percent(std::sqrt(passive.tyre_force), tyre))});
  }
  table.note = fmt::format(
      "Settled: within 5 % of the acceleration's peak, of the step's height. Decay ratio: second "
      "positive peak over the first. Travel: the damper's greatest. Root mean squares over {} s. "
      "The paper prints the accelerations in m/s^0.5: they are m/s^2.",
      number_text(study.options.step_duration));
  return table;
}

}  // namespace

DocumentSection frequency_section(const SuspensionStudy& study) {
  DocumentSection section{"figure-12", "Figure 12: frequency response", {}};

  // The paper's claims on both gains, on its own chirp of 2 cm.
  const SchemeRide &passive = study.rides.front(), &mix1 = study.rides[study.place("mix1")];
  const auto tyre = [](const std::vector<GainPoint>& gains) {
    return greatest_gain(gains, &GainPoint::tyre_deflection, kFrom, kTo);
  };
  const auto body = [](const std::vector<GainPoint>& gains) {
    return greatest_gain(gains, &GainPoint::body_acceleration, kFrom, kComfortBand);
  };
  section.paragraphs.push_back(fmt::format(
      "Up to 2 Hz the body's greatest gain under Mix-1-sensor {}; the paper claims less than "
      "passive. The tyre's greatest gain {}, to {}; the paper claims that it falls by 40.4 %, to "
      "2. Its limit of 2.5 is {}.",
      change_words(body(passive.large), body(mix1.large)),
      change_words(tyre(passive.large), tyre(mix1.large)), number_text(tyre(mix1.large)),
      tyre(mix1.large) <= paper::kWheelGainLimit ? "kept" : "not kept"));
  section.paragraphs.push_back(
      "The paper calls its curves power spectral densities; they are gains, greatest output over "
      "input at a frequency, and so are these.");

  // The gains of all schemes, then the figure with the paper's limits.
  section.tables.push_back(gain_table(study));
  DocumentFigure figure{
      .name = "figure-12",
      .title = "Figure 12: gains over the road",
      .caption =
          "Chirp of 2 cm from 0.5 to 20 Hz, as the paper's. Dashed: its limits, and curves "
          "where the damper is faster than on the bench.",
      .panels = {gain_panel(study, &GainPoint::body_acceleration, "Comfort",
                            "body acceleration over road, 1/s^2"),
                 gain_panel(study, &GainPoint::tyre_deflection, "Road holding",
                            "tyre deflection over road")}};
  figure.panels[0].series.push_back(
      limit_line("the paper's limits", {kComfortBand, kComfortBand}, {0, 400}));
  figure.panels[1].series.push_back(limit_line("the paper's limits", {kFrom, kTo},
                                               {paper::kWheelGainLimit, paper::kWheelGainLimit}));
  section.figures.push_back(std::move(figure));

  // Deflection at rest and at the resonance, mm: the tyre would leave the road.
  const Tyre& wheel = study.plant.tyres.front();
  const double rest = 1000 * wheel.static_load / wheel.stiffness, swing = 20 * tyre(mix1.large);
  section.remarks.push_back(
      fmt::format("With 2 cm the tyre's deflection swings by {} mm at the wheel's resonance, and "
                  "at rest it is {} mm: the tyre would leave the road. The paper's model, and this "
                  "one, let it pull. At 2 mm it stays on it.",
                  number_text(swing), number_text(rest)));
  section.remarks.push_back(
      "The identified dampers are not linear, so their gains depend on the amplitude. Beyond the "
      "bench's velocities a network says nothing: there the force goes on straight, with the "
      "slope of the outermost fifth, as that of open valves does. What hangs on it is dashed.");
  return section;
}

DocumentSection step_section(const SuspensionStudy& study) {
  DocumentSection section{"figure-13", "Figure 13 and table 8: a step of 3 cm", {}};

  // The change of both root mean squares, beside the paper's.
  const RideSquares &passive = study.rides.front().on_step,
                    &mix1 = study.rides[study.place("mix1")].on_step;
  section.paragraphs.push_back(fmt::format(
      "The body's acceleration under Mix-1-sensor {} in root mean square (the paper: falls by 7.4 "
      "%), the tyre's force {} (the paper: 'road holding' improves by 64.9 %).",
      change_words(std::sqrt(passive.acceleration), std::sqrt(mix1.acceleration)),
      change_words(std::sqrt(passive.tyre_force), std::sqrt(mix1.tyre_force))));

  // Table 8, and the figure behind it.
  section.tables.push_back(step_table(study));
  section.figures.push_back(
      {.name = "figure-13",
       .title = "Figure 13: after the step",
       .caption = "Road step of 3 cm at t = 0.",
       .panels = {
           step_panel(study, "body_acceleration", 1, "Comfort", "body acceleration, m/s^2"),
           step_panel(study, "tyre_deflection", 100, "Road holding", "tyre deflection, cm")}});

  // Figures of table 8 that do not follow from the paper's model or its text.
  const SchemeRide &curve = study.rides.front(), &controlled = study.rides[study.place("mix1")];
  section.remarks.push_back(fmt::format(
      "The tyre's deflection begins at -3.0 cm, the step itself, and nothing in equations 3 and 4 "
      "takes it further: table 8's -3.8 and -4.5 cm, 15.6 % apart, cannot be that. They fit the "
      "travel of the damper: here {} cm under Mix-1-sensor and {} cm passive, {} % less.",
      number_text(100 * controlled.travel), number_text(100 * curve.travel),
      number_text(less_percent(curve.travel, controlled.travel))));
  section.remarks.push_back(
      "The figures of table 8 themselves: settling 62.5 and 64.7 % shorter, decay ratio 53.3 % "
      "less, deviation 8.9 % less of the body and 15.6 % of the tyre, where the text says about 10 "
      "%.");
  return section;
}

}  // namespace dashpot
