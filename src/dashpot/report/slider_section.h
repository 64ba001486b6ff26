#pragma once
#include <optional>

#include "dashpot/report/report.h"

namespace dashpot {

/// A part of a page in which the models run: sliders for a motion and for the parameters of laws.
/// Models whose program would make the page much larger are left out, and the part says which.
/// Nothing where nobody makes programs (ReportInput::program), or no model has one. `loops`: the
/// recorded ones, to stand under those of the models.
std::optional<DocumentSection> slider_section(const ReportInput& input,
                                              std::vector<DocumentSliders::Loop> loops = {});

}  // namespace dashpot
