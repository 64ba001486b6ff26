#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/value.h"

namespace dashpot {

struct DamperDescription;

/// Yield stress of a fluid over the coil's current: straight between the points, held beyond them.
/// One point: the same at any current. Even in the current.
struct YieldCurve {
  std::vector<double> currents;  ///< A, ascending, from 0 on
  std::vector<double> stresses;  ///< Pa
  double at(double current) const noexcept;
  double greatest() const noexcept;
};

/// One damper of a family, as the records' conditions state it. SI.
struct FamilyMember {
  double piston_area = 0, gap_area = 0;  ///< m^2
  double gap = 0, pole_length = 0;       ///< m
  double viscosity = 0;                  ///< Pa*s
  double spring_stiffness = 0;           ///< N/m
  double build = 0;                      ///< standard deviations from the mean build of this design
  double lag_rate = 0;  ///< 1/s, at which the coil's current follows its command; 0: at once
  YieldCurve yield;
};

/// One row of the table that names a member's numbers; the yield stress, a curve, stands beside it.
struct MemberField {
  std::string_view name, unit;
  double FamilyMember::* field;
  bool required;  ///< and positive
};
std::span<const MemberField> member_fields();
constexpr std::string_view kYieldStress = "yield_stress";  ///< Pa, a condition of each record
/// The number of a build among those of its drawing, a condition of a record; without it one build.
constexpr std::string_view kSpecimen = "specimen";

const double* find_condition(const Conditions& conditions, std::string_view name);

/// The member with the values that the conditions have in place of its own; other conditions are
/// passed over. Throws Error(where, ...) at one that cannot be.
FamilyMember with_conditions(FamilyMember member, const Conditions& conditions,
                             const std::string& where);
/// Throws Error(where, "has no condition 'gap', which ...") unless the conditions state a whole
/// member.
void require_member(const Conditions& conditions, const std::string& where);

/// The member that a drawing, a coil and a fluid make, with its yield stress up to a current, A,
/// and the lag of its coil there; or with the yield stress at these, ascending from 0 on, and no
/// lag.
FamilyMember member_of(const DamperDescription& description, double largest_current);
FamilyMember member_of(const DamperDescription& description, std::span<const double> currents);

/// In words: "piston_area 0.00016 m^2, ..., yield stress 0 to 2.265e+04 Pa, build 0".
std::string describe(const FamilyMember& member);

Value to_json(const FamilyMember& member);
FamilyMember read_member(const Value& value);

}  // namespace dashpot
