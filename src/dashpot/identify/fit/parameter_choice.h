#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/law.h"
#include "dashpot/fit_choices.h"

namespace dashpot {

/// The coil's first-order lag is fitted beside the law's own parameters when the drive varies
/// within a record.
extern const ParamInfo kLagParameter;

/// The models that are to be fitted.
using ModelNames = std::vector<std::string>;

/// "alpha=exponential" or "bouc_wen.alpha=exponential"; `option` stands in messages.
ParameterChoice parse_form_choice(std::string_view text, const std::string& option,
                                  const ModelNames& models);
/// "n=2", "k1=5N/cm": in SI, or with a unit behind the number.
ParameterChoice parse_fixed_choice(std::string_view text, const std::string& option,
                                   const ModelNames& models);
/// "n"
ParameterChoice parse_free_choice(std::string_view text, const std::string& option,
                                  const ModelNames& models);
/// "c0=0:5000"
ParameterChoice parse_bounds_choice(std::string_view text, const std::string& option,
                                    const ModelNames& models);
/// "k1=500+-100"
ParameterChoice parse_prior_choice(std::string_view text, const std::string& option,
                                   const ModelNames& models);

/// Throws Error when a choice names no parameter of `models`, contradicts another one or leaves its
/// bounds.
void require_choices(const std::vector<ParameterChoice>& choices, const ModelNames& models);

/// Everything that was chosen for one parameter of a model, a law or a hybrid; a choice that names
/// the model goes before one that does not.
ParameterChoice choice_for(const std::vector<ParameterChoice>& choices, std::string_view model,
                           const ParamInfo& param);

/// The row of the table as the choice changes it: bounds, whether it is estimated, its form and its
/// value.
ParamInfo with_choice(ParamInfo param, const ParameterChoice& choice);

}  // namespace dashpot
