#include "dashpot/identify/fit/parameter_choice.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/damper/model_info.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::string_view kUnknownUnit = "a unit that no law has";

/// A parameter as a choice names it, and what is said of it.
struct Statement {
  ParameterChoice choice;
  std::string_view value;
};

/// The laws that a choice may mean: that of the model named, else those of all models to be fitted.
std::vector<const Law*> laws_meant(const std::string& named, const ModelNames& models) {
  std::vector<const Law*> meant;
  for (const std::string& model : named.empty() ? models : ModelNames{named})
    if (const Law* law = law_inside(model);
        law && std::find(meant.begin(), meant.end(), law) == meant.end())
      meant.push_back(law);
  return meant;
}

/// All that may be chosen in a law's fit: its table, the valve of one direction, the coil's lag.
std::vector<const ParamInfo*> rows_of(const Law& law) {
  std::vector<const ParamInfo*> rows;
  for (const ParamInfo& param : with_side(law).params) rows.push_back(&param);
  rows.push_back(&kLagParameter);
  return rows;
}

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

/// The rows that may be meant by `parameter`: those of the law named, else of the laws among
/// `models`.
std::vector<const ParamInfo*> rows_named(const ParameterChoice& choice, const ModelNames& models) {
  std::vector<const ParamInfo*> rows;
  for (const Law* law : laws_meant(choice.law, models))
    for (const ParamInfo* row : rows_of(*law))
      if (row->name == choice.parameter) rows.push_back(row);
  return rows;
}

std::vector<std::string> known_parameters(const std::string& law, const ModelNames& models) {
  std::vector<std::string> known;
  for (const Law* each : laws_meant(law, models))
    for (const ParamInfo* row : rows_of(*each)) known.emplace_back(row->name);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  return known;
}

/// Takes "law.parameter" apart; throws where nothing has that name.
ParameterChoice named(std::string_view text, const std::string& option, const ModelNames& models) {
  ParameterChoice choice;
  const std::size_t dot = text.find('.');
  if (dot != std::string_view::npos) {
    choice.law = trim(text.substr(0, dot));
    if (!law_inside(choice.law))
      throw_unknown_model(choice.law, option, model_names(), more_model_names());
  }
  choice.parameter = trim(dot == std::string_view::npos ? text : text.substr(dot + 1));
  if (rows_named(choice, models).empty())
    throw Error(option, "no model to be fitted has a parameter " + in_quotes(choice.parameter),
                suggest(choice.parameter, known_parameters(choice.law, models)));
  return choice;
}

Statement parse_statement(std::string_view text, const std::string& option,
                          const ModelNames& models, const std::string& right) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || trim(text.substr(equals + 1)).empty())
    throw Error(option, in_quotes(text) + " does not say what the parameter is to be", right);
  return {named(text.substr(0, equals), option, models), trim(text.substr(equals + 1))};
}

/// The unit of the parameter in SI, where all laws meant agree on it.
std::string_view unit_of(const ParameterChoice& choice, const ModelNames& models) {
  const auto rows = rows_named(choice, models);
  const bool agree = std::ranges::all_of(
      rows, [&](const ParamInfo* row) { return row->unit == rows.front()->unit; });
  return agree ? rows.front()->unit : kUnknownUnit;
}

double chosen_quantity(std::string_view text, const ParameterChoice& choice,
                       const std::string& option, const ModelNames& models) {
  const std::string where = option + ", " + choice.parameter;
  const std::string_view own = unit_of(choice, models);
  if (own != kUnknownUnit) return parse_quantity(text, own, where);
  if (const auto plain = parse_number(text); plain && std::isfinite(*plain)) return *plain;
  throw Error(where, "the laws that have it count it in different units",
              "name one: law." + choice.parameter);
}

std::string range_text(const ParameterBounds& bounds, std::string_view unit) {
  return format_number(bounds.lower) + " ... " + format_number(bounds.upper) + " " +
         std::string(unit);
}

void require_within(double value, const ParameterBounds& bounds, const ParamInfo& param,
                    const std::string& what) {
  if (value >= bounds.lower && value <= bounds.upper) return;
  throw Error(std::string(param.name),
              what + " " + format_number(value) + " lies outside its bounds",
              range_text(bounds, param.unit));
}

/// Throws where what was chosen for one row of a law's table does not go together.
void require_consistent(const ParamInfo& param, const ParameterChoice& choice) {
  const std::string name(param.name);
  if (param.fit == Fit::Drive)
    throw Error(name, "is the coil current itself", "nothing is to be chosen for it");

  if (choice.fixed && (choice.form || choice.free || choice.bounds || choice.prior))
    throw Error(name, "is fixed, and something else is asked of it too",
                "a fixed parameter has neither form, bounds nor prior");

  // Bounds must hold something, and lie within the table's.
  const ParameterBounds table{param.lower, param.upper};
  const ParameterBounds bounds = choice.bounds.value_or(table);
  if (!(bounds.lower < bounds.upper))
    throw Error(name, "its bounds " + range_text(bounds, param.unit) + " hold nothing",
                "write lower:upper; --fix fixes it");
  if (bounds.lower < table.lower || bounds.upper > table.upper)
    throw Error(name, "its bounds " + range_text(bounds, param.unit) + " reach beyond the law's",
                range_text(table, param.unit));

  // A value must lie within them.
  if (choice.fixed) require_within(*choice.fixed, table, param, "the value");
  if (choice.prior) require_within(choice.prior->value, bounds, param, "the prior's value");
}

}  // namespace

