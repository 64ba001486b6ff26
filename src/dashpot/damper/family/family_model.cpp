#include "dashpot/damper/family/family_model.h"

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {

FamilyModel::FamilyModel(std::shared_ptr<const Family> family, FamilyMember member, double offset)
    : family_(std::move(family)),
      member_(std::move(member)),
      offset_(offset),
      strength_(1 + family_->build_spread * member_.build) {}

bool FamilyModel::needs_displacement() const noexcept {
  return family_->force->needs_displacement() ||
         (family_->baseline.target != FamilyTarget::Total && member_.spring_stiffness != 0);
}

void FamilyModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  family_->force->rest(input, state);
}

void FamilyModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                          std::span<double> state) const noexcept {
  family_->force->advance(from, to, dt, state);
}

double FamilyModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  const double sum = family_->baseline.force(member_, input) + family_->force->force(member_, input, state);
  return strength_ * sum + offset_;
}

std::unique_ptr<DamperModel> FamilyModel::with_offset(double newton) const {
  return std::make_unique<FamilyModel>(family_, member_, offset_ + newton);
}

std::shared_ptr<const FamilyModel> FamilyModel::with_member(const FamilyMember& member) const {
  auto model = std::make_shared<const FamilyModel>(family_, member, offset_);
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

std::shared_ptr<const DamperModel> FamilyModel::specialised(const Conditions& conditions) const {
  bool any = find_condition(conditions, kYieldStress) != nullptr;
  for (const MemberField& field : member_fields()) any = any || find_condition(conditions, field.name);
  return any ? with_member(with_conditions(member_, conditions, name())) : nullptr;
}

std::vector<std::string> FamilyModel::extrapolations() const {
  constexpr double kRounding = 1e-6;
  std::vector<std::string> outside;
  for (const Family::Range& range : family_->domain) {
    const double value = member_.*range.field;
    if (value >= range.min * (1 - kRounding) && value <= range.max * (1 + kRounding)) continue;
    for (const MemberField& field : member_fields())
      if (field.field == range.field)
        outside.push_back(std::string(field.name) + " is " + format_number(value) + " " +
                          std::string(field.unit) + ", the family has " + format_number(range.min) + " to " +
                          format_number(range.max));
  }
  return outside;
}

}  // namespace dashpot
