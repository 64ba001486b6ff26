#pragma once
#include "dashpot/damper_model.h"
#include "dashpot/mounted_damper.h"
#include "dashpot/suspension/bound/force_range.h"

namespace dashpot {

/// The damper that a range describes, without memory. Its current is the share, 0 softest ... 1
/// hardest, of the way through the range; where the damper behind it cannot reach that force, it
/// gives the nearest one that it can.
class RangeDamper final : public DamperModel {
 public:
  explicit RangeDamper(ForceRange range) : range_(std::move(range)) {}

  ModelKind kind() const override { return ModelKind::Other; }
  std::string name() const override { return "force_range"; }
  bool needs_displacement() const noexcept override {
    return range_.stiffness != 0 || range_.reach;
  }
  std::size_t parameter_count() const noexcept override { return 2 * range_.velocity.size(); }
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double>) const noexcept override {}
  double force(const DamperInput& input, std::span<const double>) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

 private:
  ForceRange range_;
};

/// In a strut, following commands at once.
MountedDamper mounted(const ForceRange& range);

}  // namespace dashpot
