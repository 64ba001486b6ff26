#include "dashpot/report/ride_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/report/series.h"
#include "dashpot/report/words.h"

namespace dashpot {

FigureSeries controller_look(const std::string& name, std::size_t k) {
  constexpr std::array kColours{"series-1", "series-2", "series-3", "series-4",
                                "series-5", "series-7", "series-8"};
  const auto mark =
      k / kColours.size() % 2 == 0 ? FigureSeries::Mark::Line : FigureSeries::Mark::Dashes;
  return {name, kColours[k % kColours.size()], {}, {}, mark, 1.4};
}

FigureSeries passive_look(const std::string& name) {
  return {name, "series-6", {}, {}, FigureSeries::Mark::Line, 1.8};
}

Stretch shown_stretch(double duration, double discard) {
  constexpr double kShown = 5;
  return discard > 0 ? Stretch{discard, std::min(duration, discard + kShown)}
                     : Stretch{0, duration};
}

FigureSeries over_time(const std::vector<double>& time, const std::vector<double>& samples,
                       const Stretch& stretch, const FigureSeries& look) {
  constexpr std::size_t kPoints = 3000;
  FigureSeries series = look;
  const auto place = [&](double t) {
    return static_cast<std::size_t>(std::ranges::lower_bound(time, t - 1e-9) - time.begin());
  };
  const std::size_t first = place(stretch.from), last = place(stretch.to);
  if (first >= last) return series;  // it diverged before

  // Thinned, so that least and greatest values stay.
  const std::span<const double> shown = std::span(samples).subspan(first, last - first);
  for (const std::size_t k : thinned_indices({shown}, kPoints)) {
    series.x.push_back(time[first + k]);
    series.y.push_back(shown[k]);
  }
  return series;
}

FigurePanel channel_panel(const std::vector<DrawnRun>& runs, const std::string& channel,
                          const std::string& title, const std::string& si_unit,
                          const Stretch& stretch) {
  FigurePanel panel{
      .title = title, .x_label = "time, s", .y_label = {}, .series = {}, .y_unit = si_unit};
  for (const auto& [run, look] : runs)
    if (const Channel* found = run->trace.record.find(channel))
      panel.series.push_back(over_time(run->trace.record.time, found->samples, stretch, look));
  return panel;
}

std::vector<FigurePanel> tyre_and_strut_panels(const std::vector<DrawnRun>& runs,
                                               const Plant& plant, const Stretch& stretch) {
  std::vector<FigurePanel> panels;
  const auto add = [&](const std::string& part, const char* ending, const char* what,
                       const char* si_unit) {
    panels.push_back(channel_panel(runs, part + ending, part + what, si_unit, stretch));
  };

  // Alike things stand side by side: front and rear, left and right.
  for (const Tyre& tyre : plant.tyres) add(tyre.name, "_load", ", load", "N");
  for (const Strut& strut : plant.struts) add(strut.name, "_deflection", ", deflection", "m");
  for (const Strut& strut : plant.struts) add(strut.name, "_force", ", damper force", "N");
  return panels;
}

std::string ratio_text(double value, double reference) {
  const double ratio = value / reference;
  if (!std::isfinite(ratio)) return "-";
  return format_number(std::round(1000 * ratio) / 1000, 4);
}

std::string against_text(double value, double reference) {
  const double percent = 100 * (value / reference - 1);
  return percent_text(std::abs(percent)) + " % " + (percent < 0 ? "less" : "more");
}

namespace {

/// A warning after the name of its run. Where that begins with the damper of which the warning
/// speaks, the damper is not named again.
std::string warning_of(const SimulatedRun& run, const std::string& warning) {
  for (const std::string& damper : run.vehicle->damper_names)
    if (run.name.starts_with(damper) && warning.starts_with(damper + ": "))
      return run.name + warning.substr(damper.size());
  return run.name + ": " + warning;
}

}  // namespace

std::vector<std::string> run_remarks(const std::vector<const SimulatedRun*>& runs) {
  std::vector<std::string> remarks;
  const auto add = [&](const std::string& remark) {
    if (std::ranges::find(remarks, remark) == remarks.end()) remarks.push_back(remark);
  };
  for (const SimulatedRun* run : runs)
    for (const std::string& warning : run->warnings) add(warning_of(*run, warning));
  for (const SimulatedRun* run : runs)
    for (const std::vector<std::string>& notes : {run->notes, run->vehicle->notes})
      for (const std::string& note : notes) add(note);
  return remarks;
}

}  // namespace dashpot
