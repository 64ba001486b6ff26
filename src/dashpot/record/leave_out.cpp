#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "dashpot/base/text.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

struct Way {
  LeaveOut::By by;
  std::string_view name;
};
constexpr Way kWays[] = {
    {LeaveOut::By::Condition, "condition"}, {LeaveOut::By::Current, "current"},
    {LeaveOut::By::Record, "record"},       {LeaveOut::By::Fraction, "fraction"},
    {LeaveOut::By::Blocks, "blocks"},       {LeaveOut::By::Groups, "groups"},
    {LeaveOut::By::Roles, "roles"},         {LeaveOut::By::Each, "each"}};

}  // namespace

LeaveOut parse_leave_out(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = lower(trim(std::string_view(text).substr(0, equals)));
  const auto way = std::find_if(std::begin(kWays), std::end(kWays),
                                [&](const Way& w) { return w.name == name; });
  if (way == std::end(kWays))
    throw Error("", "cannot leave out by '" + text + "'",
                "'condition', 'current', 'current=0.5,1', 'record', 'groups=6', 'blocks=5', "
                "'fraction=0.3', 'roles' or 'each=gap,pole_length'");

  LeaveOut out;
  out.by = way->by;
  if (equals == std::string::npos && out.by == LeaveOut::By::Each)
    throw Error("", "'each' does not say of what",
                "conditions of the records: 'each=gap,pole_length'");
  if (equals == std::string::npos) return out;

  const std::string rest = text.substr(equals + 1);

  // The value: a number for a fraction, blocks and groups, a list of names or levels for all
  // others.
  if (out.by == LeaveOut::By::Fraction) {
    out.fraction = parse_number(rest).value_or(0);
    if (!(out.fraction > 0 && out.fraction < 1))
      throw Error("", "fraction '" + rest + "' cannot be left out",
                  "a number between 0 and 1: 'fraction=0.3'");
    return out;
  }
  if (out.by == LeaveOut::By::Blocks || out.by == LeaveOut::By::Groups) {
    constexpr double kMost = 1000;
    const double parts = parse_number(rest).value_or(0);
    if (!(parts >= 2 && parts <= kMost && parts == std::floor(parts)))
      throw Error("", "'" + rest + "' " + name + " cannot be left out in turn",
                  "a whole number from 2 to 1000: '" + format_leave_out(out) + "'");
    (out.by == LeaveOut::By::Blocks ? out.blocks : out.groups) = static_cast<std::size_t>(parts);
    return out;
  }
  if (out.by == LeaveOut::By::Roles)
    throw Error("", "'roles' takes no values", "the dataset file states them");
  for (const std::string& value : split(rest, ',')) {
    if (trim(value).empty())
      throw Error("", "an empty value in '" + text + "'", "as 'current=0.5,1'");
    out.values.emplace_back(trim(value));
  }
  return out;
}

std::string format_leave_out(const LeaveOut& leave_out) {
  const auto way = std::find_if(std::begin(kWays), std::end(kWays),
                                [&](const Way& w) { return w.by == leave_out.by; });
  std::string text(way->name);
  if (leave_out.by == LeaveOut::By::Fraction) return text + "=" + format_exact(leave_out.fraction);
  if (leave_out.by == LeaveOut::By::Blocks) return text + "=" + std::to_string(leave_out.blocks);
  if (leave_out.by == LeaveOut::By::Groups) return text + "=" + std::to_string(leave_out.groups);
  return leave_out.values.empty() ? text : text + "=" + join(leave_out.values, ",");
}

}  // namespace dashpot
