#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/error.h"

namespace dashpot {
namespace {

void require_at_most(std::size_t count, std::size_t most, const std::string& what,
                     const std::string& where) {
  if (count < 1 || count > most)
    throw Error(where, "has " + std::to_string(count) + " " + what, "1 to " + std::to_string(most));
}

void require_inputs(const Sugeno& sugeno, const std::string& where) {
  for (const Sugeno::Input& input : sugeno.inputs) {
    if (!(input.scale > 0 && std::isfinite(input.scale)))
      throw Error(where, "the scale of an input is not a positive number");
    if (!(input.low <= input.high)) throw Error(where, "the range of an input does not go upwards");
  }
  if (!(sugeno.output_scale > 0 && std::isfinite(sugeno.output_scale)))
    throw Error(where, "the scale of the output is not a positive number");
}

void require_memberships(const Sugeno& sugeno, const std::string& where) {
  for (const Membership& m : sugeno.memberships) {
    if (m.input >= sugeno.inputs.size())
      throw Error(where, "a membership is of input " + std::to_string(m.input),
                  "inputs are counted from 0 to " + std::to_string(sugeno.inputs.size() - 1));
    if (!(m.width > 0)) throw Error(where, "a membership's width is not a positive number");
    if (m.shape == Membership::Shape::Bell && !(m.slope > 0))
      throw Error(where, "a bell's slope is not a positive number");
  }
}

void require_rules(const Sugeno& sugeno, const std::string& where) {
  for (const std::vector<std::size_t>& rule : sugeno.rules) {
    require_at_most(rule.size(), Sugeno::kMaxTerms, "memberships in a rule", where);
    for (const std::size_t m : rule)
      if (m >= sugeno.memberships.size())
        throw Error(
            where, "a rule has membership " + std::to_string(m),
            "memberships are counted from 0 to " + std::to_string(sugeno.memberships.size() - 1));
  }
  if (sugeno.consequents.size() != sugeno.consequent_count())
    throw Error(where, "has " + std::to_string(sugeno.consequents.size()) + " consequents",
                "these rules need " + std::to_string(sugeno.consequent_count()) +
                    ": a slope per input and a constant for each");
}

void require_sound(const Sugeno& sugeno, std::size_t inputs, const std::string& where) {
  require_at_most(inputs, Sugeno::kMaxInputs, "inputs", where);
  require_at_most(sugeno.memberships.size(), Sugeno::kMaxMemberships, "memberships", where);
  require_at_most(sugeno.rules.size(), Sugeno::kMaxRules, "rules", where);
  if (sugeno.inputs.size() != inputs)
    throw Error(where, "the scales of the inputs are not one per input");
  require_inputs(sugeno, where);
  require_memberships(sugeno, where);
  require_rules(sugeno, where);
}

}  // namespace

FuzzyModel::FuzzyModel(std::string name, FuzzyInputs inputs, Sugeno sugeno, double offset,
                       const std::string& where)
    : name_(std::move(name)),
      inputs_(std::move(inputs)),
      sugeno_(std::move(sugeno)),
      offset_(offset) {
  require_sound(sugeno_, inputs_.names().size(), where.empty() ? name_ : where);
}

double FuzzyModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  std::array<double, Sugeno::kMaxInputs> raw;
  inputs_.read(input, state, raw.data());
  return sugeno_.evaluate(raw.data()) + offset_;
}

std::unique_ptr<DamperModel> FuzzyModel::with_offset(double newton) const {
  return std::make_unique<FuzzyModel>(name_, inputs_, sugeno_, offset_ + newton);
}

}  // namespace dashpot
