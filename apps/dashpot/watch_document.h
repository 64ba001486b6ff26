#pragma once
#include <string>

#include "dashpot/machine/watched.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// Verdict, the days as a table, the charts, and all of it as JSON, which is in SI.
Document watch_document(const Watched& watched, const PrintUnits& units);
/// A row per day.
std::string watch_csv(const Watched& watched, const PrintUnits& units);

}  // namespace dashpot::cli
