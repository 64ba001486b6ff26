#pragma once
#include "dashpot/report/document.h"
#include "dashpot/value.h"
#include "studies/family/family_study.h"

namespace dashpot {

/// The study as a page: the family paper's figures by their numbers, its values and those of its
/// published networks beside ours. What it says is computed from the study, which must hold
/// family_experiments(). Of other recordings than the paper's it has the dampers that were not seen
/// alone, and nothing of the paper's figures.
Document family_document(const FamilyStudy& study, bool of_paper = true);

/// Every experiment of the study by name, for programs.
Value family_json(const FamilyStudy& study);

}  // namespace dashpot
