// Which of the one-sensor paper's claims on its suspension follow from its model.
#include <cmath>

#include <fmt/format.h>

#include "dashpot/output/suspension_study_parts.h"
#include "dashpot/output/words.h"

namespace dashpot {
namespace {

struct Claim {
  std::string words, paper;
  double passive = 0, ours = 0;
  double claimed = 0;   ///< % less than passive
  double possible = 0;  ///< % less than passive that the bound leaves room for; NaN: not bounded
};

/// At most this far below passive, %, by the bounds of a front's end.
double room(double passive_square, double least_square) {
  return less_percent(std::sqrt(passive_square), std::sqrt(least_square));
}

std::vector<Claim> claims_of(const SuspensionStudy& study) {
  const SchemeRide &passive = study.rides.front(), &mix1 = study.rides[study.place("mix1")];
  const auto gain = [](const SchemeRide& ride, Gain GainPoint::* signal, double to) {
    return greatest_gain(ride.large, signal, 0.5, to);
  };
  const ClairvoyantBound &comfort = study.any_damper.front(), &holding = study.any_damper.back();
  return {{"tyre's greatest gain", "40.4 % less", gain(passive, &GainPoint::tyre_deflection, 20),
           gain(mix1, &GainPoint::tyre_deflection, 20), paper::kWheelGainLess, NAN},
          {"body's greatest gain up to 2 Hz", "less", gain(passive, &GainPoint::body_acceleration, 2),
           gain(mix1, &GainPoint::body_acceleration, 2), 0, NAN},
          {"step: body rms, m/s^2", "7.4 % less", std::sqrt(passive.on_step.acceleration),
           std::sqrt(mix1.on_step.acceleration), paper::kComfortRmsLess,
           room(passive.on_step.acceleration, comfort.bound / comfort.index.comfort)},
          {"step: tyre rms, N", "64.9 % less", std::sqrt(passive.on_step.tyre_force),
           std::sqrt(mix1.on_step.tyre_force), paper::kHoldingRmsLess,
           room(passive.on_step.tyre_force, holding.bound / holding.index.holding)},
          {"step: body settles, s", "62.5 % less", passive.comfort.settling_time, mix1.comfort.settling_time,
           62.5, NAN},
          {"step: tyre settles, s", "64.7 % less", passive.holding.settling_time, mix1.holding.settling_time,
           64.7, NAN},
          {"step: body's greatest, m/s^2", "8.9 % less", std::abs(passive.comfort.greatest_deviation),
           std::abs(mix1.comfort.greatest_deviation), 8.9, NAN},
          {"step: tyre's greatest, cm", "15.6 % less", 100 * std::abs(passive.holding.greatest_deviation),
           100 * std::abs(mix1.holding.greatest_deviation), 15.6, NAN}};
}

std::string judgement(const Claim& claim) {
  const double less = less_percent(claim.passive, claim.ours);
  if (claim.claimed > claim.possible) return "impossible with any damper";
  if (less >= 0.9 * claim.claimed && less > 0) return "follows";
  if (less > 0.5) return "in direction, not in size";
  return less < -0.5 ? "the opposite" : "no effect";
}

}  // namespace

DocumentSection claims_section(const SuspensionStudy& study) {
  DocumentSection section{"claims", "Which claims follow", {}};
  DocumentTable table{"Mix-1-sensor against passive",
                      {{"Claim", false, 0, true},
                       {"The paper", false},
                       {"Passive here", true},
                       {"Mix-1 here", true},
                       {"less, %", true},
                       {"At most, %", true, 2},
                       {"Judgement", false}},
                      {}};
  for (const Claim& claim : claims_of(study))
    table.rows.push_back({claim.words, claim.paper, number_text(claim.passive), number_text(claim.ours),
                          number_text(less_percent(claim.passive, claim.ours), 2),
                          number_text(claim.possible, 3), judgement(claim)});
  table.note = fmt::format(
      "At most: the proven bound for any damping up to {} N*s/m that knew the step, against the same "
      "passive damper.",
      number_text(study.greatest_possible, 5));
  section.tables.push_back(std::move(table));
  section.remarks = {
      "The paper's passive damper is known by one figure only, the gain of 3.36 at the wheel's resonance. A "
      "softer passive damper would make every improvement larger; what is said here holds against this one.",
      "MR2 here is a virtual damper, shaped after the paper's words: orderings can be compared, sizes "
      "cannot. The sweep of the least damping and the bound for any damper do not rest on it.",
      "The crossover of Mix-1-sensor is not printed either: here it is 1.75 times the body's resonance."};
  return section;
}

}  // namespace dashpot
