#pragma once
#include <vector>

#include "dashpot/identify/judge/residual_test.h"
#include "dashpot/rank.h"
#include "dashpot/report/document.h"

namespace dashpot {

/// Tests of what each model of a ranking leaves over on its left-out records, model by model.
std::vector<std::vector<ResidualTest>> residual_tests(const Ranking& ranking);

/// What the models leave over, record by record and following the choice "model"; and whether a
/// law's better fit is worth its parameters. A page has room for the tables.
DocumentSection residual_section(const Ranking& ranking);

}  // namespace dashpot
