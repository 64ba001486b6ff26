#pragma once
#include "dashpot/report/document.h"
#include "dashpot/value.h"
#include "studies/family/family_study.h"

namespace dashpot {

/// The study as a page: the family paper's figures by their numbers, its values and those of its
/// published networks beside ours. What it says is computed from the study, which must hold
/// family_experiments().
Document family_document(const FamilyStudy& study);

/// Every experiment of the study by name, for programs.
Value family_json(const FamilyStudy& study);

}  // namespace dashpot
