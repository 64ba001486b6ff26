#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/sweep_parts.h"
#include "dashpot/report/sweep_report.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// "mix1: weighted acceleration 0.871 of passive's (median; less on 93 % of the vehicles), ..."
std::string against_baseline(const Sweep& sweep, std::size_t c) {
  std::vector<std::string> parts;
  for (const ShownMeasure& shown : main_measures(sweep)) {
    const std::vector<double> ratios = sorted_finite(baseline_ratios(sweep, c, *shown.measure));
    if (ratios.empty()) continue;
    const auto less = std::ranges::lower_bound(ratios, 1.0) - ratios.begin();
    parts.push_back(fmt::format(
        "{} {} (less on {} % of the vehicles)", lower(shown.name),
        number_text(quantile_of(ratios, 0.5).value),
        number_text(100 * static_cast<double>(less) / static_cast<double>(ratios.size()))));
  }
  return sweep.request.controllers[c].name + ": " + join(parts, ", ");
}

/// Reasons not to trust some of a controller's rides.
std::vector<std::string> cautions(const Sweep& sweep, std::size_t c) {
  const std::string& name = sweep.request.controllers[c].name;
  std::vector<std::string> lines;
  if (const std::size_t diverged = diverged_rides(sweep, c))
    lines.push_back(fmt::format("{}: {} of {} rides diverged and do not count.", name, diverged,
                                sweep.rides[c].size()));

  // Dampers beyond their data, and tyres off the ground.
  const double limit = sweep.request.outside_limit;
  const auto outside = std::ranges::count_if(
      sweep.rides[c], [&](const RideMeasures& ride) { return ride.outside_data > limit; });
  if (outside > 0)
    lines.push_back(fmt::format(
        "{}: {} of {} rides ask a damper beyond its data for more than {} % of the time.", name,
        outside, sweep.rides[c].size(), format_number(100 * limit)));
  const auto lifted = std::ranges::count_if(
      sweep.rides[c], [](const RideMeasures& ride) { return ride.contact_lost > 0; });
  if (lifted > 0)
    lines.push_back(fmt::format("{}: a {} loses contact on {} of {} rides.", name, sweep.foot,
                                lifted, sweep.rides[c].size()));
  return lines;
}

std::string verdict_of(const Sweep& sweep) {
  const SweepRequest& request = sweep.request;
  std::string text = fmt::format("{}, {} each.", counted(sweep.vehicles.size(), "vehicle"),
                                 counted(sweep.rides.size(), "controller"));
  if (sweep.rides.size() > 1)
    text += fmt::format(" Median of the ratios to {}, vehicle by vehicle:",
                        request.controllers[request.baseline].name);
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < sweep.rides.size(); ++c)
    if (c != request.baseline) parts.push_back(against_baseline(sweep, c));
  if (!parts.empty()) text += ' ' + join(parts, "; ") + '.';
  for (std::size_t c = 0; c < sweep.rides.size(); ++c)
    for (const std::string& line : cautions(sweep, c)) text += ' ' + line;
  return text;
}

DocumentSection note_section(const Sweep& sweep) {
  const SweepRequest& request = sweep.request;
  DocumentSection section{"how", "How it was done", {}};
  if (!request.note.empty()) section.paragraphs.push_back(request.note);

  // How vehicles were drawn and judged.
  section.paragraphs.push_back(fmt::format(
      "Every controller drives the same vehicles over the same roads, {} s each, of which the "
      "first {} s do not count. {}",
      format_number(request.duration), format_number(request.discard),
      request.drawing == SweepRequest::Drawing::Sobol
          ? "Inputs are drawn by Sobol's sequence, moved by the seed: more even than chance, so "
            "that the intervals, which hold for chance, are wide rather than narrow."
          : "Inputs are drawn by chance."));
  section.paragraphs.push_back(
      "Intervals hold with 95 % for the quantile of all such vehicles, whatever the distribution "
      "(order statistics).");
  return section;
}

}  // namespace

std::string ShownMeasure::title() const { return name + (unit == "1" ? "" : " (" + unit + ")"); }

std::string ShownMeasure::text(double value) const { return number_text(factor * value); }

std::vector<ShownMeasure> shown_measures(const Sweep& sweep) {
  std::vector<ShownMeasure> shown;
  for (const SweepMeasure& measure : judged_measures()) {
    const SweepMeasure& m = as_driven(measure, sweep.drive);
    const bool is_there =
        std::ranges::any_of(sweep.rides, [&](const std::vector<RideMeasures>& rides) {
          return std::ranges::any_of(rides, [&](const RideMeasures& ride) {
            return std::isfinite(ride.*m.field) && ride.*m.field != 0;
          });
        });
    if (!is_there) continue;

    // A seat is no tyre.
    std::string name(m.title);
    if (m.field == &RideMeasures::tyre_load_index && sweep.foot != "tyre") {
      name = sweep.foot + " load index";
      name.front() = static_cast<char>(std::toupper(name.front()));
    }

    // Shares are read in percent, lengths in millimetres.
    const bool is_share = m.field == &RideMeasures::contact_lost ||
                          m.field == &RideMeasures::stops_met ||
                          m.field == &RideMeasures::outside_data;
    if (is_share)
      shown.push_back({&m, std::move(name), "%", 100});
    else if (m.unit == "m")
      shown.push_back({&m, std::move(name), "mm", 1000});
    else
      shown.push_back({&m, std::move(name), std::string(m.unit), 1});
  }
  return shown;
}

std::vector<ShownMeasure> main_measures(const Sweep& sweep) {
  std::vector<ShownMeasure> shown = shown_measures(sweep);
  std::erase_if(shown, [](const ShownMeasure& one) {
    return one.measure->field != &RideMeasures::weighted_acceleration &&
           one.measure->field != &RideMeasures::tyre_load_index;
  });
  return shown;
}

Document sweep_document(const Sweep& sweep) {
  Document document;
  document.title = sweep.request.name;
  document.subtitle =
      fmt::format("{} on {}", sweep.request.controllers.front().words.plant, sweep.request.road);
  document.verdict = verdict_of(sweep);
  if (sweep.rides.size() > 1) document.sections.push_back(ratio_section(sweep));

  // Only what the request varies has a section.
  document.sections.push_back(quantile_section(sweep));
  if (sweep.request.grid_size() > 1) document.sections.push_back(grid_section(sweep));
  if (!sweep.request.inputs.empty()) {
    document.sections.push_back(sensitivity_section(sweep));
    document.sections.push_back(input_section(sweep));
  }
  document.sections.push_back(note_section(sweep));
  return document;
}

}  // namespace dashpot
