#include "in_plant_document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "console.h"
#include "dashpot/base/date.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/report/quantity.h"
#include "document_text.h"
#include "plant_advice_section.h"
#include "sensor_figure.h"
#include "stated_plant_section.h"

namespace dashpot::cli {
namespace {

/// Parameters are told in the SI units in which files and options state them, what belongs to a
/// sensor in those in which people see it.
enum class Shown { AsStated, AsSeen };

DocumentTable parameter_table(const std::string& title,
                              const std::vector<FittedParameter>& parameters,
                              Shown shown = Shown::AsStated) {
  DocumentTable table{.title = title,
                      .columns = {{"parameter"},
                                  {"value", true},
                                  {"95 % interval", true},
                                  {"unit"},
                                  {"remark", false, 1}},
                      .rows = {}};
  for (const FittedParameter& p : parameters) {
    std::string remark = p.meaning;
    if (p.at_bound) remark = "at a bound of its range";
    if (p.weak) remark = "cannot be told from these sensors";

    const auto text = [&](double value) {
      return shown == Shown::AsSeen ? quantity(value, p.unit, 5) : format_number(value, 5);
    };
    std::string interval = text(p.low) + " ... " + text(p.high);
    if (!has_interval(p)) interval = "none";
    if (p.fixed) interval = "fixed";
    table.rows.push_back({p.name, text(p.value), interval,
                          shown == Shown::AsSeen ? unit_name(p.unit) : p.unit, remark});
  }
  return table;
}

DocumentTable sensor_table(const InPlantReport& report) {
  DocumentTable table{.title = report.road_measured ? "Sensors, in free run of the whole plant"
                                                    : "Sensors, one sample ahead",
                      .columns = {{"recording"},
                                  {"sensor"},
                                  {"unit"},
                                  {"rms of signal", true},
                                  {"error, fitted", true},
                                  {"error, held back", true},
                                  {"held back %", true},
                                  {"offset", true, 1}},
                      .rows = {}};

  for (const SensorFigures& s : report.sensors)
    table.rows.push_back({s.recording, s.channel, unit_name(s.unit), quantity(s.rms, s.unit, 4),
                          quantity(s.training, s.unit, 4), quantity(s.held_back, s.unit, 4),
                          format_number(100 * s.held_back / s.rms, 3),
                          quantity(s.offset, s.unit, 2)});

  table.note =
      report.road_measured
          ? "Errors are rms, after the sensor's offset in the part that was fitted; the time held "
            "back was seen by no fit, and the plant runs free from the first sample on."
          : "Errors are rms, of what a filter of plant and damper expects one sample ahead: "
            "nothing can run free on a road that is not known. The time held back was seen by no "
            "fit.";
  return table;
}

/// The noise of what states none: what was found, and what could not be told.
std::vector<std::string> noise_lines_of(const InPlantReport& report) {
  std::vector<std::string> told, untold, lines;
  for (const FoundNoise& one : report.noise)
    if (one.deviation > 0)
      told.push_back(one.channel + " " + quantity(one.deviation, one.unit) + " " +
                     unit_name(one.unit));
    else
      untold.push_back(one.channel);
  if (!told.empty())
    lines.push_back(
        "Noise that was not stated was found, and stands in the files for 'observe', "
        "'watch' and 'export --in': " +
        join(told, ", ") + '.');
  if (!untold.empty())
    lines.push_back("The noise of " + join(untold, ", ") +
                    " cannot be told from the model's error: state it for 'observe'.");
  return lines;
}

/// What can be told, and what the fit rests on, in words.
std::vector<std::string> knowable_lines(const InPlantReport& report) {
  std::vector<std::string> lines = noise_lines_of(report);
  const Knowable& known = report.knowable;

  // What these sensors tell of the unknowns.
  if (!known.singular_values.empty())
    lines.push_back(fmt::format(
        "Before the fit: {} unknowns, singular values of their sensitivities from {} to {}.",
        known.singular_values.size(), format_number(known.singular_values.front(), 3),
        format_number(known.singular_values.back(), 3)));
  if (!known.without_effect.empty())
    lines.push_back("No sensor shows an effect of " + join(known.without_effect, ", ") + '.');
  for (const auto& group : known.confounded)
    lines.push_back("These can be traded against each other: " + join(group, ", ") + '.');
  if (!report.road_measured) {
    lines.push_back(
        "Nothing measures the road: all unknowns are those under which the sensors are most "
        "likely, along the damper's motion that they tell.");
    return lines;
  }

  if (!report.along.empty())
    lines.push_back(fmt::format(
        "The model learnt from the damper's motion and force that the sensors tell along {}, whose "
        "intervals say what they tell of the plant.",
        report.along));

  // How it was integrated, and how well.
  lines.push_back(fmt::format(
      "Integrated {}, {} steps per sample; half the step changes the worst sensor by {} % of its "
      "error.",
      report.method == PlantMethod::RungeKutta
          ? "by the classical Runge-Kutta method"
          : "exactly for the plant, under a force that goes straight over a step",
      report.steps, format_number(100 * report.step_error, 2)));
  return lines;
}

/// The sensors of the first recording; where nothing measures the road what was observed.
DocumentFigure first_recording(const InPlantReport& report) {
  if (report.road_measured) return sensor_figure(report.traces.front(), report.sensors);
  DocumentFigure figure = sensor_figure(report.traces.front(), report.sensors, "observed");
  figure.title = "Damper";
  figure.caption = "The damper as it was observed, at the end of what was fitted of a recording.";
  return figure;
}

std::string remark_of(const InPlantFit& fit) {
  if (fit.report.status != FitReport::Status::Converged) return fit.report.message;
  if (!fit.was_asked_for) return "not asked for: the others learnt along it";
  if (!fit.report.lacks.empty()) return "lacks a " + fit.report.lacks;
  return fit.report.along.empty() ? "" : "learnt along " + fit.report.along;
}

DocumentTable models_in_free_run(const std::vector<InPlantFit>& fits) {
  DocumentTable table{.title = "Models, by the worst sensor on the time held back",
                      .columns = {{"model"}, {"error %", true}, {"CPU s", true}, {"remark"}},
                      .rows = {}};
  for (const InPlantFit& fit : fits)
    table.rows.push_back({fit.model, format_number(worst_of(fit), 3),
                          format_number(fit.report.seconds, 3), remark_of(fit)});
  return table;
}

/// Where nothing measures the road.
DocumentTable models_by_force_error(const std::vector<InPlantFit>& fits) {
  const bool lacks =
      std::ranges::any_of(fits, [](const InPlantFit& fit) { return !fit.report.lacks.empty(); });
  DocumentTable table{.title = std::string("Models, ") +
                               (lacks ? "first those without a known lack, " : "") +
                               "by what they leave of the damper's force",
                      .columns = {{"model"},
                                  {"force error N", true},
                                  {"worst sensor %", true},
                                  {"CPU s", true},
                                  {"remark"}},
                      .rows = {}};

  for (const InPlantFit& fit : fits)
    table.rows.push_back({fit.model, format_number(fit.report.force_error, 3),
                          format_number(worst_of(fit), 3), format_number(fit.report.seconds, 3),
                          remark_of(fit)});

  table.note =
      "Force error: rms of what the law leaves of the force, as the sensors tell it. Worst sensor: "
      "error one sample ahead on the time held back, over its rms, which says little of the law.";
  return table;
}

std::string verdict_of(const InPlantFit& best, const InPlantSetup& setup) {
  const InPlantReport& report = best.report;
  if (!report.has_models()) return "Nothing could be fitted: " + report.message;
  const std::string where = best.model + " in the " + std::string(setup.model->name) + ": ";
  if (!report.road_measured)
    return where + "it leaves " + format_number(report.force_error, 3) +
           " N of the damper's force (rms), as the sensors tell it; nothing measures the road.";
  return where + format_number(worst_of(best), 3) +
         " % of the worst sensor's rms is left on the time held back, in free run.";
}

/// What was found of plant and damper; `beside`: along which law, where another model is shown.
void add_numbers(const InPlantReport& report, const std::string& beside, DocumentSection& section) {
  if (!report.plant.empty())
    section.tables.push_back(parameter_table("Plant" + beside, report.plant));
  if (!report.plant_beside_any_force.empty()) {
    section.tables.push_back(
        parameter_table("Plant, whatever the dampers' forces are", report.plant_beside_any_force));
    section.tables.back().note =
        "From what the sensors show that no force of a damper could make: the law has no part in "
        "these numbers.";
  }
  if (!report.damper.empty())
    section.tables.push_back(parameter_table("Damper" + beside, report.damper));
}

}  // namespace

double worst_of(const InPlantFit& fit) {
  double share = 0;
  for (const SensorFigures& s : fit.report.sensors)
    share = std::max(share, 100 * (std::isnan(s.held_back) ? s.training : s.held_back) / s.rms);
  return fit.report.has_models() && std::isfinite(share) ? share : static_cast<double>(INFINITY);
}

Document in_plant_document(const std::vector<InPlantFit>& fits, std::span<const InPlantFit> doubted,
                           const std::string& left_out, const InPlantSetup& setup,
                           const Console& console) {
  const InPlantFit& best = fits.front();
  const auto law = std::ranges::find(fits, best.report.along, &InPlantFit::model);
  Document document{.title = "A damper identified in its plant",
                    .subtitle = std::string(setup.model->title),
                    .verdict = {},
                    .sections = {},
                    .command = console.command_line(),
                    .version = DASHPOT_VERSION,
                    .date = date_now(),
                    .kind = "identification"};
  document.verdict = verdict_of(best, setup);

  std::vector<std::string> doubts;
  for (const InPlantFit& fit : doubted)
    for (const std::string& warning : fit.report.warnings)
      doubts.push_back(fit.model + ": " + warning);
  add_doubts(std::move(doubts), document);

  if (fits.size() > 1)
    document.sections.push_back(
        {.name = "models",
         .title = "Models",
         .paragraphs = {},
         .tables = {best.report.road_measured ? models_in_free_run(fits)
                                              : models_by_force_error(fits)}});

  // The best of them in full.
  if (best.report.has_models()) {
    DocumentSection section{.name = "fit", .title = best.model, .paragraphs = {}};
    section.tables = {sensor_table(best.report)};
    const bool is_plant_of_law =
        law != fits.end() && std::ranges::equal(best.report.plant, law->report.plant, {},
                                                &FittedParameter::value, &FittedParameter::value);
    if (!is_plant_of_law) add_numbers(best.report, "", section);
    if (law != fits.end()) add_numbers(law->report, ", along " + law->model, section);
    if (!best.report.nuisances.empty())
      section.tables.push_back(parameter_table("Nuisances", best.report.nuisances, Shown::AsSeen));
    if (best.report.road_measured && !best.report.nuisances.empty())
      section.tables.back().audience = Audience::Files;
    add_advice(law != fits.end() ? law->report.advice : best.report.advice, section);
    section.figures.insert(section.figures.begin(), first_recording(best.report));
    section.remarks = knowable_lines(best.report);
    if (!left_out.empty()) section.remarks.push_back(left_out);
    document.sections.push_back(std::move(section));
  }

  // The plant as it was stated; and all of it for programs.
  document.sections.push_back(stated_plant_section(setup));
  Value list = Value::array();
  for (const InPlantFit& fit : fits) list.push_back(to_json(fit.report, fit.model));
  document.data = Value::object({{"plant", setup.model->name}, {"fits", std::move(list)}});
  return document;
}

}  // namespace dashpot::cli
