#include "dashpot/suspension/dampers/soft_friction.h"

#include <cmath>

#include "dashpot/value.h"

namespace dashpot {
namespace {

class SoftFriction final : public DamperModel {
 public:
  explicit SoftFriction(std::shared_ptr<const DamperModel> model) : model_(std::move(model)) {}

  ModelKind kind() const override { return model_->kind(); }
  std::string name() const override { return model_->name(); }
  bool needs_displacement() const noexcept override { return model_->needs_displacement(); }
  std::size_t parameter_count() const noexcept override { return model_->parameter_count(); }
  std::size_t state_size() const noexcept override { return model_->state_size(); }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    model_->rest(input, state);
  }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    model_->advance(from, to, dt, state);
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override {
    if (!(std::abs(input.velocity) < kFrictionSpeed)) return model_->force(input, state);
    return between_ends(input, state);
  }
  bool flows() const noexcept override { return model_->flows(); }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override {
    const double force = model_->flow(input, state, rates);
    return std::abs(input.velocity) < kFrictionSpeed ? between_ends(input, state) : force;
  }
  bool has_diverged(std::span<const double> state) const noexcept override {
    return model_->has_diverged(state);
  }
  double feedback_step() const noexcept override { return model_->feedback_step(); }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<SoftFriction>(model_->with_offset(newton));
  }
  Value to_json() const override { return model_->to_json(); }

 private:
  double between_ends(DamperInput at, std::span<const double> state) const noexcept {
    const double share = 0.5 + 0.5 * at.velocity / kFrictionSpeed;
    at.velocity = -kFrictionSpeed;
    const double before = model_->force(at, state);
    at.velocity = kFrictionSpeed;
    return before + share * (model_->force(at, state) - before);
  }

  std::shared_ptr<const DamperModel> model_;
};

}  // namespace

bool jumps_at_rest(const DamperModel& model, double current_min, double current_max) {
  constexpr double kNearly = 1e-9, kUsual = 0.1;  // m/s
  constexpr double kNoticed = 1e-3;               // of the force at a usual speed
  std::vector<double> state(model.state_size());
  for (const double current : {current_min, 0.5 * (current_min + current_max), current_max}) {
    model.rest({0, 0, current}, state);
    const auto rise = [&](double v) {
      return std::abs(model.force({0, v, current}, state) - model.force({0, -v, current}, state));
    };
    if (rise(kNearly) > kNoticed * rise(kUsual)) return true;
  }
  return false;
}

std::shared_ptr<const DamperModel> with_soft_friction(std::shared_ptr<const DamperModel> model) {
  return std::make_shared<SoftFriction>(std::move(model));
}

}  // namespace dashpot
