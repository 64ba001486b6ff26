#pragma once
#include <limits>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/identify.h"

namespace dashpot {

/// A user's wishes for fits, in the words of the command line, of Python and of a C program.
struct FitWords {
  std::vector<std::string> models = {"usual"};  ///< names, "usual", "all", "family"
  /// Minutes on two cores for the models that a group stands for, 0: no limit. Unless stated,
  /// kUsualBudget for "usual", and no limit for "all".
  double budget = std::numeric_limits<double>::quiet_NaN();
  std::string force_offset = "record";                           ///< or "none"
  std::vector<std::string> forms, fixed, freed, bounds, priors;  ///< as "parameter=..."
  std::vector<std::string> network;                              ///< as "setting=..."
  std::vector<std::string> from;                                 ///< model files, of one law each
  IdentifyOptions options;
};

/// "record" or "none". Throws Error(where, ...) on another word.
OffsetMode offset_mode(const std::string& word, const std::string& where);

/// The options of a fit, without a monitor. Throws Error where a word does not fit `models`;
/// `prefix` stands before the option's name in messages: "--".
IdentifyOptions identify_options(const FitWords& words, const std::vector<std::string>& models,
                                 const std::string& prefix);

/// The models of `words.from`, for IdentifyOptions::from. Throws Error where a file holds no law
/// among `models`, a law that another file has, or one with another drive than these recordings.
std::vector<std::shared_ptr<const DamperModel>> first_starts(const FitWords& words,
                                                             const std::vector<std::string>& models,
                                                             const Dataset& dataset);

}  // namespace dashpot
