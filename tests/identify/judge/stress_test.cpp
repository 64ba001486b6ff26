#include "dashpot/identify/judge/stress.h"

#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr Domain kDomain{-0.01, 0.01, -0.1, 0.1, 0, 1};

/// A viscous damper, 1000 N*s/m.
LawModel viscous() { return LawModel::constant(find_law("bingham"), {1000, 0, 0, 0}); }

/// A force that grows by a factor each step.
class Runaway final : public DamperModel {
 public:
  ModelKind kind() const override { return ModelKind::Law; }
  std::string name() const override { return "runaway"; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override { return 0; }
  std::size_t state_size() const noexcept override { return 1; }
  void rest(const DamperInput&, std::span<double> z) const noexcept override { z[0] = 1; }
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double> z) const noexcept override {
    z[0] *= 2;
  }
  double force(const DamperInput&, std::span<const double> z) const noexcept override {
    return z[0];
  }
  std::unique_ptr<DamperModel> with_offset(double) const override {
    return std::make_unique<Runaway>(*this);
  }
  Value to_json() const override { return {}; }
};

}  // namespace

TEST_CASE("stress: a linear damper meets twice the speed with twice the force") {
  // 1000 N*s/m at 2 * 0.1 m/s is 200 N; the data's span is that of +-0.1 m/s, 200 N.
  const StressRun run = stress(viscous(), kDomain, 200);
  CHECK(run.finite);
  CHECK(run.is_bounded());
  CHECK_CLOSE(run.largest_share, 1, 1e-9, 0);
}

TEST_CASE(
    "stress: a force that is large for the data is called unbounded, one that overflows diverged") {
  CHECK(!stress(viscous(), kDomain, 10).is_bounded());
  const StressRun run = stress(Runaway(), kDomain, 200);
  CHECK(!run.finite);
  CHECK(!run.is_bounded());
}
