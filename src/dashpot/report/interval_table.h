#pragma once
#include <string>

#include "dashpot/identify.h"
#include "dashpot/rank.h"

namespace dashpot {

// The models' intervals of the force, and what they covered of left-out records. Empty where no
// model has one.

std::string interval_table(const Ranking& ranking, int width = 100);
/// The table with a sentence that says how to read it.
std::string markdown_intervals(const Ranking& ranking);
/// One sentence: "The 90 % interval covers 88.1 % of the samples, ...".
std::string interval_sentence(const Evaluation& evaluation);

}  // namespace dashpot
