#pragma once
#include <optional>
#include <string>

#include "dashpot/rank.h"

// What is said of a ranking: its verdict, how its records were left out, its notes.
namespace dashpot {

/// "converged", "iteration_limit", "failed".
std::string status_name(FitReport::Status status);
/// The model's title, or its name when it has none.
const std::string& display_name(const RankedModel& model);

/// There are figures of it: it was fitted and run on left-out records.
bool is_judged(const RankedModel& model);

/// A few sentences: which model is best, or which ones cannot be told apart; how good it is on what
/// it has not seen; what is next; and which ones cannot be recommended.
std::string verdict(const Ranking& ranking);
/// The same, and which of the dataset's records are suspect.
std::string verdict(const Ranking& ranking, const Dataset& dataset);
/// The records of the errors: "left-out records"; of a model that was fitted elsewhere
/// "records of its fit". And what stands above a table of them: "Left-out records", "Records".
std::string judged_records(const Ranking& ranking);
std::string records_title(const Ranking& ranking);
/// How records were left out: a few words, and in full.
std::string protocol_title(const LeaveOut& leave_out);
std::string protocol(const LeaveOut& leave_out, std::size_t folds);
/// The same of a ranking, whose model may have been fitted elsewhere.
std::string protocol_title(const Ranking& ranking);
std::string protocol(const Ranking& ranking);
/// What the interval of a model's ratio to the first says; nothing for a single model.
std::optional<std::string> comparison_note(const Ranking& ranking);
/// What a budget of time left untried and what that would cost, or that it was too small for any;
/// nothing where all were tried.
std::optional<std::string> budget_note(const Ranking& ranking);
/// What the first model leaves of further recordings, which no fit has seen; nothing without any.
std::optional<std::string> validation_note(const Ranking& ranking);
/// What was taken off the force before the models were ranked, and what follows for other commands.
std::optional<std::string> inertia_note(const Ranking& ranking);
/// The one-step errors of models that feed force back, or that there are none; nothing when models
/// failed.
std::optional<std::string> one_step_note(const Ranking& ranking);

}  // namespace dashpot
