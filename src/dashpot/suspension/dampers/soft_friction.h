#pragma once
#include <cmath>
#include <memory>

#include "dashpot/damper/kinds/law/law_model.h"

namespace dashpot {

/// No integrator meets its tolerance where friction jumps as the motion turns, and a car chatters
/// about a middle of the stroke at which the force jumps: the force changes over this speed, or
/// over this way to both sides, instead.
constexpr double kFrictionSpeed = 2e-3;  // m/s
constexpr double kSideWay = 2e-4;        // m

/// Where one input of a damper is within `reach` of 0, its force is a straight line between those
/// at both ends.
struct SoftMiddle {
  double DamperInput::* input = nullptr;
  double reach = 0;

  bool has(const DamperInput& at) const noexcept { return std::abs(at.*input) < reach; }
  /// The force at a place within, from force_at(place).
  template <class ForceAt>
  double between_ends(DamperInput at, ForceAt force_at) const noexcept {
    const double share = 0.5 + 0.5 * at.*input / reach;
    at.*input = -reach;
    const double before = force_at(at);
    at.*input = reach;
    return before + share * (force_at(at) - before);
  }
};

/// A damper that is a law, without a lag of its own, perhaps with a soft middle.
struct SoftLaw {
  const LawModel* law = nullptr;  ///< null: it is something else
  bool is_soft = false;
  SoftMiddle middle{};

  /// DamperModel::flow() with the law's parameters at the input's current.
  [[gnu::always_inline]] inline double flow(const double* parameters, const DamperInput& input,
                                            const double* state, double* rates) const noexcept {
    const double force = law->flow(parameters, input, state, rates);
    return is_soft && middle.has(input) ? in_middle(parameters, input, state) : force;
  }
  double in_middle(const double* parameters, const DamperInput& input,
                   const double* state) const noexcept;
};
/// A model as such a law.
SoftLaw soft_law(const DamperModel& model);

/// Whether the model's force jumps where the velocity passes 0, at the ends or in the middle of a
/// range of currents.
bool jumps_at_rest(const DamperModel& model, double current_min, double current_max);
/// Likewise where the displacement passes 0.
bool jumps_in_middle(const DamperModel& model, double current_min, double current_max);

/// The same model, its force within kFrictionSpeed of rest a straight line between those at its
/// ends.
std::shared_ptr<const DamperModel> with_soft_friction(std::shared_ptr<const DamperModel> model);
/// Likewise within kSideWay of the middle.
std::shared_ptr<const DamperModel> with_soft_sides(std::shared_ptr<const DamperModel> model);

}  // namespace dashpot
