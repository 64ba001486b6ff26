#include "dashpot/record.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr StandardChannel kStandard[] = {
    {"displacement", "m"}, {"velocity", "m/s"}, {"acceleration", "m/s^2"}, {"force", "N"},
    {"current", "A"},      {"voltage", "V"},    {"temperature", "K"},
};

}  // namespace

std::span<const StandardChannel> standard_channels() { return kStandard; }

const Channel* Record::find(std::string_view wanted) const {
  const auto at = std::find_if(channels.begin(), channels.end(),
                               [&](const Channel& c) { return c.name == wanted; });
  return at == channels.end() ? nullptr : &*at;
}

Channel* Record::find(std::string_view wanted) {
  return const_cast<Channel*>(std::as_const(*this).find(wanted));
}

const Channel& Record::channel(std::string_view wanted) const {
  if (const Channel* found = find(wanted)) return *found;
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  throw Error(name, "has no channel '" + std::string(wanted) + "'", "it has " + join(names, ", "));
}

void Record::keep(std::size_t first, std::size_t last) {
  last = std::min(last, size());
  first = std::min(first, last);
  const auto shorten = [&](std::vector<double>& all) {
    all.resize(last);
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first));
  };
  shorten(time);
  for (Channel& channel : channels) shorten(channel.samples);
  warm_up = warm_up > first ? std::min(warm_up - first, last - first) : 0;
}

Record Record::slice(std::size_t first, std::size_t last) const {
  last = std::min(last, size());
  first = std::min(first, last);
  const auto part = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(first),
                               all.begin() + static_cast<std::ptrdiff_t>(last));
  };

  // Everything but the samples is the same; what remains of the warm-up shrinks with the start.
  Record out;
  out.name = name;
  out.source = source;
  out.condition = condition;
  out.drive_level = drive_level;
  out.conditions = conditions;
  out.moving_mass = moving_mass;
  out.time = part(time);
  out.sample_time = sample_time;
  for (const Channel& channel : channels)
    out.channels.push_back({channel.name, channel.unit, part(channel.samples), channel.origin});
  out.warm_up = warm_up > first ? std::min(warm_up - first, last - first) : 0;
  out.role = role;
  out.notes = notes;
  return out;
}

}  // namespace dashpot
