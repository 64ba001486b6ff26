#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/family/family_baseline.h"
#include "dashpot/damper/kinds/family/family_force.h"

namespace dashpot {

/// Whether a member outside the numbers that its family was fitted on is marked or refused.
enum class OutsideFamily { Mark, Refuse };

/// The part of a model that all members of a family share.
struct Family {
  struct Range {
    double FamilyMember::* field;
    double min = 0, max = 0;
    /// Distance by which a value lies outside; negative within, 0 at an end but for rounding.
    double excess(double value) const noexcept;
  };
  std::string name;
  std::shared_ptr<const FamilyForce> force;
  FamilyBaseline baseline;
  /// Standard deviation of the force of builds of one drawing, as a share; with what the family
  /// gets wrong of a drawing in it, where no repeated build tells the two apart.
  double build_spread = 0;
  double drawing_spread = 0;  ///< the same of what it gets wrong, where builds tell it apart
  std::vector<Range> domain;  ///< of the dampers that it was fitted on: each required field
  /// Pa, of their yield stresses, without a field; none in files of earlier versions.
  std::optional<Range> yield;
  OutsideFamily outside = OutsideFamily::Mark;
};

/// A member of a family of dampers: force = (1 + build_spread build) (first principles + learned
/// part) + offset. What simulates it sees one damper; specialised() gives another one of the
/// family.
class FamilyModel final : public DamperModel {
 public:
  FamilyModel(std::shared_ptr<const Family> family, FamilyMember member, double offset = 0);

  ModelKind kind() const override { return ModelKind::Family; }
  std::string name() const override { return family_->name; }
  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override {
    return family_->force->parameter_count();
  }
  /// The states of the family's force, and of a coil that lags its current, A.
  std::size_t state_size() const noexcept override {
    return family_->force->state_size() + (member_.lag_rate > 0 ? 1 : 0);
  }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  /// The states where a sine that has long gone on passes a phase.
  void settle(const SteadySine& sine, double phase, std::span<double> state) const;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool flows() const noexcept override { return family_->force->flows(); }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  /// The spread is that of new dampers of this design, and of the networks about their mean.
  bool is_ensemble() const noexcept override;
  double spread(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;
  /// Throws Error where such a member is outside the family, and that is to be refused.
  std::shared_ptr<const DamperModel> specialised(const Conditions& conditions) const override;
  std::vector<std::string> extrapolations() const override;
  /// The distance by which this damper lies outside of the family, in shares of its ranges; within
  /// negative: how far the nearest end is, those left out at which it lies.
  double extrapolation() const noexcept;

  const Family& family() const { return *family_; }
  const FamilyMember& member() const { return member_; }
  double offset() const { return offset_; }
  double strength() const { return strength_; }  ///< times which the force is, by its build
  /// Another member, as specialised().
  std::shared_ptr<const FamilyModel> with_member(const FamilyMember& member) const;
  std::unique_ptr<FamilyModel> with_outside(OutsideFamily outside) const;
  /// The same damper whose coil follows its command at once.
  std::unique_ptr<FamilyModel> without_lag() const;

 private:
  /// The input with the current that flows in the coil.
  DamperInput in_coil(const DamperInput& input, std::span<const double> state) const noexcept;
  /// Pa, by which the greatest yield stress lies outside of the family's; as of Range::excess.
  double yield_excess() const noexcept;
  /// N, of the mean build, before the offset; the input is that of the coil.
  double nominal_force(const DamperInput& input, std::span<const double> state) const noexcept;

  std::shared_ptr<const Family> family_;
  FamilyMember member_;
  std::shared_ptr<const MemberSteps> steps_;
  double offset_, strength_;
};

std::unique_ptr<FamilyModel> family_model_from_json(const Value& value);

}  // namespace dashpot
