#pragma once
#include "dashpot/report/report.h"

namespace dashpot::cli {

/// The report with a part of its page in which the models run: sliders for a motion and for the
/// parameters of laws. Models whose program would make the page much larger are left out, and the
/// page says which.
Document with_sliders(Document report, const ReportInput& input);

}  // namespace dashpot::cli
