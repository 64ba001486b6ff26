#include "dashpot/record/conditions.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string strip_separators(std::string text) {
  constexpr std::string_view kSeparators = " _-.,=";
  const std::size_t first = text.find_first_not_of(kSeparators);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kSeparators) - first + 1);
}

struct Motion {
  double amplitude = 0, frequency = 0;
  bool velocity = false;  ///< amplitude is of the velocity
};

/// Half range, and the rate of upward crossings of the middle with a dead band against noise. A
/// displacement that was integrated is no better known than the velocity, which speaks for itself.
Motion motion_of(const Record& record) {
  const Channel* channel = record.find("displacement");
  if (channel && channel->origin.starts_with("integrated")) channel = nullptr;
  Motion motion;
  motion.velocity = !channel;
  if (!channel) channel = &record.channel("velocity");

  const auto [low, high] = std::minmax_element(channel->samples.begin(), channel->samples.end());
  const double middle = 0.5 * (*low + *high);
  motion.amplitude = 0.5 * (*high - *low);

  // Count crossings upwards of a band of +-20 % of the amplitude about the middle, from first to
  // last.
  bool below = false;
  std::size_t crossings = 0;
  double first = 0, last = 0;
  for (std::size_t k = 0; k < record.size(); ++k) {
    const double x = channel->samples[k] - middle;
    if (x < -0.2 * motion.amplitude) below = true;
    if (!below || x <= 0.2 * motion.amplitude) continue;
    below = false;
    last = record.time[k];
    if (crossings++ == 0) first = last;
  }
  if (crossings > 1) motion.frequency = static_cast<double>(crossings - 1) / (last - first);
  return motion;
}

bool close(double a, double b) {
  return std::abs(a - b) <= 0.05 * std::max(std::abs(a), std::abs(b));
}

std::string describe_motion(const Motion& motion) {
  const std::string text =
      format_number(motion.amplitude * 1e3, 2) + (motion.velocity ? " mm/s" : " mm");
  // One crossing or none leaves the frequency unknown.
  return motion.frequency > 0 ? text + " " + format_number(motion.frequency, 2) + " Hz" : text;
}

bool states_motion(const std::string& name) {
  const std::string text = lower(name);
  return text.find("hz") != std::string::npos || text.find("mm") != std::string::npos;
}

}  // namespace

NameParts split_name(std::string_view stem) {
  for (std::size_t k = 0; k < stem.size(); ++k) {
    if (!is_digit(stem[k]) || (k > 0 && (is_digit(stem[k - 1]) || stem[k - 1] == '.'))) continue;

    // The digits of a number, at most one point between them.
    std::size_t end = k;
    while (end < stem.size() &&
           (is_digit(stem[end]) ||
            (stem[end] == '.' && end + 1 < stem.size() && is_digit(stem[end + 1]))))
      ++end;

    // A drive level is a number followed by A, mA, V or mV as a word of its own.
    const auto value = parse_number(stem.substr(k, end - k));
    const bool milli = end < stem.size() && stem[end] == 'm';
    const std::size_t unit = end + (milli ? 1 : 0);
    const bool is_level =
        value && unit < stem.size() && (stem[unit] == 'A' || stem[unit] == 'V') &&
        (unit + 1 == stem.size() || !(is_letter(stem[unit + 1]) || is_digit(stem[unit + 1])));
    if (!is_level) continue;

    // The name without it, as one word.
    std::string rest = strip_separators(std::string(stem.substr(0, k))),
                tail = strip_separators(std::string(stem.substr(unit + 1)));
    if (!rest.empty() && !tail.empty()) rest += "_";
    return {KnownLevel{milli ? *value / 1000 : *value,
                       parse_drive_unit(stem.substr(unit, 1), "file name"), "file name"},
            rest + tail};
  }
  return {std::nullopt, std::string(stem)};
}

void infer_conditions(std::vector<Record>& records, const std::vector<std::string>& name_rests) {
  std::vector<std::pair<Motion, std::string>> known;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!records[k].condition.empty()) continue;

    // The name may state the motion itself.
    if (states_motion(name_rests[k])) {
      records[k].condition = name_rests[k];
      continue;
    }

    // Else records that move alike share the words of the first.
    const Motion motion = motion_of(records[k]);
    const auto same = std::find_if(known.begin(), known.end(), [&](const auto& other) {
      return other.first.velocity == motion.velocity &&
             close(other.first.amplitude, motion.amplitude) &&
             close(other.first.frequency, motion.frequency);
    });
    records[k].condition = same == known.end() ? describe_motion(motion) : same->second;
    if (same == known.end()) known.emplace_back(motion, records[k].condition);
  }
}

}  // namespace dashpot
