#include "dashpot/damper/inverse/inverse_file.h"
#include "fuzz.h"

/// What is read can be run, written, and read again.
void fuzz(const std::string& input) {
  const dashpot::InverseFile file = dashpot::parse_inverse(input, "fuzz.json");
  const std::string text = dashpot::format_inverse(file);
  if (dashpot::format_inverse(dashpot::parse_inverse(text, "again")) != text) std::abort();
  const dashpot::HistoryNetwork inverse(
      file.network, {file.network.current_min, file.network.current_max, file.network.spacing, 0});
  std::vector<double> state(inverse.state_size());
  inverse.rest({}, state);
  for (const double force : {1.0, -1e300, 1e300}) {
    const double current = inverse.command({force, 0.01, 0.1, 0.5, 0}, state);
    if (!(current >= file.network.current_min && current <= file.network.current_max)) std::abort();
  }
}
