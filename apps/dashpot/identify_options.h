#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/identify/fit/fit_words.h"
#include "dashpot/identify/rank/model_choice.h"

namespace dashpot::cli {

/// The settings of the fits that `identify` and `demo` take from the user.
using FitSettings = FitWords;

std::vector<Option> fit_options(FitSettings& settings);
/// What --budget is unless it is stated.
std::string budget_of_groups();
/// The time that a group of models may take; `default_text` says what it is unless stated.
Option budget_option(FitSettings& settings, const std::string& default_text);

/// The models asked for; of a group, those that the data and the budget allow. A note names those
/// that need a channel which the data lack.
ChosenModels chosen_models(const FitSettings& settings, const Dataset& dataset,
                           const LeaveOut& leave_out, Console& console);

/// Throws UsageError where what was chosen for a parameter does not fit `models`.
IdentifyOptions identify_options(const FitSettings& settings,
                                 const std::vector<std::string>& models, Console& console);

}  // namespace dashpot::cli
