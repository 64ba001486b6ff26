#pragma once
#include "dashpot/report/document.h"
#include "studies/suspension/suspension_study.h"

namespace dashpot {

/// The study as a page: the paper's figures 12 and 13 and its table 8 beside ours, what is possible
/// at best, and which of its claims follow. What it says is computed from the study.
Document suspension_study_document(const SuspensionStudy& study);

/// Its figures by name, for programs.
Value suspension_study_json(const SuspensionStudy& study);

}  // namespace dashpot
