#include "dashpot/damper/model_file.h"
#include "fuzz.h"

/// What is read can be run, written, and read again.
void fuzz(const std::string& input) {
  const dashpot::ModelFile file = dashpot::parse_model(input, "fuzz.json");
  const std::string text = dashpot::format_model(file);
  if (dashpot::format_model(dashpot::parse_model(text, "again")) != text) std::abort();
}
