#pragma once
#include <vector>

#include "dashpot/report/column_table.h"
#include "dashpot/report/document.h"
#include "dashpot/suspension/sweep/sweep.h"

namespace dashpot {

/// Quantiles, ratios to the baseline, places of the grid and what matters, as a page.
Document sweep_document(const Sweep& sweep);

/// "rides": a row per vehicle and controller; "quantiles" and "ratios": by controller and measure;
/// "correlations": by controller, input and measure.
std::vector<ColumnTable> sweep_tables(const Sweep& sweep);

/// The tables but the first, for programs.
Value sweep_json(const Sweep& sweep);

}  // namespace dashpot
