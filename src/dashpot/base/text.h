#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot {

/// The number that the whole text is, or nothing. Locale-proof. `decimal` is '.' or ','. "nan" and
/// "inf" are numbers here; the caller decides whether they are allowed.
std::optional<double> parse_number(std::string_view text, char decimal = '.');

/// Shortest text that reads back as the same double.
std::string format_exact(double value);

/// `value` with at most `digits` significant digits, for people: 12.3, 0.00451, 3.63e+06.
std::string format_number(double value, int digits = 4);

/// The same without an exponent up to a million, as people write forces and stiffnesses: 123457.
std::string format_plain(double value, int digits = 4);

/// "2 records", "1 record".
std::string counted(std::size_t count, std::string_view noun);

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);
std::vector<std::string> split(std::string_view text, char separator);
std::string join(const std::vector<std::string>& parts, std::string_view separator);

/// The candidate nearest to a mistyped word, or nothing when none is near.
std::optional<std::string> closest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// "did you mean 'bingham'? known: bingham, ..." for the last part of an Error.
std::string suggest(std::string_view word, const std::vector<std::string>& known,
                    const std::vector<std::string>& unlisted = {});

}  // namespace dashpot
