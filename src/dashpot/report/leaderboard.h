#pragma once
#include <string>

#include "dashpot/drive.h"
#include "dashpot/rank.h"
#include "dashpot/report/report.h"

namespace dashpot {

// The full comparison of models: accuracy on left-out records in several ways, beside what each
// costs and whether it stays bounded beyond its data.

/// One row per model, best first, within `width` columns.
std::string leaderboard_table(const Ranking& ranking, int width = 100);
/// RMS error by speed and ESR by drive, one row per model.
std::string breakdown_table(const Ranking& ranking, DriveUnit drive_unit, int width = 100);

/// The same two tables and how they were made, without a date, as a part of a page: `heading` is
/// "##", say.
std::string markdown_leaderboard(const ReportInput& input, const std::string& heading = "##");
/// One line per model with every figure of both tables.
std::string csv_leaderboard(const ReportInput& input);

/// "yes", "up to 12 spans", "diverged"; "-" when the model was not driven beyond its data.
std::string stress_text(const StressRun& run);

}  // namespace dashpot
