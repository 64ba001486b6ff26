#include "dashpot/damper/kinds/family/family_member.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/physics/damper_physics.h"

namespace dashpot {
namespace {

constexpr MemberField kFields[] = {
    {"piston_area", "m^2", &FamilyMember::piston_area, true},
    {"gap_area", "m^2", &FamilyMember::gap_area, true},
    {"gap", "m", &FamilyMember::gap, true},
    {"pole_length", "m", &FamilyMember::pole_length, true},
    {"viscosity", "Pa*s", &FamilyMember::viscosity, true},
    {"spring_stiffness", "N/m", &FamilyMember::spring_stiffness, false},
    {"build", "1", &FamilyMember::build, false}};

void require_value(const MemberField& field, double value, const std::string& where) {
  if (!(std::isfinite(value) && (!field.required || value > 0)))
    throw Error(where, std::string(field.name) + " is " + format_number(value),
                field.required ? "a positive number, " + std::string(field.unit) : "a number");
  // What a drawing may not have no damper of a family has: a gap of 1.2 was written in mm.
  if (field.required) require_within(value, find_description_field(field.name, where), where);
}

void require_curve(const YieldCurve& yield, const std::string& where) {
  if (yield.currents.empty() || yield.currents.size() != yield.stresses.size())
    throw Error(where, "the yield stresses are not one per current");
  for (std::size_t k = 0; k < yield.currents.size(); ++k) {
    if (!(yield.stresses[k] >= 0 && std::isfinite(yield.stresses[k])))
      throw Error(where, "a yield stress of " + format_number(yield.stresses[k]) + " Pa",
                  "0 or more");
    if (!(yield.currents[k] >= (k ? yield.currents[k - 1] : 0.0) &&
          std::isfinite(yield.currents[k])))
      throw Error(where, "the currents of the yield stresses do not go upwards from 0");
  }
}

}  // namespace

double YieldCurve::at(double current) const noexcept {
  const double i = std::abs(current);
  const auto above = std::upper_bound(currents.begin(), currents.end(), i);
  if (above == currents.begin()) return stresses.front();
  if (above == currents.end()) return stresses.back();
  const auto k = static_cast<std::size_t>(above - currents.begin());
  const double share = (i - currents[k - 1]) / (currents[k] - currents[k - 1]);
  return stresses[k - 1] + share * (stresses[k] - stresses[k - 1]);
}

double YieldCurve::greatest() const noexcept { return *std::ranges::max_element(stresses); }

std::span<const MemberField> member_fields() { return kFields; }

const double* find_condition(const Conditions& conditions, std::string_view name) {
  for (const auto& [key, value] : conditions)
    if (key == name) return &value;
  return nullptr;
}

FamilyMember with_conditions(FamilyMember member, const Conditions& conditions,
                             const std::string& where) {
  for (const MemberField& field : kFields) {
    const double* value = find_condition(conditions, field.name);
    if (!value) continue;
    require_value(field, *value, where);
    member.*field.field = *value;
  }
  if (const double* stress = find_condition(conditions, kYieldStress)) {
    member.yield = {{0}, {*stress}};
    require_curve(member.yield, where);
  }
  return member;
}

void require_member(const Conditions& conditions, const std::string& where) {
  const auto require = [&](std::string_view name, std::string_view unit) {
    if (!find_condition(conditions, name))
      throw Error(
          where, "has no condition '" + std::string(name) + "', which a model of a family needs",
          "state it in " + std::string(unit) + " in the dataset file, or leave this model out");
  };
  for (const MemberField& field : kFields)
    if (field.required) require(field.name, field.unit);
  require(kYieldStress, "Pa");
}

FamilyMember member_of(const DamperDescription& description, double largest_current) {
  constexpr int kPoints = 32;
  std::vector<double> currents;
  for (int k = 0; k <= kPoints; ++k) currents.push_back(largest_current * k / kPoints);
  FamilyMember member = member_of(description, currents);
  if (largest_current > 0)
    member.lag_rate = 1 / evaluate_physics(description, {.current = largest_current}).time_constant;
  return member;
}

FamilyMember member_of(const DamperDescription& description, std::span<const double> currents) {
  const DamperPhysics physics = evaluate_physics(description, {});
  FamilyMember member;
  member.piston_area = physics.piston_area;
  member.gap_area = physics.gap_area;
  member.gap = description.gap;
  member.pole_length = description.pole_length;
  member.viscosity = physics.viscosity;
  member.spring_stiffness = physics.spring_stiffness;
  for (const double current : currents) {
    member.yield.currents.push_back(current);
    member.yield.stresses.push_back(fluid_state(description, current).yield_stress);
  }
  return member;
}

std::string describe(const FamilyMember& member) {
  std::string text;
  for (const MemberField& field : kFields)
    if (field.required)
      text += std::string(field.name) + " " + format_number(member.*field.field) + " " +
              std::string(field.unit) + ", ";
  const std::vector<double>& stresses = member.yield.stresses;
  text += "yield stress " + format_number(stresses.front()) +
          (stresses.size() > 1 ? " to " + format_number(stresses.back()) : "") + " Pa, build " +
          format_number(member.build);
  return member.lag_rate > 0
             ? text + ", coil lag " + format_number(1e3 / member.lag_rate, 4) + " ms"
             : text;
}

Value to_json(const FamilyMember& member) {
  Value value = Value::object();
  for (const MemberField& field : kFields) value.add(std::string(field.name), member.*field.field);
  value.add("yield_currents", Value::array(member.yield.currents));
  value.add("yield_stresses", Value::array(member.yield.stresses));
  if (member.lag_rate > 0) value.add("lag_rate", member.lag_rate);
  return value;
}

FamilyMember read_member(const Value& value) {
  ObjectReader reader(value, "a member of a family");
  FamilyMember member;
  for (const MemberField& field : kFields) {
    member.*field.field = reader.number(field.name);
    require_value(field, member.*field.field, value.where());
  }
  member.yield = {reader.required("yield_currents").as_numbers(),
                  reader.required("yield_stresses").as_numbers()};
  member.lag_rate = reader.number("lag_rate", 0);
  if (!(member.lag_rate >= 0 && std::isfinite(member.lag_rate)))
    throw Error(value.where(), "lag_rate is " + format_number(member.lag_rate), "0 or more, 1/s");
  reader.finish();
  require_curve(member.yield, value.where());
  return member;
}

}  // namespace dashpot
