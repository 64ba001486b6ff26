#include "speeds.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"

namespace dashpot::cli {

Option speeds_option(std::string& speeds) {
  return {.names = "--speeds",
          .target = &speeds,
          .help = "speeds at which forces are stated, between those measured",
          .value = "MM/S,...",
          .default_text = "those that were measured"};
}

std::vector<double> parse_speeds(const std::string& text, const PrintUnits& units) {
  const PrintUnit unit = units.of("m/s");
  std::vector<double> speeds;
  if (text.empty()) return speeds;
  for (const std::string& word : split(text, ',')) {
    const std::optional<double> speed = parse_number(trim(word));
    if (!speed || !std::isfinite(*speed) || *speed <= 0)
      throw UsageError(
          "--speeds", "'" + word + "' is not a speed",
          "positive numbers in " + unit.name + " with commas between them: 50,100,200");
    speeds.push_back(*speed / unit.factor);
  }
  std::ranges::sort(speeds);
  return speeds;
}

}  // namespace dashpot::cli
