#include "dashpot/record/conditions.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string strip_separators(std::string text) {
  constexpr std::string_view kSeparators = " _-.,=/";
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

bool alike(const Motion& one, const Motion& other) {
  return one.velocity == other.velocity && close(one.amplitude, other.amplitude) &&
         close(one.frequency, other.frequency);
}

std::string describe_motion(const Motion& motion) {
  const std::string text =
      format_number(motion.amplitude * 1e3, 2) + (motion.velocity ? " mm/s" : " mm");
  // One crossing or none leaves the frequency unknown.
  return motion.frequency > 0 ? text + " " + format_number(motion.frequency, 2) + " Hz" : text;
}

/// Whether mm or Hz stand behind a number somewhere: "hammer" states no motion.
bool states_motion(const std::string& name) {
  const std::string text = lower(name);
  for (const std::string_view unit : {"hz", "mm"})
    for (std::size_t at = 0; (at = text.find(unit, at)) != std::string::npos; ++at) {
      const std::string_view before = std::string_view(text).substr(0, at);
      const std::size_t last = before.find_last_not_of("_- ");
      if (last != std::string_view::npos && is_digit(before[last])) return true;
    }
  return false;
}

/// The last word of a name that is this number and nothing else taken out: of "test_4mm_4Hz_0.5"
/// 0.5. The name itself where there is none.
std::string without_number(const std::string& name, double number) {
  constexpr std::string_view kBetween = "_- ";
  for (std::size_t end = name.size(); end > 0;) {
    const std::size_t mark = name.find_last_of(kBetween, end - 1),
                      begin = mark == std::string::npos ? 0 : mark + 1;
    const std::optional<double> word = parse_number(name.substr(begin, end - begin));
    if (word && std::abs(*word - number) <= 1e-9)
      return strip_separators(strip_separators(name.substr(0, begin)) + name.substr(end));
    end = mark == std::string::npos ? 0 : mark;
  }
  return name;
}

/// The names without a number that is nothing but the record's drive level, which a channel shows:
/// where records that move alike have the same name but for such numbers.
std::vector<std::string> without_bare_levels(const std::vector<Record>& records,
                                             const std::vector<std::string>& names) {
  std::vector<std::string> shorter = names;
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!records[k].drive_level || !states_motion(names[k])) continue;
    shorter[k] = without_number(names[k], *records[k].drive_level);
    if (shorter[k] != names[k]) groups[shorter[k]].push_back(k);
  }

  // A number that tells motions apart is no level, whatever it equals.
  for (const auto& [name, group] : groups) {
    const Motion motion = motion_of(records[group.front()]);
    const bool same = std::ranges::all_of(
        group, [&](std::size_t k) { return alike(motion, motion_of(records[k])); });
    if (group.size() < 2 || !same)
      for (const std::size_t k : group) shorter[k] = names[k];
  }
  return shorter;
}

/// The name without words that may count records: a number ("07") that has no unit behind it, or
/// one behind letters ("run7").
std::string without_counters(const std::string& name) {
  constexpr std::string_view kBetween = "_- ";
  std::string kept;
  for (std::size_t begin = 0, end = 0; begin < name.size(); begin = end + 1) {
    // A word, and whether a unit stands behind it.
    end = std::min(name.find_first_of(kBetween, begin), name.size());
    const std::string word = name.substr(begin, end - begin);
    const std::string behind = lower(name.substr(std::min(end + 1, name.size()), 2));
    const bool has_unit = behind == "mm" || behind == "hz";

    // It counts where it is a number, or letters and then a number.
    const auto digits = std::ranges::find_if_not(word, is_letter);
    const bool counts = digits != word.end() && std::all_of(digits, word.end(), is_digit) &&
                        !(digits == word.begin() && has_unit);
    if (counts || word.empty()) continue;
    if (!kept.empty()) kept += name[begin - 1];
    kept += word;
  }
  return kept;
}

/// The names of records that state a motion, such that those share one which differ in what may
/// count them ("07_sine_5mm_3Hz", "sine_5mm_3Hz_rep2") and move alike.
std::vector<std::string> shared_names(const std::vector<Record>& records,
                                      const std::vector<std::string>& names) {
  struct Moving {
    Motion motion;
    std::string name;  ///< of the first that moves so
  };
  struct Counted {
    std::vector<Moving> motions;
    std::vector<std::size_t> records;
  };
  std::vector<std::string> shared = names;
  std::map<std::string, Counted> all;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!records[k].condition.empty() || !states_motion(names[k])) continue;
    auto& [motions, counted] = all[without_counters(names[k])];
    const Motion motion = motion_of(records[k]);
    auto same = std::ranges::find_if(
        motions, [&](const Moving& other) { return alike(other.motion, motion); });
    if (same == motions.end()) same = motions.insert(same, {motion, names[k]});
    shared[k] = same->name;
    counted.push_back(k);
  }

  // Where all move alike, no number tells them apart.
  for (const auto& [name, counted] : all)
    if (counted.motions.size() == 1 && counted.records.size() > 1)
      for (const std::size_t k : counted.records) shared[k] = name;
  return shared;
}

