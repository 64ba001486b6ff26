#include "dashpot/output/ride_parts.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/output/series.h"

namespace dashpot {

std::string controller_colour(std::size_t k) { return "series-" + std::to_string(k % 5 + 1); }

FigureSeries over_time(const SimulatedRun& run, const std::string& channel, double factor,
                       const FigureSeries& look) {
  constexpr std::size_t kPoints = 3000;
  FigureSeries series = look;
  const std::vector<double>& samples = run.trace.record.channel(channel).samples;
  for (const std::size_t k : thinned_indices({samples}, kPoints)) {
    series.x.push_back(run.trace.record.time[k]);
    series.y.push_back(factor * samples[k]);
  }
  return series;
}

std::string ratio_text(double value, double reference) {
  const double ratio = value / reference;
  if (!std::isfinite(ratio)) return "-";
  return format_number(std::round(1000 * ratio) / 1000, 4);
}

std::vector<std::string> run_remarks(const std::vector<const SimulatedRun*>& runs) {
  std::vector<std::string> remarks;
  const auto add = [&](const std::string& remark) {
    if (std::ranges::find(remarks, remark) == remarks.end()) remarks.push_back(remark);
  };
  for (const SimulatedRun* run : runs)
    for (const std::string& warning : run->warnings) add(run->name + ": " + warning);
  for (const SimulatedRun* run : runs)
    for (const std::string& note : run->vehicle->notes) add(note);
  return remarks;
}

}  // namespace dashpot
