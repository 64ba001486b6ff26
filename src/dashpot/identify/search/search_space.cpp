#include "dashpot/identify/search/search_space.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_design.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostDesigns = 100'000;
constexpr int kDrawnDigits = 3;  // of what is drawn: more would only make tables wide

/// A setting's name and its text.
using Setting = std::pair<std::string, std::string>;

/// The design with what is fixed and what is given. What its trainer has no use for is left out: it
/// would only make several trials of one.
NetworkDesign compose(const NetworkDesign& fixed, std::vector<Setting> given) {
  for (const NetworkSetting& setting : network_settings())
    if (const std::string value = setting.format(fixed); !value.empty())
      given.emplace_back(setting.name, value);
  NetworkDesign all, used;
  for (const auto& [name, value] : given) find_network_setting(name, name).parse(value, name, all);
  const Trainer trainer = all.trainer.value_or(Trainer::LevenbergMarquardt);
  for (const auto& [name, value] : given)
    if (has_use(trainer, name)) find_network_setting(name, name).parse(value, name, used);
  return used;
}

void set(NetworkDesign& design, const SearchAxis& axis, const std::string& value,
         const std::string& where) {
  find_network_setting(axis.setting, where).parse(value, where, design);
}

bool takes(const SearchAxis& axis, const std::string& value) {
  try {
    NetworkDesign design;
    set(design, axis, value, axis.setting);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// The trainers that the designs of a space have.
std::vector<Trainer> trainers_of(const SearchSpace& space) {
  std::vector<Trainer> trainers;
  for (const SearchAxis& axis : space.axes)
    for (const std::string& value : axis.values)
      if (axis.setting == "trainer")
        trainers.push_back(
            compose({}, {{"trainer", value}}).trainer.value_or(Trainer::LevenbergMarquardt));
  if (trainers.empty())
    trainers.push_back(space.fixed.trainer.value_or(Trainer::LevenbergMarquardt));
  return trainers;
}

/// As the setting's table writes it, so that one value is one text.
std::string canonical(const SearchAxis& axis, const std::string& value, const std::string& where) {
  NetworkDesign design;
  set(design, axis, value, where);
  return find_network_setting(axis.setting, where).format(design);
}

void read_range(SearchAxis& axis, const std::string& text, const std::string& where) {
  const std::vector<std::string> ends = split(text, ':');
  const std::optional<double> low = parse_number(trim(ends.front())),
                              high = parse_number(trim(ends.back()));
  if (ends.size() != 2 || !low || !high || !(*low < *high) || !std::isfinite(*high))
    throw Error(where, "'" + text + "' is not a range",
                "write the least and the greatest value, as 1e-5:1e-2");
  for (const std::string& end : ends) canonical(axis, std::string(trim(end)), where);
  axis.low = *low;
  axis.high = *high;
  axis.whole = !takes(axis, "1.5");
  if (axis.low == 0 && !axis.whole)
    throw Error(where, "a range from 0 has no logarithm, in which its values are spaced",
                "begin it above 0, as 1e-6:" + format_number(axis.high) + ", or list values");
}

void read_list(SearchAxis& axis, const std::string& text, const std::string& where) {
  for (const std::string& part : split(text, ',')) {
    const std::string value = canonical(axis, std::string(trim(part)), where);
    if (std::ranges::count(axis.values, value) > 0)
      throw Error(where, "'" + value + "' comes twice", "name each value once");
    axis.values.push_back(value);
  }
}

/// The value at `place` of 0 ... 1 of a range.
double at(const SearchAxis& axis, double place) {
  if (axis.low == 0) return place * axis.high;
  return axis.low * std::pow(axis.high / axis.low, place);
}

std::string text_of(const SearchAxis& axis, double value) {
  value = std::clamp(axis.whole ? std::round(value) : value, axis.low, axis.high);
  return axis.whole ? format_exact(value) : format_number(value, kDrawnDigits);
}

std::vector<std::string> grid_values(const SearchAxis& axis, std::size_t steps) {
  if (!axis.values.empty()) return axis.values;
  std::vector<std::string> values;
  for (std::size_t k = 0; k < steps; ++k) {
    const double place = steps == 1 ? 0.5 : static_cast<double>(k) / static_cast<double>(steps - 1);
    const std::string value = text_of(axis, at(axis, place));
    if (values.empty() || values.back() != value) values.push_back(value);
  }
  return values;
}

std::string drawn_value(const SearchAxis& axis, Random& random) {
  if (!axis.values.empty()) return axis.values[random.index(axis.values.size())];
  const double place = random.uniform();
  if (!axis.whole) return text_of(axis, at(axis, place));
  // Each whole number stands for the range up to the next, so that both ends get their share.
  SearchAxis ranges = axis;
  ranges.high += 1;
  return text_of(axis, std::floor(at(ranges, place)));
}

}  // namespace

SearchAxis parse_search_axis(std::string_view text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    throw Error(option, "'" + std::string(text) + "' has no values",
                "as hidden=5,10,10-10 or l2=1e-5:1e-2");
  SearchAxis axis{.setting = std::string(trim(text.substr(0, equals)))};
  find_network_setting(axis.setting, option);
  const std::string values(trim(text.substr(equals + 1))), where = option + " " + axis.setting;
  values.find(':') == std::string::npos ? read_list(axis, values, where)
                                        : read_range(axis, values, where);
  return axis;
}

std::string format_axis(const SearchAxis& axis) {
  return axis.setting + '=' +
         (axis.values.empty() ? format_exact(axis.low) + ':' + format_exact(axis.high)
                              : join(axis.values, ","));
}

void require_space(const SearchSpace& space, const std::string& model) {
  const std::string where = "--over";
  const std::span<const std::string_view> followed = network_settings_of(model);
  const std::vector<std::string> known(followed.begin(), followed.end());
  if (known.empty())
    throw Error(where, model + " is no network: it has no settings to search", "give a network");
  if (space.axes.empty())
    throw Error(where, "there is nothing to search", "name settings and values, as hidden=5,10,20");

  // A setting must mean something to the model and to one of the trainers.
  const auto require = [&](const std::string& setting, const std::string& option) {
    if (std::ranges::count(known, setting) == 0)
      throw Error(option, model + " does not follow '" + setting + "'",
                  "it follows " + join(known, ", "));
    if (std::ranges::none_of(trainers_of(space), [&](Trainer t) { return has_use(t, setting); }))
      throw Error(option, "no trainer of this search has a use for '" + setting + "'",
                  "search or fix another trainer too, as trainer=adam");
  };

  // All that is fixed, then each axis, once.
  for (const NetworkSetting& setting : network_settings())
    if (!setting.format(space.fixed).empty()) require(std::string(setting.name), "--network");
  std::set<std::string> seen;
  for (const SearchAxis& axis : space.axes) {
    if (!seen.insert(axis.setting).second)
      throw Error(where, axis.setting + " comes twice", "give all its values at once");
    if (!find_network_setting(axis.setting, where).format(space.fixed).empty())
      throw Error(where, axis.setting + " is fixed as well",
                  "leave it out of the one or of the other");
    require(axis.setting, where);
  }
}

std::vector<NetworkDesign> grid_designs(const SearchSpace& space, std::size_t steps) {
  if (steps > kMostDesigns)
    throw Error("grid", std::to_string(steps) + " values of a range are as many fits at least",
                "give at most " + std::to_string(kMostDesigns));

  // Combine what there is so far with each value of the next axis.
  std::vector<std::vector<Setting>> combinations{{}};
  for (const SearchAxis& axis : space.axes) {
    const std::vector<std::string> values = grid_values(axis, steps);
    if (combinations.size() * values.size() > kMostDesigns)
      throw Error("grid", "has over " + std::to_string(kMostDesigns) + " combinations",
                  "give fewer values, or draw some by chance");
    std::vector<std::vector<Setting>> longer;
    for (const std::vector<Setting>& combination : combinations)
      for (const std::string& value : values) {
        longer.push_back(combination);
        longer.back().emplace_back(axis.setting, value);
      }
    combinations = std::move(longer);
  }

  // Settings without a use fall away: keep one of those that become equal.
  std::vector<NetworkDesign> designs;
  std::set<std::string> seen;
  for (const std::vector<Setting>& combination : combinations) {
    NetworkDesign design = compose(space.fixed, combination);
    if (seen.insert(format_design(design)).second) designs.push_back(std::move(design));
  }
  return designs;
}

std::vector<NetworkDesign> random_designs(const SearchSpace& space, std::size_t count,
                                          std::uint64_t seed) {
  constexpr std::size_t kTries = 1000;  // in a row that find nothing new: there is no more
  Random random(seed_for(seed, "designs"));
  std::vector<NetworkDesign> designs;
  std::set<std::string> seen;
  for (std::size_t in_vain = 0; designs.size() < count && in_vain < kTries; ++in_vain) {
    // Draw one value per axis; count the draws in vain since the last new design.
    std::vector<Setting> drawn;
    for (const SearchAxis& axis : space.axes)
      drawn.emplace_back(axis.setting, drawn_value(axis, random));
    NetworkDesign design = compose(space.fixed, std::move(drawn));
    if (!seen.insert(format_design(design)).second) continue;
    designs.push_back(std::move(design));
    in_vain = 0;
  }
  return designs;
}

std::uint64_t seed_for(std::uint64_t seed, std::string_view purpose) {
  constexpr std::size_t kHexDigits = 16;
  const std::string hash = sha256(std::to_string(seed) + '\n' + std::string(purpose));
  std::uint64_t result = 0;
  std::from_chars(hash.data(), hash.data() + kHexDigits, result, 16);
  return result;
}

}  // namespace dashpot
