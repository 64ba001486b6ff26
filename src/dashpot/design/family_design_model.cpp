#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/design/design_model.h"
#include "dashpot/error.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {
namespace {

/// N, and how far the members of an ensemble and its builds differ about it.
struct BenchForce {
  double force = 0, spread = 0;
};

/// The force as a test bench measures it: where a sine of this half stroke, which has long gone on,
/// passes the displacement at the velocity.
BenchForce force_in_sine(const FamilyModel& model, const DamperOperation& at, double half_stroke) {
  const DamperInput here{at.displacement, at.velocity, at.current};
  std::vector<double> state(model.state_size());
  if (at.velocity == 0) {
    model.rest(here, state);
  } else {
    // x = a sin(w t): a^2 = half_stroke^2 + x^2, w half_stroke = |v| at the place.
    const SteadySine sine{std::hypot(half_stroke, at.displacement),
                          std::abs(at.velocity) / half_stroke, at.current};
    model.settle(sine, std::atan2(at.displacement, std::copysign(half_stroke, at.velocity)), state);
  }
  return {model.force(here, state), model.spread(here, state)};
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

  Appraisal appraise(const DamperDescription& description,
                     const DamperOperation& operation) const override {
    // First principles give all figures but the force, and a member of the family for this
    // drawing.
    Appraisal told{.physics = evaluate_physics(description, operation)};
    const FamilyMember member = still_member(description, operation);

    // The family's force with the current and without it, along a sine of the stroke it
    // knows.
    const auto damper = family_->with_member(member);
    const double half_stroke = half_stroke_of(description);
    const BenchForce on = force_in_sine(*damper, operation, half_stroke);
    const BenchForce off = force_in_sine(*damper, without_current(operation), half_stroke);
    told.refusal = refusal_of(member, on.force, off.force, operation, half_stroke);
    if (told.refusal != Refusal::None) {
      refused_ = true;
      told.physics.force = told.physics.off_force = told.physics.dynamic_range =
          std::numeric_limits<double>::quiet_NaN();
      return told;
    }

    // The middle of its bands, and both ends.
    set_forces(on.force, off.force, told.physics);
    if (file_.interval) {
      const double side = std::copysign(1., operation.velocity);
      const double on_half = side * half_width(operation, on.spread),
                   off_half = side * half_width(without_current(operation), off.spread);
      told.weak = told.strong = told.physics;
      set_forces(on.force - on_half, off.force + off_half, *told.weak);
      const double least_off = side * std::max(0., side * (off.force - off_half));
      set_forces(on.force + on_half, least_off, *told.strong);
    }
    return told;
  }
  bool has_band() const override { return file_.interval.has_value(); }
  double force(const DamperDescription& description,
               const DamperOperation& operation) const override {
    const auto damper = family_->with_member(still_member(description, operation));
    const double spring = has_spring() && operation.displacement != 0
                              ? evaluate_physics(description, operation).spring_force
                              : 0;
    return force_in_sine(*damper, operation, half_stroke_of(description)).force + spring;
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

  bool dissipates(const DamperDescription& description, int threads) const override {
    if (family_->family().force->is_passive()) return true;
    FamilyMember member = member_of(description, current_);
    member.lag_rate = 0;  // the current stands still in every cycle
    return dissipation(*family_->with_member(member), file_.domain, threads).dissipates();
  }
  DamperOperation usual_operation() const override { return {current_, speed_}; }
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
  double half_stroke_of(const DamperDescription& description) const {
    return half_stroke_ > 0 ? half_stroke_ : 0.5 * description.stroke;
  }
  /// With the yield stress at this current and without; and without the spring, which the dynamic
  /// range leaves out.
  static FamilyMember still_member(const DamperDescription& description,
                                   const DamperOperation& operation) {
    const std::array<double, 2> currents{0, std::abs(operation.current)};
    FamilyMember member =
        member_of(description, std::span(currents).first(currents[1] > 0 ? 2 : 1));
    member.spring_stiffness = 0;
    return member;
  }
  static DamperOperation without_current(DamperOperation at) {
    at.current = 0;
    return at;
  }
  static bool resists(double force, double velocity) {
    return std::isfinite(force) && force * velocity > 0;
  }
  /// Why no damper has these: a damper resists its motion, the current takes no force away, and
  /// unless the user insists it lies not far from physics.
  Refusal refusal_of(const FamilyMember& member, double on, double off, const DamperOperation& at,
                     double half_stroke) const {
    constexpr double kRounding = 1e-9;
    if (at.velocity == 0) return Refusal::None;
    if (!resists(on, at.velocity) || !resists(off, at.velocity)) return Refusal::NoResistance;
    if (std::abs(on) < std::abs(off) * (1 - kRounding)) return Refusal::LessWithCurrent;
    return insist_ ? Refusal::None : leap_of(member, on, off, at, half_stroke);
  }

  double half_width(const DamperOperation& at, double spread) const {
    return file_.interval->half_width_at({at.displacement, at.velocity, at.current}, spread);
  }
  /// A family whose forces exclude the spring has it added from first principles.
  bool has_spring() const { return family_->family().baseline.target != FamilyTarget::Total; }
  void set_forces(double on, double off, DamperPhysics& physics) const {
    const double spring = has_spring() ? physics.spring_force : 0;
    physics.force = on + spring;
    physics.off_force = off + spring;
    physics.dynamic_range = off != 0 ? on / off : std::numeric_limits<double>::infinity();
  }

  /// Whether a force, with the current or without, or their ratio lies kMostLeap times further from
  /// the plate flow's than that of the damper with which the family's file stands, at the same
  /// place; or that damper has none there.
  Refusal leap_of(const FamilyMember& member, double on, double off, const DamperOperation& at,
                  double half_stroke) const {
    const std::optional<double> by_current = leap(member, on, at, half_stroke),
                                without = leap(member, off, without_current(at), half_stroke);
    const auto is_far = [](double times) { return times > kMostLeap || times * kMostLeap < 1; };
    if (!by_current || !without || is_far(*by_current) || is_far(*without)) return Refusal::Leap;
    return is_far(*by_current / *without) ? Refusal::RangeLeap : Refusal::None;
  }

  /// How many times further; nothing where the file's damper has no force there.
  std::optional<double> leap(const FamilyMember& member, double force, const DamperOperation& at,
                             double half_stroke) const {
    DamperOperation known = at;
    known.velocity = std::clamp(at.velocity, -speed_, speed_);
    const double own = force_of_file(known, half_stroke);
    if (!resists(own, known.velocity)) return std::nullopt;
    const double seal = 0.1 * std::abs(own);
    const auto flow = [&](const FamilyMember& of, double velocity) {
      return force_of_plate_flow(of, velocity, at.current, seal);
    };
    return std::abs(force) / flow(member, at.velocity) /
           (std::abs(own) / flow(family_->member(), known.velocity));
  }

  /// That of the damper with which the family's file stands. A request has few operating points,
  /// which every design is asked at: what was last told of them is kept.
  double force_of_file(const DamperOperation& at, double half_stroke) const {
    constexpr std::size_t kMost = 64;
    const std::array<double, 4> place{at.current, at.velocity, at.displacement, half_stroke};
    const std::lock_guard lock(kept_guard_);
    if (const auto kept = kept_.find(place); kept != kept_.end()) return kept->second;
    if (kept_.size() >= kMost) kept_.clear();
    return kept_[place] = force_in_sine(*family_, at, half_stroke).force;
  }

  std::shared_ptr<const FamilyModel> drawn(const DamperDescription& description) const {
    const std::array<double, 2> currents{0, current_};
    return family_->with_member(
        member_of(description, std::span(currents).first(current_ > 0 ? 2 : 1)));
  }

  ModelFile file_;
  std::unique_ptr<FamilyModel> family_;
  double half_stroke_ = 0, current_ = 0, speed_ = 0;
  bool insist_ = false;
  mutable std::atomic<bool> refused_ = false;
  mutable std::mutex kept_guard_;
  mutable std::map<std::array<double, 4>, double> kept_;
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
