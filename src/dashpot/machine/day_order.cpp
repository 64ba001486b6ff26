#include "dashpot/machine/day_order.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace dashpot {
namespace {

/// A name with each number as '#': what the names of one series share. Empty where a year ends it,
/// as in 31.12.2026, so that its numbers are no order.
std::string series_of(const std::string& name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string series, number;
  for (const char c : std::filesystem::path(name).stem().string()) {
    if (!is_digit(c)) number.clear();
    if (!is_digit(c) || number.empty()) series += is_digit(c) ? '#' : c;
    if (is_digit(c)) number += c;
  }
  const bool ends_in_year = std::ranges::count(series, '#') > 2 && number.size() == 4 &&
                            (number.starts_with("19") || number.starts_with("20"));
  return ends_in_year ? "" : series;
}

}  // namespace

std::string day_disorder(const std::vector<std::string>& names) {
  for (std::size_t d = 1; d < names.size(); ++d) {
    const std::string series = series_of(names[d]);
    if (!series.empty() && series == series_of(names[d - 1]) &&
        strverscmp(names[d - 1].c_str(), names[d].c_str()) > 0)
      return names[d] + " comes behind " + names[d - 1] +
             ", and its name says before: days are taken in the order in which they are given; "
             "give them in their own, or their folder, which is read by the numbers in the names";
  }
  return {};
}

}  // namespace dashpot