/// A drive level in a name, and where it stands there.
struct NamedLevel {
  KnownLevel level;
  std::size_t begin = 0, end = 0;
};

/// The digits of a number from k on, at most one point between them.
std::size_t end_of_number(std::string_view text, std::size_t k) {
  while (k < text.size() &&
         (is_digit(text[k]) || (text[k] == '.' && k + 1 < text.size() && is_digit(text[k + 1]))))
    ++k;
  return k;
}

/// Where the run of digits begins that ends in front of `end`.
std::size_t start_of_digits(std::string_view text, std::size_t end) {
  while (end > 0 && is_digit(text[end - 1])) --end;
  return end;
}

std::string two_readings(std::string_view text, double one, double other, std::string_view unit) {
  return "'" + std::string(text) + "' may be " + format_number(one) + " " + std::string(unit) +
         " or " + format_number(other) + " " + std::string(unit);
}

/// What else the digits of a level may mean: what stands in front of them may belong to them.
/// `at` is where its number begins in `name`.
void doubt_digits(NamedLevel& found, std::string_view name, std::size_t at, std::size_t end,
                  std::size_t unit_end, double scale) {
  constexpr double kTooSmall = 0;  // a fraction below the least double
  const std::string_view digits = name.substr(at, end - at),
                         unit = name.substr(end, unit_end - end);
  const bool whole = digits.find('.') == std::string_view::npos;
  const std::size_t start = at > 1 ? start_of_digits(name, at - 1) : at;
  const std::string_view before = at > 1 ? name.substr(start, at - 1 - start) : std::string_view();
  const char mark = at > 0 ? name[at - 1] : ' ';

  // "0,5A" and "0p5A": a decimal sign that file names allow.
  if (whole && !before.empty() && (mark == ',' || mark == 'p')) {
    const auto value = parse_number(std::string(before) + "." + std::string(digits));
    const std::string text(name.substr(start, unit_end - start));
    if (!value) {
      found.level.doubt = "'" + text + "' is no number of " + std::string(unit);
      return;
    }
    found.level.value = *value * scale;
    found.begin = start;
    found.level.note = "'" + text + "' is read as " + format_number(*value) + " " +
                       std::string(unit) + ", '" + mark + "' as the decimal sign";
    return;
  }

  // "05A": the point may have been left out. Levels in mA are often filled up with zeros.
  if (whole && digits.size() > 1 && digits[0] == '0' && scale == 1 && found.level.value != 0) {
    const double other = parse_number("0." + std::string(digits.substr(1))).value_or(kTooSmall);
    found.level.doubt =
        two_readings(name.substr(at, unit_end - at), found.level.value, other, unit);
    return;
  }

  // "0_5A": the mark may stand for the point, and surely may behind a 0. Behind another number it
  // is more often a counter ("run_3_2A").
  const bool alone = start == 0 || !(is_letter(name[start - 1]) || name[start - 1] == '.');
  if (!whole || before.empty() || !alone || (mark != '_' && mark != '-' && mark != ' ')) return;
  const bool zero = before == "0";
  if (!zero && (before.size() > 2 || before[0] == '0')) return;
  const double other =
      parse_number(std::string(before) + "." + std::string(digits)).value_or(kTooSmall);
  const std::string both =
      two_readings(name.substr(start, unit_end - start), other, found.level.value / scale, unit);
  if (zero) {
    found.level.doubt = both;
  } else {
    found.level.note = both + ": read as " + format_number(found.level.value / scale) + " " +
                       std::string(unit) + "; 'level: " + format_number(other * scale) +
                       "' in a dataset file states the other";
  }
}

/// The drive levels in the name of a file or folder, which begins at `offset` of the whole path. A
/// level is a number followed by A, mA, V or mV as a word of its own; in the name of a folder or a
/// part the number begins a word.
std::vector<NamedLevel> levels_in(std::string_view name, std::size_t offset,
                                  const std::string& basis) {
  std::vector<NamedLevel> all;
  for (std::size_t k = 0; k < name.size(); ++k) {
    if (!is_digit(name[k]) || (k > 0 && (is_digit(name[k - 1]) || name[k - 1] == '.'))) continue;
    if (basis != "file name" && k > 0 && is_letter(name[k - 1]) && name[k - 1] != 'p') continue;

    const std::size_t end = end_of_number(name, k);
    const auto value = parse_number(name.substr(k, end - k));
    const bool milli = end < name.size() && name[end] == 'm';
    const std::size_t unit = end + (milli ? 1 : 0);
    const bool is_level =
        value && unit < name.size() && (name[unit] == 'A' || name[unit] == 'V') &&
        (unit + 1 == name.size() || !(is_letter(name[unit + 1]) || is_digit(name[unit + 1])));
    if (!is_level) continue;

    NamedLevel found{{milli ? *value / 1000 : *value,
                      parse_drive_unit(name.substr(unit, 1), basis),
                      basis,
                      true,
                      {},
                      {}},
                     k,
                     unit + 1};
    doubt_digits(found, name, k, end, unit + 1, milli ? 1e-3 : 1);
    found.begin += offset;
    found.end += offset;
    all.push_back(std::move(found));
  }
  return all;
}

