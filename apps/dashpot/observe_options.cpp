#include "observe_options.h"

#include "dashpot/base/text.h"

namespace dashpot::cli {

Option force_error_option(std::vector<std::string>& words) {
  return {.names = "--force-error",
          .target = &words,
          .help =
              "errors of the model's force as standard deviation @ time in which it is "
              "forgotten: 30@0.01,50@1",
          .value = "N@S,...",
          .default_text = "found from the recordings, a quick and a slow one"};
}

std::vector<ForceError> force_errors(const std::vector<std::string>& words) {
  std::vector<ForceError> errors;
  for (const std::string& word : words) {
    const std::size_t at = word.find('@');
    const auto deviation = parse_number(word.substr(0, at));
    const auto memory = at == std::string::npos ? std::nullopt : parse_number(word.substr(at + 1));
    if (!deviation || !memory || !(*deviation > 0) || !(*memory > 0))
      throw UsageError("--force-error", "is '" + word + "'", "newtons @ seconds, as 30@0.01");
    errors.push_back({*deviation, *memory});
  }
  return errors;
}

}  // namespace dashpot::cli
