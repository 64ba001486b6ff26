#pragma once
#include <string>

namespace dashpot {

/// Now, as ISO 8601 in UTC: "2026-01-31T12:00:00Z".
std::string date_now();

}  // namespace dashpot
