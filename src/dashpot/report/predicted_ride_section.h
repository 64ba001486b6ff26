#pragma once
#include <string>
#include <vector>

#include "dashpot/rank.h"
#include "dashpot/report/document.h"

namespace dashpot {

/// The ranking by the ride beside that of the bench: models in the order of their predicted error,
/// then those that were not ridden, each with its reason. None where nothing was ridden. A click on
/// a row chooses the model.
std::vector<DocumentSection> predicted_ride_sections(const Ranking& ranking);

/// For programs; null where the model was not to be ridden.
Value predicted_json(const RankedModel& model);
/// The ride that all went through; null without one.
Value ridden_json(const Ranking& ranking);

/// Its columns of the leaderboard as CSV: titles, and a model's fields; "" where nothing was
/// ridden.
std::string predicted_csv_titles(const Ranking& ranking);
std::string predicted_csv(const Ranking& ranking, const RankedModel& model);

}  // namespace dashpot
