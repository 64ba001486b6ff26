// The one-sensor paper's claims on its suspension, held against its own model.
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "dashpot/report/words.h"
#include "studies/suspension/suspension_study_parts.h"

namespace dashpot {
namespace {

struct Claim {
  std::string words, paper;
  double curve = 0, linear = 0, ours = 0;  ///< of both passive dampers; of Mix-1-sensor
  double claimed = 0;                      ///< % less than passive
  double least = 0;                        ///< proven: no damper makes it less; NaN: not bounded
};

using Reading = std::function<double(const SchemeRide&)>;

Reading gain(std::vector<GainPoint> SchemeRide::* chirp, Gain GainPoint::* signal, double to) {
  return [=](const SchemeRide& ride) { return greatest_gain(ride.*chirp, signal, 0.5, to); };
}

std::vector<Claim> claims_of(const SuspensionStudy& study) {
  // A figure of both passive dampers and of Mix-1-sensor.
  const auto claim = [&](std::string words, std::string paper, double claimed, const Reading& read,
                         double least = NAN) {
    return Claim{std::move(words),
                 std::move(paper),
                 read(study.rides.front()),
                 read(study.rides[study.place("linear")]),
                 read(study.rides[study.place("mix1")]),
                 claimed,
                 least};
  };

  // Gains on the chirps, then the step: only its root mean squares have a proven bound.
  const ClairvoyantBound &comfort = study.any_damper.front(), &holding = study.any_damper.back();
  return {
      claim("tyre's greatest gain, chirp of 2 cm", "40.4 % less", paper::kWheelGainLess,
            gain(&SchemeRide::large, &GainPoint::tyre_deflection, 20)),
      claim("the same, of 2 mm", "", paper::kWheelGainLess,
            gain(&SchemeRide::small, &GainPoint::tyre_deflection, 20)),
      claim("body's greatest gain up to 2 Hz", "less", 0,
            gain(&SchemeRide::large, &GainPoint::body_acceleration, 2)),
      claim(
          "step: body rms, m/s^2", "7.4 % less", paper::kComfortRmsLess,
          [](const SchemeRide& ride) { return std::sqrt(ride.on_step.acceleration); },
          std::sqrt(comfort.bound / comfort.index.comfort)),
      claim(
          "step: tyre rms, N (as it may be meant)", "64.9 % less", paper::kHoldingRmsLess,
          [](const SchemeRide& ride) { return std::sqrt(ride.on_step.tyre_force); },
          std::sqrt(holding.bound / holding.index.holding)),
      claim("step: body settles, s", "62.5 % less", 62.5,
            [](const SchemeRide& ride) { return ride.comfort.settling_time; }),
      claim("step: tyre settles, s", "64.7 % less", paper::kHoldingSettlingLess,
            [](const SchemeRide& ride) { return ride.holding.settling_time; }),
      claim("step: body's greatest, m/s^2", "8.9 % less", 8.9,
            [](const SchemeRide& ride) { return std::abs(ride.comfort.greatest_deviation); }),
      claim("step: tyre's greatest, cm", "15.6 % less", 15.6,
            [](const SchemeRide& ride) { return 100 * std::abs(ride.holding.greatest_deviation); }),
      claim("the same, read as travel, cm", "15.6 % less", 15.6,
            [](const SchemeRide& ride) { return 100 * std::abs(ride.travel); })};
}

/// The outcome of a claim against one passive damper.
enum class Outcome { Opposite, Nothing, Less, Follows };
Outcome outcome(const Claim& claim, double passive) {
  const double less = less_percent(passive, claim.ours);
  if (less > 0.5) return less >= 0.9 * claim.claimed ? Outcome::Follows : Outcome::Less;
  return less < -0.5 ? Outcome::Opposite : Outcome::Nothing;
}

std::string judgement(const Claim& claim) {
  // The bound rules it out even from the worse of the passive dampers.
  if (claim.claimed > less_percent(std::max(claim.curve, claim.linear), claim.least))
    return "no damper can do it";

  // Both passive dampers must agree on what becomes of the claim.
  const Outcome curve = outcome(claim, claim.curve), linear = outcome(claim, claim.linear);
  if (curve != linear) return "depends on the passive damper";
  switch (curve) {
    case Outcome::Follows:
      return "follows";
    case Outcome::Less:
      return "in direction, not in size";
    case Outcome::Nothing:
      return "no effect";
    case Outcome::Opposite:
      break;
  }
  return "the opposite";
}

}  // namespace

DocumentSection claims_section(const SuspensionStudy& study) {
  DocumentSection section{"claims", "Which claims follow", {}};

  // A row for each claim, judged against both passive dampers.
  DocumentTable table{"Mix-1-sensor against passive",
                      {{"Claim", false, 0, true},
                       {"The paper", false},
                       {"Passive curve", true, 3},
                       {"Linear 1804", true, 3},
                       {"Mix-1", true},
                       {"less than curve, %", true},
                       {"less than linear, %", true},
                       {"Any damper, least", true, 2},
                       {"Judgement", false}},
                      {}};

  // The figures, the improvement on each, the bound and the judgement.
  for (const Claim& claim : claims_of(study))
    table.rows.push_back({claim.words, claim.paper, number_text(claim.curve, 4),
                          number_text(claim.linear, 4), number_text(claim.ours, 4),
                          whole_text(less_percent(claim.curve, claim.ours)),
                          whole_text(less_percent(claim.linear, claim.ours)),
                          number_text(claim.least, 4), judgement(claim)});

  // The note explains what "any damper" means.
  table.note = fmt::format(
      "Any damper, least: the proven bound for any damping up to {} N*s/m that knew the step. No "
      "damper can do it: even from the worse of the two passive dampers the bound is not so far "
      "down.",
      number_text(study.greatest_possible, 5));
  section.tables.push_back(std::move(table));

  // Limits of the judgement.
  section.remarks = {
      "The paper's passive damper is known by one figure only, the gain of 3.36 at the wheel's "
      "resonance; against a worse one every improvement is larger. What is said here holds against "
      "these two.",
      "MR2 here is a virtual damper, shaped after the paper's words: orderings can be compared, "
      "sizes cannot. The sweep of the least damping and the bound for any damper do not rest on "
      "it.",
      "The crossover of Mix-1-sensor is not printed either: here it is 1.75 times the body's "
      "resonance.",
      "The paper names no index behind the 64.9 % of road holding. They are read here as the root "
      "mean square of the tyre's force, like the 7.4 % of comfort; its own table 8 has 64.7 % in "
      "the time that the tyre needs to settle, which no bound rules out."};
  return section;
}

}  // namespace dashpot
