#include "recovery.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

/// Half-width of a two-sided 95 % interval for a dozen parameters at once over that for one
/// (Bonferroni: the normal distribution's 1 - 0.05 / 24 point over its 0.975 point).
constexpr double kJoint = 2.865 / 1.960;

const FittedParameter* find(const FitReport& fit, const std::string& name) {
  const auto found = std::ranges::find(fit.parameters, name, &FittedParameter::name);
  return found == fit.parameters.end() ? nullptr : &*found;
}

std::string verdict_of(const RecoveredParameter& p) {
  if (p.recovered()) return "recovered";
  return p.weak ? "not determined by these data" : "MISSED";
}

}  // namespace

bool RecoveredParameter::recovered() const {
  return std::abs(found - truth) <= std::max(half_width, kRecoveryTolerance * std::abs(truth));
}

std::vector<RecoveredParameter> compare(const LawModel& truth, const FitReport& fit) {
  const auto* found = fit.model ? model_as<LawModel>(*fit.model) : nullptr;
  std::vector<RecoveredParameter> rows;
  if (!found) return rows;

  // Both hold the same law, so its parameters are compared one by one, by coefficient.
  for (std::size_t p = 0; p < truth.law().params.size(); ++p) {
    const ParamInfo& param = truth.law().params[p];
    const Form form = found->parameters().forms[p];
    const std::vector<double>& known = truth.parameters().coefficients[p];
    for (std::size_t k = 0; k < coefficient_count(form); ++k) {
      const FittedParameter* fitted = find(fit, coefficient_name(param.name, form, k));
      if (!fitted || fitted->fixed || param.fit == Fit::Bias) continue;
      rows.push_back({fitted->name, fitted->unit, k < known.size() ? known[k] : 0, fitted->value,
                      kJoint * (fitted->high - fitted->low) / 2, fitted->weak});
    }
  }

  return rows;
}

std::string recovery_table(const std::vector<RecoveredParameter>& parameters, int width) {
  Table table({"parameter", "unit", ">true", ">found", ">+-", ">deviation %", "verdict"});
  for (const RecoveredParameter& p : parameters)
    table.row({p.name, p.unit, format_number(p.truth), format_number(p.found),
               format_number(p.half_width, 2),
               p.truth == 0 ? "" : fmt::format("{:+.2f}", 100 * (p.found / p.truth - 1)),
               verdict_of(p)});
  return table.text(static_cast<std::size_t>(width));
}

Value to_json(const std::vector<RecoveredParameter>& parameters) {
  Value list = Value::array();
  for (const RecoveredParameter& p : parameters)
    list.push_back(Value::object({{"name", p.name},
                                  {"unit", p.unit},
                                  {"truth", p.truth},
                                  {"found", p.found},
                                  {"half_width", p.half_width},
                                  {"weak", p.weak},
                                  {"recovered", p.recovered()}}));
  return list;
}

}  // namespace dashpot::cli
