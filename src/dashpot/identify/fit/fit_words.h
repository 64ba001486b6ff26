#pragma once
#include <string>
#include <vector>

#include "dashpot/identify.h"

namespace dashpot {

/// A user's wishes for fits, in the words of the command line, of Python and of a C program.
struct FitWords {
  std::vector<std::string> models = {"usual"};  ///< names, "usual", "all", "family"
  std::string force_offset = "record";          ///< or "none"
  std::vector<std::string> forms, fixed, freed, bounds, priors;  ///< as "parameter=..."
  std::vector<std::string> network;                              ///< as "setting=..."
  IdentifyOptions options;
};

/// The models that an engineer tries first: few, quick, and good on measured dampers.
const std::vector<std::string>& usual_models();

/// The models that words stand for, each once.
struct ChosenModels {
  std::vector<std::string> names;
  std::vector<std::string>
      passed_over;  ///< of a group: they need a displacement, which not every record has
};
/// An unknown name stays as it is: who fits it refuses it.
ChosenModels choose_models(const std::vector<std::string>& words,
                           const std::vector<Record>& records);

/// "record" or "none". Throws Error(where, ...) on another word.
OffsetMode offset_mode(const std::string& word, const std::string& where);

/// The options of a fit, without a monitor. Throws Error where a word does not fit `models`;
/// `prefix` stands before the option's name in messages: "--".
IdentifyOptions identify_options(const FitWords& words, const std::vector<std::string>& models,
                                 const std::string& prefix);

}  // namespace dashpot
