#include "studies/suspension/own_damper_study.h"

#include <functional>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/report/ride_document.h"
#include "dashpot/report/ride_figures.h"
#include "dashpot/report/words.h"
#include "studies/suspension/suspension_study_parts.h"

namespace dashpot {
namespace {

constexpr double kChirp = 0.02, kStep = 0.03;  // m

/// Why the forces of this hardware have no bound; empty where they have one.
std::string reason_for_no_bound(VehicleWords words, const std::string& controller) {
  words.controller = controller;
  const Vehicle vehicle = make_vehicle(words);
  try {
    possible_forces(vehicle, {.travel = 0.1, .speed = 1}, "bound");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// One of the paper's figures of its suspension.
struct OwnClaim {
  std::string words, paper;
  std::function<double(const RiddenVehicle&)> read;
};

std::vector<OwnClaim> own_claims() {
  const auto on_step = [](const char* measure) {
    return
        [measure](const RiddenVehicle& one) { return measure_named(one.step.measures, measure); };
  };
  // Gains by sines, then the step: comfort, road holding, and what table 8 has.
  return {{"body's greatest gain up to 2 Hz", "less",
           [](const RiddenVehicle& one) {
             return greatest_gain(one, &GainPoint::body_acceleration, kPaperComfortTo);
           }},
          {"tyre's greatest gain up to 20 Hz", number_text(paper::kWheelGainLess),
           [](const RiddenVehicle& one) {
             return greatest_gain(one, &GainPoint::tyre_deflection, kPaperHoldingTo);
           }},
          {"step: body rms", number_text(paper::kComfortRmsLess), on_step("body_acceleration")},
          {"step: tyre force rms (as it may be meant)", number_text(paper::kHoldingRmsLess),
           on_step("tyre_load")},
          {"step: body settles",
           number_text(less_percent(paper::kComfortPassive.settling, paper::kComfort.settling)),
           on_step("settling")},
          {"step: tyre settles",
           number_text(less_percent(paper::kHoldingPassive.settling, paper::kHolding.settling)),
           on_step("tyre_settling")},
          {"step: body's decay ratio",
           number_text(less_percent(paper::kComfortPassive.decay, paper::kComfort.decay)),
           on_step("decay_ratio")},
          {"step: body's greatest acceleration",
           number_text(less_percent(paper::kComfortPassive.deviation, paper::kComfort.deviation)),
           on_step("deviation")},
          {"step: greatest travel",
           number_text(less_percent(paper::kHoldingPassive.deviation, paper::kHolding.deviation)),
           on_step("travel_peak")}};
}

DocumentTable own_claims_table(const RideStudy& study) {
  DocumentTable table{
      .title = "Less than passive, %",
      .columns = {{.title = "Figure"}, {.title = "the paper, Mix-1-sensor", .numeric = true}},
      .rows = {},
      .note =
          "Below 0: more than " + study.passive.name() +
          ". Gains by sines of 2 cm, the step of 3 cm, as the paper has them; its other damper, "
          "its car and its passive damper are not these. The paper names no index behind its "
          "64.9 %, and its table 8 fits the damper's travel (docs/suspension-study.md)."};
  for (const RiddenVehicle& one : study.controlled)
    table.columns.push_back({.title = one.name(), .numeric = true});

  // A row for each of the paper's figures, a column for each controller.
  for (const OwnClaim& claim : own_claims()) {
    std::vector<std::string> row{claim.words, claim.paper};
    const double passive = claim.read(study.passive);
    for (const RiddenVehicle& one : study.controlled)
      row.push_back(number_text(less_percent(passive, claim.read(one))));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Which controllers do both things that the paper asks of one.
std::string answer(const RideStudy& study) {
  const auto body = [](const RiddenVehicle& one) {
    return greatest_gain(one, &GainPoint::body_acceleration, kPaperComfortTo);
  };
  std::vector<std::string> able;
  for (const RiddenVehicle& one : study.controlled)
    if (body(one) < body(study.passive) &&
        greatest_gain(one, &GainPoint::tyre_deflection, kPaperHoldingTo) <= kPaperHoldingLimit)
      able.push_back(one.name());

  constexpr const char* kAsked =
      "less body acceleration than passive up to 2 Hz and a gain of the tyre's deflection of 2.5 "
      "at most up to 20 Hz";
  if (able.empty())
    return fmt::format("With this damper no controller here gives both {}.", kAsked);
  return fmt::format("Of the {} here {} give{} both {}.",
                     counted(study.controlled.size(), "controller"), join(able, ", "),
                     able.size() == 1 ? "s" : "", kAsked);
}

}  // namespace

OwnDamperStudy study_own_damper(const OwnDamper& own) {
  RideStudyOptions options{
      .vehicle = {.plant = own.plant, .dampers = {own.damper}, .where = "study suspension"},
      .controllers = own.controllers,
      .against = own.passive,
      .gains = {.amplitude = kChirp},
      .road_duration = own.road_duration,
      .step_height = kStep,
      .seed = own.seed,
      .threads = own.threads,
      .monitor = own.monitor};
  if (options.controllers.empty()) throw Error("study suspension", "no controller to study");

  // What has no bound is ridden without one.
  OwnDamperStudy study;
  study.unbounded = reason_for_no_bound(options.vehicle, options.controllers.front());
  options.bound = study.unbounded.empty();
  study.ride = study_ride(options);
  return study;
}

Document own_damper_document(const OwnDamperStudy& study) {
  Document document = ride_document(study.ride);
  document.title = "The one-sensor paper's questions, asked of this suspension";
  document.verdict = answer(study.ride) + " " + document.verdict;

  // The paper's figures come first, and what cannot be said of this damper.
  DocumentSection section{.name = "paper", .title = "Beside the paper's figures"};
  section.tables.push_back(own_claims_table(study.ride));
  if (!study.unbounded.empty())
    section.remarks.push_back("What is possible at best is not known: " + study.unbounded);
  document.sections.insert(document.sections.begin(), std::move(section));
  return document;
}

}  // namespace dashpot
