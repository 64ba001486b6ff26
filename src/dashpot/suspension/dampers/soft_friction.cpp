#include "dashpot/suspension/dampers/soft_friction.h"

#include <cmath>

#include "dashpot/value.h"

namespace dashpot {
namespace {

/// A model whose force is a straight line where one of its inputs is within `reach` of 0.
class Softened final : public DamperModel {
 public:
  Softened(std::shared_ptr<const DamperModel> model, const SoftMiddle& middle)
      : model_(std::move(model)), middle_(middle) {}

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
    return middle_.has(input) ? between_ends(input, state) : model_->force(input, state);
  }
  bool flows() const noexcept override { return model_->flows(); }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override {
    const double force = model_->flow(input, state, rates);
    return middle_.has(input) ? between_ends(input, state) : force;
  }
  bool has_diverged(std::span<const double> state) const noexcept override {
    return model_->has_diverged(state);
  }
  double feedback_step() const noexcept override { return model_->feedback_step(); }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<Softened>(model_->with_offset(newton), middle_);
  }
  Value to_json() const override { return model_->to_json(); }

  const DamperModel& model() const { return *model_; }
  const SoftMiddle& middle() const { return middle_; }

 private:
  double between_ends(const DamperInput& input, std::span<const double> state) const noexcept {
    return middle_.between_ends(input,
                                [&](const DamperInput& at) { return model_->force(at, state); });
  }

  std::shared_ptr<const DamperModel> model_;
  SoftMiddle middle_;
};

/// Whether the force jumps where that input passes 0: it changes over next to no way, and over a
/// hundredth of that no less, as a stiff spring's would.
bool jumps(const DamperModel& model, double DamperInput::* what, double current_min,
           double current_max) {
  constexpr double kNearly = 1e-9, kUsual = 0.1;  // m/s, m
  constexpr double kNoticed = 1e-3;               // of the force at a usual speed
  std::vector<double> state(model.state_size());
  for (const double current : {current_min, 0.5 * (current_min + current_max), current_max}) {
    model.rest({0, 0, current}, state);
    const auto rise = [&](double DamperInput::* input, double value) {
      DamperInput to{0, 0, current}, from = to;
      to.*input = value;
      from.*input = -value;
      return std::abs(model.force(to, state) - model.force(from, state));
    };
    const double near = rise(what, kNearly);
    if (near > kNoticed * rise(&DamperInput::velocity, kUsual) &&
        rise(what, 0.01 * kNearly) > 0.5 * near)
      return true;
  }
  return false;
}

}  // namespace

SoftLaw soft_law(const DamperModel& model) {
  const auto* softened = model_as<Softened>(model);
  const auto* law = model_as<LawModel>(softened ? softened->model() : model);
  if (!law || law->lag_rate() > 0) return {};
  return softened ? SoftLaw{law, true, softened->middle()} : SoftLaw{law};
}

double SoftLaw::in_middle(const double* parameters, const DamperInput& input,
                          const double* state) const noexcept {
  const Law& bare = law->law();
  return middle.between_ends(input, [&](const DamperInput& at) {
    const double force = bare.force(parameters, at.displacement, at.velocity, state);
    return bare.side_row > 0 ? force + side_force(bare, parameters, at.velocity) : force;
  });
}

bool jumps_at_rest(const DamperModel& model, double current_min, double current_max) {
  return jumps(model, &DamperInput::velocity, current_min, current_max);
}

bool jumps_in_middle(const DamperModel& model, double current_min, double current_max) {
  return jumps(model, &DamperInput::displacement, current_min, current_max);
}

std::shared_ptr<const DamperModel> with_soft_friction(std::shared_ptr<const DamperModel> model) {
  return std::make_shared<Softened>(std::move(model),
                                    SoftMiddle{&DamperInput::velocity, kFrictionSpeed});
}

std::shared_ptr<const DamperModel> with_soft_sides(std::shared_ptr<const DamperModel> model) {
  return std::make_shared<Softened>(std::move(model),
                                    SoftMiddle{&DamperInput::displacement, kSideWay});
}

}  // namespace dashpot
