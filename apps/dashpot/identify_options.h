#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/identify/fit/fit_words.h"

namespace dashpot::cli {

/// The settings of the fits that `identify` and `demo` take from the user.
using FitSettings = FitWords;

std::vector<Option> fit_options(FitSettings& settings);

/// The models asked for, those of them that the data allow when a group is asked for; a note names
/// those passed over.
std::vector<std::string> chosen_models(const FitSettings& settings, const Dataset& dataset,
                                       Console& console);

/// Throws UsageError where what was chosen for a parameter does not fit `models`.
IdentifyOptions identify_options(const FitSettings& settings,
                                 const std::vector<std::string>& models, Console& console);

}  // namespace dashpot::cli
