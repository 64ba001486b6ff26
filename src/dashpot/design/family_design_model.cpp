#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/design/design_model.h"
#include "dashpot/error.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {
namespace {

/// The force as a test bench measures it: where a sine of this half stroke passes the displacement
/// at the velocity, started from rest one cycle and more before, so that a model with states has
/// seen a motion of its kind.
double force_in_sine(const DamperModel& model, const DamperOperation& at, double half_stroke) {
  constexpr double kPi = std::numbers::pi;
  constexpr int kSteps = 100;  // of a cycle
  std::vector<double> state(model.state_size());
  DamperInput now{at.displacement, at.velocity, at.current};
  model.rest(now, state);
  if (state.empty() || at.velocity == 0) return model.force(now, state);
  // x = a sin(w t): a^2 = half_stroke^2 + x^2, w half_stroke = |v| at the end.
  const double amplitude = std::hypot(half_stroke, at.displacement);
  const double rate = std::abs(at.velocity) / half_stroke;
  const double end = std::atan2(at.displacement, std::copysign(half_stroke, at.velocity));
  const double begin = std::copysign(0.5 * kPi, -at.velocity) - 2 * kPi;  // a turn
  const int steps = static_cast<int>(std::ceil((end - begin) / (2 * kPi) * kSteps));
  const double step = (end - begin) / steps;
  const auto input_at = [&](double phase) {
    return DamperInput{amplitude * std::sin(phase), amplitude * rate * std::cos(phase), at.current};
  };
  now = input_at(begin);
  model.rest(now, state);
  for (int k = 1; k <= steps; ++k) {
    const DamperInput next = input_at(begin + k * step);
    model.advance(now, next, step / rate, state);
    now = next;
  }
  return model.force(now, state);
}

/// Plate flow of a member and the friction of a seal, N, at an instant: what every member's force
/// is held against. The seal is in both, so that a fluid without yield stress leaves no 0.
double force_of_plate_flow(const FamilyMember& m, double velocity, double current, double seal) {
  const PlateGap gap{m.pole_length, m.gap_area / m.gap, m.gap};
  const double newtonian =
      m.piston_area *
      plate_newtonian_pressure(&gap, m.viscosity, m.piston_area * std::abs(velocity));
  const double yielding = m.piston_area * plate_yield_pressure(&gap, m.yield.at(current));
  return seal + plate_bingham_pressure(newtonian, yielding);
}

class FamilyDesignModel final : public DesignModel {
 public:
  FamilyDesignModel(ModelFile file, bool insist) : file_(std::move(file)), insist_(insist) {
    family_ = model_as<FamilyModel>(*file_.model)->with_outside(OutsideFamily::Mark);
    const Domain& d = file_.domain;
    half_stroke_ = 0.5 * (d.displacement_max - d.displacement_min);
    current_ = std::max(std::abs(d.current_min), std::abs(d.current_max));
    speed_ = std::max(std::abs(d.velocity_min), std::abs(d.velocity_max));
  }

  std::string name() const override { return family_->name(); }

  DamperPhysics evaluate(const DamperDescription& description,
                         const DamperOperation& operation) const override {
    // First principles give all figures but the force, and a member of the family for this
    // drawing.
    DamperPhysics physics = evaluate_physics(description, operation);
    const std::array<double, 2> currents{0, std::abs(operation.current)};
    FamilyMember member =
        member_of(description, std::span(currents).first(currents[1] > 0 ? 2 : 1));
    member.spring_stiffness = 0;  // which the dynamic range leaves out

    // The family's force with the current and without it, along a sine of the stroke it
    // knows.
    const auto damper = family_->with_member(member);
    const double half_stroke = half_stroke_ > 0 ? half_stroke_ : 0.5 * description.stroke;
    const double force = force_in_sine(*damper, operation, half_stroke);
    const double off =
        force_in_sine(*damper, {0, operation.velocity, operation.displacement}, half_stroke);

    // A family whose forces exclude the spring has it added from first principles.
    const bool has_spring = family_->family().baseline.target != FamilyTarget::Total;
    const double spring = has_spring ? physics.spring_force : 0;
    physics.force = force + spring;
    physics.off_force = off + spring;
    physics.dynamic_range = off != 0 ? force / off : std::numeric_limits<double>::infinity();

    // A damper resists its motion; and a fitted model may not leap where physics does not.
    if (!resists(force, operation.velocity) || !resists(off, operation.velocity) ||
        (!insist_ && (leaps(*damper, force, operation, operation.current, half_stroke) ||
                      leaps(*damper, off, operation, 0, half_stroke)))) {
      refused_ = true;
      physics.force = physics.off_force = physics.dynamic_range =
          std::numeric_limits<double>::quiet_NaN();
    }
    return physics;
  }
  bool has_refused() const override { return refused_; }

