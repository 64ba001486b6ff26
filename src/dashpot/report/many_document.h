#pragma once
#include "dashpot/identify/many/many.h"
#include "dashpot/report/column_table.h"
#include "dashpot/report/document.h"

namespace dashpot {

/// A night of production as a page: which dampers stand out and in what, which have no result, what
/// is usual of each quantity and how it drifts.
Document many_document(const ManyReport& report);

/// A row per damper, in the order of serial numbers: its verdict, its numbers, and in what it
/// stands out.
ColumnTable many_table(const ManyReport& report);

/// Counts, the population and what stands out, for programs; the rows are in the table.
Value many_json(const ManyReport& report);

}  // namespace dashpot
