#pragma once
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

/// The cases of a campaign, from the first to before the last: as many as usual, or as a variable
/// of the environment says, "10000" or the part "2000-4000". Every case has its number as its seed,
/// so that parts make a whole.
inline std::pair<int, int> asked_cases(const char* variable, int usual) {
  const char* asked = std::getenv(variable);
  if (!asked) return {0, usual};
  const std::string text = asked;
  const std::size_t dash = text.find('-');
  const std::pair<int, int> cases{dash == std::string::npos ? 0 : std::stoi(text),
                                  std::stoi(text.substr(dash == std::string::npos ? 0 : dash + 1))};
  if (cases.first < 0 || cases.first >= cases.second)
    throw std::invalid_argument(std::string(variable) + "=" + text + " names no cases");
  return cases;
}