  bool is_fitted() const override { return true; }
  double outside(const DamperDescription& description) const override {
    return drawn(description)->extrapolation();
  }
  std::vector<std::string> extrapolations(const DamperDescription& description) const override {
    return drawn(description)->extrapolations();
  }

  std::vector<std::string> extrapolations(const DamperOperation& at) const override {
    constexpr double kMargin = 1.01;  // rounding and noise are no extrapolation
    std::vector<std::string> outside;
    const auto look = [&](const char* what, const char* unit, double asked, double known) {
      if (std::abs(asked) > kMargin * known)
        outside.push_back(name() + " knows a " + what + " up to " + format_number(known) + " " +
                          unit + ", not of " + format_number(std::abs(asked)) + " " + unit);
    };
    look("current", "A", at.current, current_);
    look("velocity", "m/s", at.velocity, speed_);
    return outside;
  }

  std::optional<ModelFile> model_of(const DamperDescription& description) const override {
    ModelFile made;
    made.model = family_->with_member(member_of(description, current_))->with_offset(0);
    made.drive_unit = file_.drive_unit;
    made.sample_time = file_.sample_time;
    made.domain = file_.domain;
    made.provenance = file_.provenance;
    made.quality = file_.quality;
    made.interval = file_.interval;
    return made;
  }

 private:
  static bool resists(double force, double velocity) {
    return velocity == 0 || (std::isfinite(force) && force * velocity > 0);
  }

  /// Whether this force lies kMostLeap times further from the plate flow's than that of the damper
  /// with which the family's file stands, at the same place.
  bool leaps(const FamilyModel& damper, double force, const DamperOperation& at, double current,
             double half_stroke) const {
    if (at.velocity == 0) return false;
    const double known = std::clamp(at.velocity, -speed_, speed_);
    const double own = force_in_sine(*family_, {current, known, at.displacement}, half_stroke);
    if (!resists(own, known)) return false;
    const double seal = 0.1 * std::abs(own);
    const double share =
        std::abs(force) / force_of_plate_flow(damper.member(), at.velocity, current, seal);
    const double usual =
        std::abs(own) / force_of_plate_flow(family_->member(), known, current, seal);
    return share > kMostLeap * usual || share * kMostLeap < usual;
  }

  std::shared_ptr<const FamilyModel> drawn(const DamperDescription& description) const {
    constexpr std::array<double, 1> kNoCurrent{0};
    return family_->with_member(member_of(description, kNoCurrent));
  }

  ModelFile file_;
  std::unique_ptr<FamilyModel> family_;
  double half_stroke_ = 0, current_ = 0, speed_ = 0;
  bool insist_ = false;
  mutable std::atomic<bool> refused_ = false;
};

}  // namespace

std::unique_ptr<DesignModel> load_family_design_model(const std::filesystem::path& path,
                                                      bool insist) {
  ModelFile file = load_model(path);
  if (!model_as<FamilyModel>(*file.model))
    throw Error(path.string(), "is a model of one damper, not of a family",
                "a file that 'dashpot identify --models family' wrote");
  if (file.drive_unit != DriveUnit::Ampere)
    throw Error(path.string(), "is driven by " + to_string(file.drive_unit),
                "a family of coils whose current is known");
  return std::make_unique<FamilyDesignModel>(std::move(file), insist);
}

}  // namespace dashpot
