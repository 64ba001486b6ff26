#include "dashpot/base/part.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "dashpot/error.h"

namespace dashpot {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

Part parse_part(const std::string& text, const std::string& where) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = whole_number(std::string_view(text).substr(0, slash)),
               of = whole_number(std::string_view(text).substr(slash + 1));
    if (number && of && *number >= 1 && *number <= *of) return {*number, *of};
  }
  throw Error(where, "is '" + text + "', not a part",
              "give its number and how many there are, as 3/16: from 1/16 to 16/16");
}

std::string format_part(const Part& part) {
  return std::to_string(part.number) + '/' + std::to_string(part.of);
}

}  // namespace dashpot