const ParamInfo kLagParameter{.name = "lag_rate",
                              .unit = "1/s",
                              .value = 100,
                              .lower = 1,
                              .upper = 5000,
                              .start = 100,
                              .form = Form::Constant,
                              .fit = Fit::Free,
                              .meaning = "rate of the coil's first-order lag"};

ParameterChoice parse_form_choice(std::string_view text, const std::string& option,
                                  const ModelNames& models) {
  auto [choice, value] = parse_statement(text, option, models, "write alpha=exponential");
  choice.form = parse_form(value, option);
  if (choice.parameter == kLagParameter.name && *choice.form != Form::Constant)
    throw Error(option, "the lag rate is one number", "it does not follow the current");
  return choice;
}

ParameterChoice parse_fixed_choice(std::string_view text, const std::string& option,
                                   const ModelNames& models) {
  auto [choice, value] = parse_statement(text, option, models, "write n=2");
  choice.fixed = chosen_quantity(value, choice, option, models);
  return choice;
}

ParameterChoice parse_free_choice(std::string_view text, const std::string& option,
                                  const ModelNames& models) {
  ParameterChoice choice = named(text, option, models);
  choice.free = true;
  return choice;
}

ParameterChoice parse_bounds_choice(std::string_view text, const std::string& option,
                                    const ModelNames& models) {
  auto [choice, value] = parse_statement(text, option, models, "write c0=0:5000");
  const std::size_t colon = value.find(':');
  if (colon == std::string_view::npos)
    throw Error(option, in_quotes(text) + " has one bound", "write lower:upper, as c0=0:5000");
  choice.bounds = {chosen_quantity(trim(value.substr(0, colon)), choice, option, models),
                   chosen_quantity(trim(value.substr(colon + 1)), choice, option, models)};
  return choice;
}

ParameterChoice parse_prior_choice(std::string_view text, const std::string& option,
                                   const ModelNames& models) {
  constexpr std::string_view kSign = "+-";
  auto [choice, value] = parse_statement(text, option, models, "write k1=500+-100");
  const std::size_t sign = value.find(kSign);
  if (sign == std::string_view::npos)
    throw Error(option, in_quotes(text) + " has no standard deviation", "write k1=500+-100");
  choice.prior = {chosen_quantity(trim(value.substr(0, sign)), choice, option, models),
                  chosen_quantity(trim(value.substr(sign + kSign.size())), choice, option, models)};
  if (!(choice.prior->deviation > 0))
    throw Error(option, "the standard deviation of " + choice.parameter + " is not above 0",
                "--fix fixes a parameter");
  return choice;
}

void require_choices(const std::vector<ParameterChoice>& choices, const ModelNames& models) {
  for (const ParameterChoice& choice : choices) {
    // In every model that the choice may mean, what is chosen must suit the row of its table.
    bool meant = false;
    for (const std::string& model : models) {
      const Law* law = law_inside(model);
      if (!law || (!choice.law.empty() && choice.law != model)) continue;
      for (const ParamInfo* row : rows_of(*law)) {
        if (row->name != choice.parameter) continue;
        meant = true;
        require_consistent(*row, choice_for(choices, model, *row));
      }
    }

    // A choice that no model has a use for is a mistake.
    if (!meant)
      throw Error(choice.parameter, "none of the models to be fitted has this parameter",
                  "'dashpot models NAME' lists a model's parameters");
  }
}

ParameterChoice choice_for(const std::vector<ParameterChoice>& choices, std::string_view model,
                           const ParamInfo& param) {
  ParameterChoice all{.law = std::string(model), .parameter = std::string(param.name)};
  for (const bool by_law : {false, true})
    for (const ParameterChoice& choice : choices) {
      if (choice.parameter != param.name || choice.law.empty() == by_law) continue;
      if (by_law && choice.law != model) continue;
      if (choice.form) all.form = choice.form;
      if (choice.fixed) all.fixed = choice.fixed;
      if (choice.bounds) all.bounds = choice.bounds;
      if (choice.prior) all.prior = choice.prior;
      all.free |= choice.free;
    }
  return all;
}

ParamInfo with_choice(ParamInfo param, const ParameterChoice& choice) {
  if (choice.fixed) {
    param.value = *choice.fixed;
    param.fit = Fit::Fixed;
    return param;
  }
  if (choice.bounds) {
    param.lower = choice.bounds->lower;
    param.upper = choice.bounds->upper;
  }
  if (choice.form) param.form = *choice.form;
  const bool asked_for = choice.free || choice.form || choice.bounds || choice.prior;
  if (asked_for && param.fit != Fit::Bias) param.fit = Fit::Free;
  return param;
}

}  // namespace dashpot
