#include "dashpot/base/settings.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// What stands before the '=', or nothing where there is none.
std::string name_in(const std::string& part) {
  const std::size_t equals = part.find('=');
  return equals == std::string::npos ? "" : std::string(trim(part.substr(0, equals)));
}

}  // namespace

std::optional<std::string> stated_twice(std::span<const std::string> parts) {
  std::vector<std::string> names;
  for (const std::string& part : parts) {
    const std::string name = name_in(part);
    if (name.empty()) continue;
    if (std::ranges::find(names, name) != names.end()) return name;
    names.push_back(name);
  }
  return {};
}

std::vector<std::string> split_words(const std::string& words, const std::string& where) {
  std::vector<std::string> parts = split(words, ',');
  for (std::string& part : parts) part = trim(part);
  if (const auto twice = stated_twice(parts))
    throw Error(where, *twice + " is stated twice in '" + words + "'", "one value of each name");
  return parts;
}

std::string without_setting(const std::string& words, std::string_view name) {
  std::vector<std::string> parts = split(words, ',');
  std::erase_if(parts, [&](const std::string& part) { return name_in(part) == name; });
  return join(parts, ",");
}

std::string with_setting(const std::string& words, const std::string& name,
                         const std::string& value) {
  return without_setting(words, name) + ',' + name + '=' + value;
}

}  // namespace dashpot
