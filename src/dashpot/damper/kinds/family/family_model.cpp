#include "dashpot/damper/kinds/family/family_model.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/c_text/lag.h"
#include "dashpot/error.h"

namespace dashpot {

FamilyModel::FamilyModel(std::shared_ptr<const Family> family, FamilyMember member, double offset)
    : family_(std::move(family)),
      member_(std::move(member)),
      steps_(family_->force->steps_of(member_)),
      offset_(offset),
      strength_(1 + family_->build_spread * member_.build) {}

bool FamilyModel::needs_displacement() const noexcept {
  return family_->force->needs_displacement() ||
         (family_->baseline.target != FamilyTarget::Total && member_.spring_stiffness != 0);
}

void FamilyModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  family_->force->rest(input, state.first(family_->force->state_size()));
  if (member_.lag_rate > 0) state[family_->force->state_size()] = input.current;
}

DamperInput FamilyModel::in_coil(const DamperInput& input,
                                 std::span<const double> state) const noexcept {
  DamperInput coil = input;
  if (member_.lag_rate > 0) coil.current = state[family_->force->state_size()];
  return coil;
}

void FamilyModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                          std::span<double> state) const noexcept {
  const std::size_t own = family_->force->state_size();
  const DamperInput before = in_coil(from, state);
  if (member_.lag_rate > 0 && dt > 0)
    state[own] = lag_after(state[own], from.current, to.current, member_.lag_rate * dt);
  const DamperInput after = in_coil(to, state);
  if (steps_)
    steps_->advance(before, after, dt, state.first(own));
  else
    family_->force->advance(member_, before, after, dt, state.first(own));
}

void FamilyModel::settle(const SteadySine& sine, double phase, std::span<double> state) const {
  const std::size_t own = family_->force->state_size();
  family_->force->settle(member_, sine, phase, state.first(own));
  if (member_.lag_rate > 0) state[own] = sine.current;
}

double FamilyModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  return strength_ * nominal_force(in_coil(input, state), state) + offset_;
}

double FamilyModel::nominal_force(const DamperInput& input,
                                  std::span<const double> state) const noexcept {
  return family_->baseline.force(member_, input) + family_->force->force(member_, input, state);
}

bool FamilyModel::is_ensemble() const noexcept {
  return family_->build_spread > 0 || family_->drawing_spread > 0 || family_->force->is_ensemble();
}

double FamilyModel::flow(const DamperInput& input, std::span<const double> state,
                         std::span<double> rates) const noexcept {
  const std::size_t own = family_->force->state_size();
  family_->force->flow(in_coil(input, state), state.first(own), rates.first(own));
  if (member_.lag_rate > 0) rates[own] = member_.lag_rate * (input.current - state[own]);
  return force(input, state);
}

double FamilyModel::spread(const DamperInput& input, std::span<const double> state) const noexcept {
  const DamperInput coil = in_coil(input, state);
  return std::hypot(
      std::hypot(family_->build_spread, family_->drawing_spread) * nominal_force(coil, state),
      strength_ * family_->force->spread(member_, coil));
}

std::unique_ptr<DamperModel> FamilyModel::with_offset(double newton) const {
  return std::make_unique<FamilyModel>(family_, member_, offset_ + newton);
}

std::shared_ptr<const FamilyModel> FamilyModel::with_member(const FamilyMember& member) const {
  auto model = std::make_shared<const FamilyModel>(family_, member, offset_);
  if (!(model->strength() > 0))
    throw Error(name(),
                "a build of " + format_number(member.build) +
                    " standard deviations would have no force, or push where the others brake",
                "more than " + format_number(-1 / family_->build_spread));
  if (family_->outside == OutsideFamily::Refuse)
    if (const std::vector<std::string> outside = model->extrapolations(); !outside.empty())
      throw Error(name(), "cannot tell of this damper: " + join(outside, "; "),
                  "a member within the family, or a model that marks what lies outside");
  return model;
}

std::unique_ptr<FamilyModel> FamilyModel::with_outside(OutsideFamily outside) const {
  auto family = std::make_shared<Family>(*family_);
  family->outside = outside;
  return std::make_unique<FamilyModel>(std::move(family), member_, offset_);
}

std::unique_ptr<FamilyModel> FamilyModel::without_lag() const {
  FamilyMember member = member_;
  member.lag_rate = 0;
  return std::make_unique<FamilyModel>(family_, member, offset_);
}

std::shared_ptr<const DamperModel> FamilyModel::specialised(const Conditions& conditions) const {
  bool any = find_condition(conditions, kYieldStress) != nullptr;
  for (const MemberField& field : member_fields())
    any = any || find_condition(conditions, field.name);
  return any ? with_member(with_conditions(member_, conditions, name())) : nullptr;
}

double Family::Range::excess(double value) const noexcept {
  constexpr double kRounding = 1e-6;
  const double beyond = std::max(min - value, value - max);
  return std::abs(beyond) <= kRounding * max ? 0 : beyond;
}

double FamilyModel::yield_excess() const noexcept {
  // The current's noise makes the largest of a recording larger than that of its yield stress.
  constexpr double kNoise = 0.05;
  if (!family_->yield) return 0;
  const Family::Range& known = *family_->yield;
  const double greatest = member_.yield.greatest();
  const bool is_noise = greatest > known.max && greatest <= (1 + kNoise) * known.max;
  return is_noise ? 0 : known.excess(greatest);
}

double FamilyModel::extrapolation() const noexcept {
  double most = -1;
  bool any = false;
  if (const double beyond = yield_excess(); beyond != 0) {
    const auto& [field, min, max] = *family_->yield;
    most = std::max(most, beyond / std::max(max > min ? max - min : max, 1.));
    any = true;
  }
  for (const Family::Range& range : family_->domain) {
    const double beyond = range.excess(member_.*range.field);
    if (beyond == 0) continue;
    most = std::max(most, beyond / (range.max > range.min ? range.max - range.min : range.max));
    any = true;
  }
  return any ? most : 0;
}

std::vector<std::string> FamilyModel::extrapolations() const {
  std::vector<std::string> outside;
  const auto add = [&](std::string_view name, std::string_view unit, double value,
                       const Family::Range& range) {
    outside.push_back(std::string(name) + " is " + format_number(value) + " " + std::string(unit) +
                      ", the family has " + format_number(range.min) + " to " +
                      format_number(range.max));
  };
  for (const Family::Range& range : family_->domain) {
    const double value = member_.*range.field;
    if (range.excess(value) <= 0) continue;
    for (const MemberField& field : member_fields())
      if (field.field == range.field) add(field.name, field.unit, value, range);
  }
  if (yield_excess() > 0) add(kYieldStress, "Pa", member_.yield.greatest(), *family_->yield);

  // A build has no range but that of chance, and counts where the family knows of builds.
  constexpr double kOneInHundred = 2.58;  // standard deviations, to either side
  if (family_->build_spread > 0 && std::abs(member_.build) > kOneInHundred)
    outside.push_back("build is " + format_number(member_.build) +
                      " standard deviations, not one build in a hundred lies beyond " +
                      format_number(kOneInHundred));
  return outside;
}

}  // namespace dashpot
