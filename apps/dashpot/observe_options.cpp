#include "observe_options.h"

#include <optional>
#include <utility>

#include "dashpot/base/text.h"

namespace dashpot::cli {
namespace {

/// "30@0.01": a standard deviation and a time, both above 0; `alone`: the time of "30".
std::pair<double, double> process_of(const std::string& option, const std::string& word,
                                     const std::string& right,
                                     std::optional<double> alone = std::nullopt) {
  const std::size_t at = word.find('@');
  const auto deviation = parse_number(word.substr(0, at));
  const auto memory = at == std::string::npos ? alone : parse_number(word.substr(at + 1));
  if (!deviation || !memory || !(*deviation > 0) || !(*memory > 0))
    throw UsageError(option, "is '" + word + "'", right);
  return {*deviation, *memory};
}

}  // namespace

Option force_error_option(std::vector<std::string>& words) {
  return {.names = "--force-error",
          .target = &words,
          .help =
              "errors of the model's force as standard deviation @ time in which it is "
              "forgotten, without a time one that stays: 30@0.01,50@1,20",
          .value = "N@S,...",
          .default_text = "found from the recordings: a quick, a slow and one that stays"};
}

Option velocity_shift_option(std::string& word) {
  return {.names = "--velocity-shift",
          .target = &word,
          .help =
              "how far from the damper's velocity that is by which the model's force goes, as "
              "standard deviation @ time in which it is forgotten: 0.004@0.015",
          .value = "M/S@S",
          .default_text = "found with the errors of the force; none where these are stated"};
}

std::vector<ForceError> force_errors(const std::vector<std::string>& words) {
  std::vector<ForceError> errors;
  for (const std::string& word : words) {
    const auto [deviation, memory] = process_of(
        "--force-error", word, "newtons @ seconds, as 30@0.01; newtons alone where the error stays",
        kStayingError);
    errors.push_back({deviation, memory});
  }
  return errors;
}

VelocityShift velocity_shift(const std::string& word) {
  if (word.empty()) return {};
  const auto [deviation, memory] =
      process_of("--velocity-shift", word, "m/s @ seconds, as 0.004@0.015");
  return {deviation, memory};
}

}  // namespace dashpot::cli
