#include "dashpot/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace dashpot {

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::optional<double> parse_number(std::string_view text, char decimal) {
  text = trim(text);
  // from_chars refuses a leading plus.
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  if (text.empty() || text.front() == '+') return std::nullopt;

  // from_chars knows the point only: put it in the place of another sign.
  std::array<char, 64> with_point;
  if (decimal != '.') {
    if (text.size() > with_point.size() || text.find('.') != std::string_view::npos)
      return std::nullopt;
    std::replace_copy(text.begin(), text.end(), with_point.begin(), decimal, '.');
    text = {with_point.data(), text.size()};
  }

  // The whole text must be the number.
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string format_exact(double value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string format_number(double value, int digits) {
  std::array<char, 32> buffer;
  const double without_minus_zero = value + 0.0;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                    without_minus_zero, std::chars_format::general, digits);
  return {buffer.data(), result.ptr};
}

std::string format_plain(double value, int digits) {
  const std::string text = format_number(value, digits);
  const double size = std::abs(value);
  const bool is_long = text.find('e') != std::string::npos && size >= 1 && size < 1e6;
  return is_long ? format_number(std::round(value), 7) : text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c += 'a' - 'A';
  return out;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  for (std::size_t at; (at = text.find(separator, start)) != std::string_view::npos; start = at + 1)
    parts.emplace_back(text.substr(start, at - start));
  parts.emplace_back(text.substr(start));
  return parts;
}

std::string join(const std::vector<std::string>& parts, std::string_view separator) {
  std::string out;
  for (const std::string& part : parts) {
    if (!out.empty() || &part != &parts.front()) out += separator;
    out += part;
  }
  return out;
}

/// Levenshtein distance: the letters to insert, delete or change.
static std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row[b.size()];
}

std::optional<std::string> closest(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  const std::string wanted = lower(word);
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, wanted.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::string name = lower(candidate);
    // A word that is the beginning of a name is nearer than any mistyped one.
    const bool begins = wanted.size() >= 3 && name.compare(0, wanted.size(), wanted) == 0;
    const std::size_t distance = begins ? 0 : edit_distance(wanted, name);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggest(std::string_view word, const std::vector<std::string>& known,
                    const std::vector<std::string>& unlisted) {
  std::vector<std::string> all = known;
  all.insert(all.end(), unlisted.begin(), unlisted.end());
  // Only the names of files that come with Dashpot can be none.
  if (all.empty()) return "none is found: DASHPOT_DATA may name the folder of Dashpot's data";
  const auto near = closest(word, all);
  return (near ? "did you mean '" + *near + "'? " : "") + "known: " + join(known, ", ");
}

}  // namespace dashpot