std::string words_of_level(const KnownLevel& level) {
  return format_number(level.value) + " " + to_string(level.unit) + " (" + level.basis + ")";
}

/// The first of them, in doubt where another one differs.
KnownLevel settled(const std::vector<NamedLevel>& found) {
  KnownLevel level = found.front().level;
  for (const NamedLevel& other : found)
    if (level.doubt.empty() && (other.level.value != level.value || other.level.unit != level.unit))
      level.doubt = "both " + words_of_level(level) + " and " + words_of_level(other.level) +
                    " are stated by names";
  return level;
}

}  // namespace

NameParts split_name(std::string_view stem) {
  const std::size_t slash = stem.rfind('/');
  const std::size_t name_at = slash == std::string_view::npos ? 0 : slash + 1;
  std::vector<NamedLevel> found = levels_in(stem.substr(name_at), name_at, "file name");

  // The folders speak where the name does not, the innermost first; both may not differ.
  for (std::size_t end = name_at; end > 0;) {
    const std::size_t last = end - 1;
    const std::size_t before = last == 0 ? std::string_view::npos : stem.rfind('/', last - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    const std::vector<NamedLevel> outer =
        levels_in(stem.substr(begin, last - begin), begin, "folder name");
    found.insert(found.end(), outer.begin(), outer.end());
    end = begin;
  }
  if (found.empty()) return {std::nullopt, std::string(stem)};

  // The name without the level, as one word.
  const NamedLevel& first = found.front();
  std::string rest = strip_separators(std::string(stem.substr(0, first.begin))),
              tail = strip_separators(std::string(stem.substr(first.end)));
  if (!rest.empty() && !tail.empty()) rest += "_";
  return {settled(found), rest + tail};
}

NameParts split_part_name(std::string_view stem, std::string_view part) {
  NameParts parts = split_name(stem);

  // A blank between a number and its unit is usual where nobody types names into a terminal.
  std::string name;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const bool before_unit = k > 0 && is_digit(part[k - 1]) && k + 1 < part.size() &&
                             std::string_view("AVm").find(part[k + 1]) != std::string_view::npos;
    if (part[k] != ' ' || !before_unit) name += part[k];
  }

  const std::vector<NamedLevel> found = levels_in(name, 0, "name of a part");
  if (found.empty()) return {parts.level, parts.rest + "_" + std::string(part)};
  KnownLevel level = settled(found);
  if (parts.level && parts.level->value != level.value && level.doubt.empty())
    level.doubt = "both " + words_of_level(level) + " and " + words_of_level(*parts.level) +
                  " are stated by names";
  return {level, parts.rest};
}

std::string level_without_unit(std::string_view name) {
  constexpr std::string_view kSymbols[] = {"I", "U", "V", "current", "Current", "voltage"};
  for (std::size_t begin = 0; begin < name.size(); ++begin) {
    if (begin > 0 && (is_letter(name[begin - 1]) || is_digit(name[begin - 1]))) continue;
    for (const std::string_view symbol : kSymbols) {
      std::size_t at = begin + symbol.size();
      if (name.substr(begin, symbol.size()) != symbol || at >= name.size()) continue;
      at += name[at] == '=' || name[at] == '_';

      // The number up to the end of the word; behind the letter alone a whole one may count.
      std::size_t end = end_of_number(name, at);
      const bool has_comma = end > at && end + 1 < name.size() && name[end] == ',';
      if (has_comma && is_digit(name[end + 1])) end = end_of_number(name, end + 1);
      const bool is_alone = end == name.size() || !(is_letter(name[end]) || is_digit(name[end]));
      const std::string_view word = name.substr(begin, end - begin);
      const bool counts = symbol.size() == 1 && word.find_first_of("=.,") == std::string_view::npos;
      if (end > at && is_alone && !counts) return std::string(word);
    }
  }
  return {};
}

std::optional<KnownLevel> level_of_folder(std::string_view name) {
  const std::vector<NamedLevel> found = levels_in(name, 0, "folder name");
  if (found.empty()) return std::nullopt;
  return settled(found);
}

void infer_conditions(std::vector<Record>& records, const std::vector<std::string>& name_rests) {
  const std::vector<std::string> stated =
      shared_names(records, without_bare_levels(records, name_rests));
  std::vector<std::pair<Motion, std::string>> known;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!records[k].condition.empty()) continue;

    // The name may state the motion itself.
    if (states_motion(stated[k])) {
      records[k].condition = stated[k];
      continue;
    }

    // Else records that move alike share the words of the first.
    const Motion motion = motion_of(records[k]);
    const auto same = std::find_if(known.begin(), known.end(),
                                   [&](const auto& other) { return alike(other.first, motion); });
    records[k].condition = same == known.end() ? describe_motion(motion) : same->second;
    if (same == known.end()) known.emplace_back(motion, records[k].condition);
  }
}

}  // namespace dashpot
