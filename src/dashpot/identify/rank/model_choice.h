#pragma once
#include <string>
#include <vector>

#include "dashpot/identify/fit/fit_words.h"
#include "dashpot/identify/rank/divisions.h"
#include "dashpot/rank.h"

// Which models are fitted: those that the user names, and of a group those that a budget of time
// allows. The choice rests on estimated costs, never on a clock: the same data and options choose
// the same models on every machine, whatever else it does.

namespace dashpot {

constexpr double kUsualBudget = 2;  ///< minutes on two cores, for the group "usual"

/// What is tried unasked, in the order in which a growing budget tries it: few laws that cost
/// seconds, then what left least on measured dampers for its cost (docs/concepts.md has the
/// figures). Where the drive varies within records, `hysteresis_network` comes before
/// `passive_network`. The latter reads the displacement; without one, its twin of one sensor stands
/// in its place.
const std::vector<std::string>& usual_models();

/// CPU seconds that a ranking spends on the fits of a model with the usual effort (starts, members;
/// epochs as `design` has them) on one core of a present server. An estimate: within a factor of
/// two on the recordings that it was measured on.
double expected_seconds(const std::string& model, const Divisions& divisions, DriveUnit drive_unit,
                        const NetworkDesign& design = {});

/// The models that words stand for, each once.
struct ChosenModels {
  std::vector<std::string> names;
  std::vector<std::string> passed_over;  ///< they need a displacement, which not every record has
  std::optional<FitBudget> budget;       ///< where a group was named that a budget limits
};
/// All of them, without a budget. An unknown name stays as it is: who fits it refuses it. Throws
/// Error when each of them needs a displacement that a record lacks.
ChosenModels choose_models(const std::vector<std::string>& words,
                           const std::vector<Record>& records);

/// The same within the budget of `words`. A model that is named itself is never dropped and counts
/// nothing; those of the groups "usual" and "all" are tried in their order (behind the usual ones:
/// the cheapest first) up to the one that the budget does not reach, but one at least. Throws
/// Error(where, ...) on a budget that is negative or infinite, and when the dataset cannot be
/// divided.
ChosenModels choose_models(const FitWords& words, const Dataset& dataset, const LeaveOut& leave_out,
                           const std::string& where);

}  // namespace dashpot
