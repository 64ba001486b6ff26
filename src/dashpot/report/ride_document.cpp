#include "dashpot/report/ride_document.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/report/front_parts.h"
#include "dashpot/report/ride_figures.h"
#include "dashpot/report/ride_parts.h"
#include "dashpot/report/words.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

double on_road(const RiddenVehicle& ridden, const char* measure) {
  return measure_named(ridden.road.measures, measure);
}

/// Every vehicle of the study, the passive one first.
std::vector<const RiddenVehicle*> all_of(const RideStudy& study) {
  std::vector<const RiddenVehicle*> all{&study.passive};
  for (const RiddenVehicle& one : study.controlled) all.push_back(&one);
  return all;
}

DocumentTable road_table(const RideStudy& study) {
  const Plant& plant = study.plant();
  const auto number = [](const std::string& title, int priority = 0) {
    return TextColumn{.title = title, .numeric = true, .priority = priority};
  };
  DocumentTable table{.title = "On the road",
                      .columns = {{.title = "controller"},
                                  number("a_w, m/s^2"),
                                  number("ratio"),
                                  number(foot_of(plant) + " load, %"),
                                  number("ratio"),
                                  number("travel, mm"),
                                  number("ratio"),
                                  number("contact lost, %", 1),
                                  number("drive, %", 2)},
                      .rows = {},
                      .note = "Ratios to " + study.passive.name() + ". a_w: weighted " +
                              plant.coordinates.front().name +
                              " acceleration, Wk. Load: dynamic over static, rms. Travel: "
                              "greatest."};

  // Each measure with its ratio to passive.
  for (const RiddenVehicle* one : all_of(study)) {
    std::vector<std::string> row{one->name()};
    for (const char* measure : {"weighted_acceleration", "tyre_load", "travel_peak"}) {
      row.push_back(number_text(on_road(*one, measure), 3));
      row.push_back(ratio_text(on_road(*one, measure), on_road(study.passive, measure)));
    }
    row.push_back(number_text(on_road(*one, "contact_lost"), 3));
    row.push_back(number_text(on_road(*one, "current"), 3));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// What the bounds are said of: the whole of the ride, from rest on, as are the figures here.
std::string possible_note(const RideStudy& study) {
  std::string note =
      "% of possible = (passive - controller) / (passive - optimum), each aim by itself; - where "
      "the optimum is less than " +
      number_text(100 * kLeastPossible) +
      " % better than passive. Optimum: simulated, the road known in advance. Bound: no controller "
      "gets below whose damper's forces lie in the range that its model was sampled to have, "
      "proven with a limit on every rounding";

  // As far as the range goes.
  std::vector<std::string> within;
  if (std::isfinite(study.bounded.travel))
    within.push_back(whole_text(1000 * study.bounded.travel) + " mm of travel");
  if (std::isfinite(study.bounded.speed))
    within.push_back(number_text(study.bounded.speed) + " m/s");
  if (!within.empty())
    note += "; the damper stays within " + within.front() +
            (within.size() > 1 ? " and " + within.back() : "") +
            " either way, twice what it did in these rides";
  note += ". - : none could be proven.";

  // What the bounds do not tell, and of whom they do not speak.
  constexpr double kTelling = 0.5;  // of the optimum, root mean squares
  for (const auto& [best, aim] :
       {std::pair{&study.front.front(), "body"}, std::pair{&study.front.back(), "tyre"}})
    if (best->proven && std::sqrt(best->bound) < kTelling * std::sqrt(best->optimum))
      note += std::string(" The ") + aim +
              "'s bound is less than half of its optimum: it tells little of what is possible.";
  if (!std::ranges::all_of(all_of(study), &RiddenVehicle::in_range))
    note +=
        " Outside: its forces leave that range (another damper, or the same one with a force at "
        "rest that the springs bear), so that neither bound nor optimum speaks of it.";
  return note;
}

DocumentTable possible_table(const RideStudy& study) {
  DocumentTable table{.title = "Of what is possible",
                      .columns = {{.title = "controller"},
                                  {.title = "body rms, m/s^2", .numeric = true},
                                  {.title = "% of possible", .numeric = true},
                                  {.title = "tyre rms, N", .numeric = true},
                                  {.title = "% of possible", .numeric = true}},
                      .rows = {},
                      .note = possible_note(study)};

  // Each vehicle by the squares of its own ride.
  const Plant& plant = study.plant();
  const ClairvoyantBound &comfort = study.front.front(), &holding = study.front.back();
  const RideSquares passive = ride_squares(study.passive.road.trace, plant);
  for (const RiddenVehicle* one : all_of(study)) {
    const RideSquares squares = ride_squares(one->road.trace, plant);
    table.rows.push_back(
        {one->name() + (one->in_range ? "" : " (outside)"),
         number_text(std::sqrt(squares.acceleration)), possible_text(comfort, passive, squares),
         whole_text(std::sqrt(squares.tyre_force)), possible_text(holding, passive, squares)});
  }

  // Below them the optima and the bounds themselves.
  table.rows.push_back({"optimum of each",
                        number_text(std::sqrt(comfort.optimum / comfort.index.comfort)), "",
                        whole_text(std::sqrt(holding.optimum / holding.index.holding)), ""});
  const auto proven = [](const ClairvoyantBound& best, double weight, const auto& text) {
    return best.proven ? text(std::sqrt(best.bound / weight)) : std::string("-");
  };
  table.rows.push_back(
      {"proven bound of each",
       proven(comfort, comfort.index.comfort, [](double root) { return number_text(root); }), "",
       proven(holding, holding.index.holding, whole_text), ""});
  return table;
}

/// At most eight columns of them.
std::vector<std::size_t> shown_frequencies(const std::vector<double>& f) {
  constexpr double kTold[] = {1, 1.25, 2, 4, 8, 12, 20};
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < f.size(); ++k)
    if (std::ranges::find(kTold, f[k]) != std::end(kTold)) shown.push_back(k);
  if (shown.size() > 3) return shown;
  shown.clear();
  for (std::size_t k = 0; k < f.size(); k += (f.size() + 7) / 8) shown.push_back(k);
  return shown;
}

/// Whose gains these are, where that is one of several.
std::vector<std::string> gain_remarks(const Plant& plant) {
  if (plant.tyres.size() < 2) return {};
  return {"These gains are those of " + plant.tyres.front().name + " and of the strut " +
          plant.struts.front().name +
          " alone; what the others do may be worse. The table of the road has the worst of all."};
}

DocumentTable gain_table(const RideStudy& study) {
  const Plant& plant = study.plant();
  const std::string &body = plant.coordinates.front().name, &tyre = plant.tyres.front().name;
  DocumentTable table{
      .title = "On sines of " + format_number(1000 * study.options.gains.amplitude) + " mm",
      .columns = {{.title = "controller"}},
      .rows = {},
      .note = "Gain from the road's height to " + body +
              " acceleration at that frequency, 1/s^2 "
              "(fundamental). Jc, Jrh: root of the integral of the squared gain of " +
              body + " acceleration and of " + tyre +
              " deflection over these frequencies, as ratios to " + study.passive.name() + "."};
  const std::vector<double>& f = study.options.frequencies;
  const std::vector<std::size_t> shown = shown_frequencies(f);
  for (const std::size_t k : shown)
    table.columns.push_back({.title = format_number(f[k]) + " Hz", .numeric = true});
  table.columns.push_back({.title = "Jc", .numeric = true});
  table.columns.push_back({.title = "Jrh", .numeric = true});

  // Gains by controller, and their integrals as ratios to passive.
  for (const RiddenVehicle* one : all_of(study)) {
    std::vector<std::string> row{one->name()};
    for (const std::size_t k : shown)
      row.push_back(number_text(one->sines[k].body_acceleration.fundamental, 4));
    row.push_back(ratio_text(comfort_integral(*one), comfort_integral(study.passive)));
    row.push_back(ratio_text(holding_integral(*one), holding_integral(study.passive)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The one-sensor paper's two wishes of a controller.
DocumentTable limit_table(const RideStudy& study) {
  const Plant& plant = study.plant();
  DocumentTable table{
      .title = "The one-sensor paper's limits",
      .columns = {{.title = "controller"},
                  {.title = plant.coordinates.front().name + " acceleration to 2 Hz, greatest gain",
                   .numeric = true},
                  {.title = "below passive"},
                  {.title = plant.tyres.front().name + " deflection, greatest gain",
                   .numeric = true},
                  {.title = "at most 2.5"}},
      .rows = {},
      .note =
          "The paper asks for less body acceleration than passive up to 2 Hz, and for a gain of "
          "the tyre's deflection of 2.5 at most up to 20 Hz. Gains by sines, fundamental; 1/s^2 "
          "and 1."};

  // The first limit is set by the passive vehicle itself.
  const double passive =
      greatest_gain(study.passive, &GainPoint::body_acceleration, kPaperComfortTo);
  for (const RiddenVehicle* one : all_of(study)) {
    const double comfort = greatest_gain(*one, &GainPoint::body_acceleration, kPaperComfortTo);
    const double holding = greatest_gain(*one, &GainPoint::tyre_deflection, kPaperHoldingTo);
    table.rows.push_back({one->name(), number_text(comfort, 4),
                          one == &study.passive ? "-"
                          : comfort < passive   ? "yes"
                                                : "no",
                          number_text(holding, 3), holding <= kPaperHoldingLimit ? "yes" : "no"});
  }
  return table;
}

DocumentTable step_table(const RideStudy& study) {
  const Plant& plant = study.plant();
  const std::string &body = plant.coordinates.front().name, &tyre = plant.tyres.front().name;
  DocumentTable table{
      .title = "After a step of " + format_number(1000 * study.options.step_height) + " mm",
      .columns = {{.title = "controller"}},
      .rows = {},
      .note = "Ratios to " + study.passive.name() +
              ". Settled: the last instant outside 5 % of the peak (" + body +
              " acceleration) or of the step (" + tyre + "); '-' where the run ends outside."};
  const std::pair<std::string, std::string> measures[] = {
      {"settling", body + " settled, s"},
      {"deviation", body + " acceleration, greatest, m/s^2"},
      {"tyre_settling", tyre + " settled, s"},
      {body + "_acceleration", body + " acceleration, rms, m/s^2"}};
  for (const auto& [name, title] : measures) {
    table.columns.push_back({.title = title, .numeric = true});
    table.columns.push_back({.title = "ratio", .numeric = true, .priority = 1});
  }
  table.columns.push_back({.title = "decay ratio", .numeric = true});

  // Each measure with its ratio to passive.
  for (const RiddenVehicle* one : all_of(study)) {
    std::vector<std::string> row{one->name()};
    for (const auto& [name, title] : measures) {
      const double value = measure_named(one->step.measures, name);
      row.push_back(number_text(value, 3));
      row.push_back(ratio_text(value, measure_named(study.passive.step.measures, name)));
    }
    row.push_back(number_text(measure_named(one->step.measures, "decay_ratio"), 2));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// What its dampers do better on the road in both aims where they are held at one drive; "" where
/// no drive does.
std::string better_held(const RideStudy& study, const RiddenVehicle& one) {
  const TradeOff* best = nullptr;
  for (const TradeOff& point : study.held)
    if (point.weighted < on_road(one, "weighted_acceleration") &&
        point.tyre < on_road(one, "tyre_load") && (!best || point.weighted < best->weighted))
      best = &point;
  if (!best) return {};

  const DriveUnit unit = one.road.vehicle->drive_unit;
  const std::string drive = number_text(best->setting, 3);
  return " Held at " +
         (unit == DriveUnit::None ? "drive " + drive : drive + ' ' + to_string(unit)) +
         ", without control, the same dampers are better in both than " + one.name() + ": a_w " +
         number_text(best->weighted, 3) + " m/s^2, " + foot_of(study.plant()) + " load " +
         number_text(best->tyre, 3) + " %.";
}

std::string verdict_of(const RideStudy& study) {
  const auto least = [&](const char* measure) -> const RiddenVehicle& {
    return *std::ranges::min_element(study.controlled, {}, [&](const RiddenVehicle& one) {
      const double value = on_road(one, measure);
      return std::isfinite(value) ? value : INFINITY;
    });
  };
  const auto change = [&](const RiddenVehicle& one, const char* measure) {
    return against_text(on_road(one, measure), on_road(study.passive, measure));
  };
  const auto sentence = [&](const RiddenVehicle& one, const char* what) {
    return what + one.name() + ": " + change(one, "weighted_acceleration") +
           " weighted acceleration, " + change(one, "tyre_load") + " dynamic " +
           foot_of(study.plant()) + " load than passive.";
  };

  // One sentence where the same controller is best in both, the passive damper among them: the
  // best of the controllers may still be worse than it.
  const RiddenVehicle &comfort = least("weighted_acceleration"), &holding = least("tyre_load");
  if (study.controlled.size() == 1) return sentence(comfort, "") + better_held(study, comfort);
  const auto beats_passive = [&](const RiddenVehicle& one, const char* measure) {
    return on_road(one, measure) < on_road(study.passive, measure);
  };
  const bool comforts = beats_passive(comfort, "weighted_acceleration"),
             holds = beats_passive(holding, "tyre_load");
  if (&comfort == &holding) {
    const char* const best =
        comforts && holds ? "Best in comfort and in road holding is "
        : comforts
            ? "Most comfortable, and nearest to passive on the road, where none beats it, is "
        : holds ? "Best on the road, and nearest to passive in comfort, where none beats it, is "
                : "None beats passive in comfort or on the road; the nearest in both is ";
    return sentence(comfort, best) + better_held(study, comfort);
  }
  return sentence(comfort, comforts ? "Most comfortable is "
                                    : "None is more comfortable than passive; the nearest is ") +
         ' ' +
         sentence(holding, holds ? "Best on the road is "
                                 : "None holds the road better than passive; the nearest is ") +
         better_held(study, comfort) + better_held(study, holding);
}

Value gains_json(const std::vector<GainPoint>& points) {
  Value list = Value::array();
  const auto number = [](double x) { return std::isfinite(x) ? Value(x) : Value(); };
  const auto gain = [&](const Gain& g) {
    return Value::object(
        {{"variance", number(g.variance)}, {"fundamental", number(g.fundamental)}});
  };
  for (const GainPoint& p : points)
    list.push_back(Value::object({{"frequency", p.frequency},
                                  {"body_acceleration", gain(p.body_acceleration)},
                                  {"body", gain(p.body)},
                                  {"tyre_deflection", gain(p.tyre_deflection)},
                                  {"travel", gain(p.travel)}}));
  return list;
}

Value ridden_json(const RiddenVehicle& ridden, bool bounded) {
  const auto measures = [](const SimulatedRun& run) {
    Value object = Value::object();
    for (const RideMeasure& m : run.measures)
      object.add(m.name, std::isfinite(m.value) ? Value(m.value) : Value());
    return object;
  };

  // Integrals first, then the measures of each ride.
  Value object = Value::object({{"name", ridden.name()},
                                {"comfort_integral", comfort_integral(ridden)},
                                {"holding_integral", holding_integral(ridden)},
                                {"road", measures(ridden.road)},
                                {"step", measures(ridden.step)},
                                {"sines", gains_json(ridden.sines)},
                                {"chirp", gains_json(ridden.chirp)},
                                {"warnings", Value::array(ridden.road.warnings)}});
  if (bounded) object.add("in_range", ridden.in_range);
  return object;
}

/// The units of the measures, which are those of people.
Value measure_units_json(const RiddenVehicle& ridden) {
  Value units = Value::object();
  for (const SimulatedRun* run : {&ridden.road, &ridden.step})
    for (const RideMeasure& m : run->measures)
      if (!units.find(m.name)) units.add(m.name, m.unit);
  return units;
}

/// Warnings of every ride, and controllers that this vehicle could not have.
std::vector<std::string> remarks_of(const RideStudy& study) {
  std::vector<const SimulatedRun*> runs;
  for (const RiddenVehicle* one : all_of(study)) runs.push_back(&one->road);
  std::vector<std::string> remarks = run_remarks(runs);
  remarks.insert(remarks.end(), study.left_out.begin(), study.left_out.end());
  return remarks;
}

}  // namespace

Document ride_document(const RideStudy& study) {
  const Vehicle& vehicle = *study.passive.road.vehicle;
  Document document{
      .title = "How it rides: " + vehicle.set.plant.title,
      .subtitle = study.ground + ", " + format_number(study.options.road_duration) + " s",
      .verdict = verdict_of(study),
      .sections = {},
      .command = {},
      .version = {},
      .date = {}};

  // The road first, then what is possible there, gains and the step.
  document.sections.push_back({.name = "road",
                               .title = "Comfort against road holding",
                               .paragraphs = {},
                               .tables = {road_table(study)},
                               .figures = {trade_off_figure(study), road_figure(study)},
                               .remarks = remarks_of(study)});
  if (!study.front.empty())
    document.sections.push_back({.name = "possible",
                                 .title = "What is possible",
                                 .paragraphs = {},
                                 .tables = {possible_table(study)},
                                 .figures = {possible_figure(study)},
                                 .remarks = {}});
  document.sections.push_back({.name = "gains",
                               .title = "Over frequency",
                               .paragraphs = {},
                               .tables = {gain_table(study), limit_table(study)},
                               .figures = {gain_figure(study), chirp_figure(study)},
                               .remarks = gain_remarks(study.plant())});
  document.sections.push_back({.name = "step",
                               .title = "A step of the road",
                               .paragraphs = {},
                               .tables = {step_table(study)},
                               .figures = {step_figure(study)},
                               .remarks = {}});
  return document;
}

Value ride_json(const RideStudy& study) {
  const bool bounded = !study.front.empty();
  Value controlled = Value::array(), held = Value::array();
  for (const RiddenVehicle& one : study.controlled) controlled.push_back(ridden_json(one, bounded));
  for (const TradeOff& point : study.held)
    held.push_back(Value::object({{"drive", point.setting},
                                  {"weighted_acceleration", point.weighted},
                                  {"tyre_load", point.tyre}}));
  return Value::object({{"plant", study.passive.road.vehicle->set.name},
                        {"ground", study.ground},
                        {"passive", ridden_json(study.passive, bounded)},
                        {"controlled", std::move(controlled)},
                        {"held", std::move(held)},
                        {"possible", front_json(study.front)},
                        {"units", measure_units_json(study.passive)},
                        {"remarks", Value::array(remarks_of(study))}});
}

}  // namespace dashpot
