#pragma once
#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/damper_model.h"
#include "dashpot/physics/damper_description.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {

/// What sets one build of a drawn damper apart from others.
struct DrawnBuild {
  double strength = 1;   ///< times which the force of the flow is
  double friction = 0;   ///< N, of the seals; sets in as tanh(v / 1 mm/s)
  double stiffness = 0;  ///< N/m, of the spring in series with the flow
  double asymmetry = 0;  ///< share by which the flow resists extension more, and compression less
};

/// A damper as it is drawn and built, for a virtual bench: exact plate flow of its fluid, Bingham
/// or Herschel-Bulkley, through the gap with field and the one without, in series with a spring;
/// seal friction and the drawing's spring beside. It is of no fitted model's structure and has no
/// model file. Its one state is the force of the series spring, N.
class DrawnDamper final : public DamperModel {
 public:
  /// largest_current: A, up to which the yield stress is looked up; held beyond. Throws Error where
  /// the yield stress is a number, or the stiffness is not positive.
  DrawnDamper(const DamperDescription& drawing, const DrawnBuild& build, double largest_current);

  ModelKind kind() const override { return ModelKind::Other; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return member_.spring_stiffness > 0; }
  std::size_t parameter_count() const noexcept override { return 0; }
  std::size_t state_size() const noexcept override { return 1; }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool flows() const noexcept override { return true; }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  /// N, what the flow resists a steady speed >= 0 with.
  double flow_force(double speed, double current) const noexcept;

 private:
  std::string name_;
  FamilyMember member_;
  DrawnBuild build_;
  PlateGap active_{}, passive_{};
  double index_ = 1, consistency_ = 0, offset_ = 0;
};

}  // namespace dashpot
