#pragma once
#include <string>

// Numbers and levels in the words of a document.
namespace dashpot {

/// "3.63", "12.4", "128": percent with a resolution that fits its size; "-" when not finite.
std::string percent_text(double value);
/// `digits` significant digits, or "-" when not finite.
std::string number_text(double value, int digits = 3);
/// "12", or "8 ... 12" where the least and the greatest differ as they are printed.
std::string range_text(double least, double greatest, int digits);
/// "0.5 A"; without a unit "constant drive", since nothing is known of it.
std::string level_text(double level, const std::string& unit);

}  // namespace dashpot
