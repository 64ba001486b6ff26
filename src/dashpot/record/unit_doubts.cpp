#include "dashpot/record/unit_doubts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"

namespace dashpot {
namespace {

/// What MR dampers on benches and in machines stay within, generously, and the units that people
/// record it in, the commonest first.
struct UsualSize {
  std::string_view channel;
  double least, most;  ///< SI
  bool is_span;        ///< from the lowest to the highest sample, else the largest by its size
  std::string_view units;
};
constexpr std::array kUsualSizes{UsualSize{"displacement", 1e-4, 2, true, "mm m cm um in"},
                                 UsualSize{"velocity", 0, 30, false, "mm/s m/s cm/s in/s"},
                                 UsualSize{"force", 2, 1e6, true, "N kN mN"},
                                 UsualSize{"current", 0, 50, false, "A mA uA"},
                                 UsualSize{"voltage", 0, 400, false, "V mV uV"},
                                 UsualSize{"temperature", 200, 500, false, "degC K degF"}};

/// Where a channel stands in its file.
struct ReadFrom {
  std::string column;  ///< "" where it comes from no column
  std::string unit;    ///< as read
};

/// As its origin tells: "column x_mm, mm -> m, sign flipped".
ReadFrom read_from(const Channel& channel) {
  constexpr std::string_view kColumn = "column ", kFlipped = ", sign flipped";
  std::string_view origin = channel.origin;
  if (!origin.starts_with(kColumn)) return {"", channel.unit};
  origin.remove_prefix(kColumn.size());
  while (origin.ends_with(kFlipped)) origin.remove_suffix(kFlipped.size());

  // The conversion, if any.
  const std::string arrow = " -> " + channel.unit;
  const std::size_t comma = origin.rfind(", ");
  if (!origin.ends_with(arrow) || comma == std::string_view::npos)
    return {std::string(origin), channel.unit};
  origin.remove_suffix(arrow.size());
  return {std::string(origin.substr(0, comma)), std::string(origin.substr(comma + 2))};
}

/// "in mA it would be 0.5 A ..." for the first unit in which the size would be a usual one, and
/// what to write where that is right.
std::string likelier_unit(const UsualSize& usual, const Channel& channel, double size) {
  const ReadFrom from = read_from(channel);
  const Unit read = parse_unit(from.unit).value_or(Unit{});
  const double raw = (size - (usual.is_span ? 0 : read.offset)) / read.factor;
  for (const std::string& text : split(std::string(usual.units), ' ')) {
    const Unit unit = parse_unit(text).value_or(Unit{});
    const double other = unit.factor * raw + (usual.is_span ? 0 : unit.offset);
    const bool is_usual = std::abs(other) >= usual.least && std::abs(other) <= usual.most;
    if (text == from.unit || !is_usual) continue;

    const std::string would =
        "in " + text + " it would be " + format_number(other) + " " + channel.unit;
    if (from.column.empty()) return would;
    return would +
           ": if so, write that unit into the header, or state it in a dataset file with the other "
           "channels, 'channels: {" +
           channel.name + ": {column: " + yaml_string(from.column) + ", unit: " + text + "}, ...}'";
  }
  return "the column may be another one";
}

/// A size that no MR damper has.
std::optional<std::string> unusual_size(const UsualSize& usual, const Channel& channel) {
  const auto [low, high] = std::ranges::minmax(channel.samples);
  const double farthest = std::abs(low) > std::abs(high) ? low : high;
  const double size = usual.is_span ? high - low : farthest;
  const bool is_small = std::abs(size)<usual.least, is_large = std::abs(size)> usual.most;
  if ((!is_small && !is_large) || (usual.is_span && size == 0)) return std::nullopt;

  const ReadFrom from = read_from(channel);
  const std::string where = !from.column.empty()     ? " (column '" + from.column + "')"
                            : channel.origin.empty() ? ""
                                                     : " (" + channel.origin + ")";
  return "the " + channel.name + where + (usual.is_span ? " spans " : " reaches ") +
         format_number(size) + " " + channel.unit + ": is its unit " + from.unit + " right? " +
         (is_small ? "Hardly any" : "No") + " MR damper does so; " +
         likelier_unit(usual, channel, size);
}

/// Steps of time that are too long for the motion of a damper.
std::optional<std::string> unusual_step(const Record& record) {
  const double step =
      (record.time.back() - record.time.front()) / static_cast<double>(record.size() - 1);
  if (step < kLongestBetweenSamples) return std::nullopt;
  const std::string unit(likelier_time_unit(step));
  return "the samples are " + format_number(step) + " s apart: is the unit of time right? In " +
         unit + " it would be " + format_number(parse_unit(unit).value_or(Unit{}).factor * step) +
         " s: if so, write that unit into the header, or state it in a dataset file, 'time: "
         "{column: NAME, unit: " +
         unit + "}'";
}

/// A speed that the way has no room for: from rest to v and back to rest within a stroke s takes
/// v^2 / s at least.
std::optional<std::string> unusual_acceleration(const Record& record) {
  constexpr double kMost = 1e4;    // m/s^2, some 1000 g
  constexpr double kOften = 0.99;  // of the samples are slower: spikes do not count
  const Channel* const displacement = record.find("displacement");
  const Channel* const velocity = record.find("velocity");
  if (!displacement || !velocity) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(displacement->samples);
  const double stroke = high - low;

  std::vector<double> speed = velocity->samples;
  for (double& v : speed) v = std::abs(v);
  const auto top =
      speed.begin() + static_cast<std::ptrdiff_t>(kOften * static_cast<double>(speed.size() - 1));
  std::ranges::nth_element(speed, top);
  if (*top * *top <= kMost * stroke || stroke == 0) return std::nullopt;
  return "it reaches " + format_number(*top, 3) + " m/s within a stroke of " +
         format_number(1e3 * stroke, 3) + " mm, which takes more than " +
         format_number(*top * *top / stroke, 2) +
         " m/s^2: the unit of time or that of the motion may be wrong";
}

}  // namespace

std::vector<std::string> doubts_about_units(const Record& record) {
  std::vector<std::string> doubts;
  const auto add = [&](const std::optional<std::string>& doubt) {
    if (doubt) doubts.push_back(*doubt);
  };
  if (record.size() < 2) return doubts;
  for (const UsualSize& usual : kUsualSizes) {
    // What is derived from a motion is as wrong as that.
    const Channel* channel = record.find(usual.channel);
    const bool is_derived = channel && (channel->origin.starts_with("derived") ||
                                        channel->origin.starts_with("integrated"));
    if (channel && !is_derived) add(unusual_size(usual, *channel));
  }
  add(unusual_step(record));
  if (doubts.empty()) add(unusual_acceleration(record));
  return doubts;
}

std::optional<Suspect> doubt_about_currents(std::span<const Record> records) {
  constexpr UsualSize kDriving{"current", 3e-3, 50, false, "A"};
  const Record* strongest = nullptr;
  double largest = 0, highest = 0;
  std::set<double> levels;
  for (const Record& record : records) {
    const Channel* current = record.find("current");
    if (!current) continue;
    levels.insert(record.drive_level.value_or(0));
    const auto [low, high] = std::ranges::minmax(current->samples);
    const double here = std::max(std::abs(low), std::abs(high));
    highest = std::max(highest, high);
    if (here > largest) largest = here, strongest = &record;
  }

  // A coil asks for no direction, and what drives a model later is positive.
  constexpr double kNoise = 0.02, kFlows = 0.05;  // of the largest; A
  if (strongest && largest > kFlows && highest <= kNoise * largest)
    return Suspect{strongest->name,
                   "its current is negative, as that of all records: " + format_number(-largest) +
                       " A; a force does not ask which way it flows, but a model of these "
                       "recordings knows nothing of positive ones: 'sign: -1' for current in a "
                       "dataset file turns it round"};
  if (!strongest || levels.size() < 2 || largest >= kDriving.least) return std::nullopt;

  const Channel& current = strongest->channel("current");
  const ReadFrom from = read_from(current);
  if (from.unit == current.unit) return std::nullopt;
  return Suspect{strongest->name,
                 "its current, the largest of all records, reaches " + format_number(largest) +
                     " A (column '" + from.column + "'): is its unit " + from.unit +
                     " right? MR dampers take more; " + likelier_unit(kDriving, current, largest)};
}

std::string_view likelier_time_unit(double step) {
  for (const std::string_view unit : {"ms", "us"})
    if (step *= 1e-3; step < kLongestBetweenSamples) return unit;
  return "ns";
}

}  // namespace dashpot
