#include "fuzz.h"

/// The text of what was understood is understood alike.
void fuzz(const std::string& input) {
  const std::string text = dashpot::format_leave_out(dashpot::parse_leave_out(input));
  if (dashpot::format_leave_out(dashpot::parse_leave_out(text)) != text) std::abort();
}
