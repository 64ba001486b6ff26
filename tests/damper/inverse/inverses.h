#pragma once
#include <memory>
#include <vector>

#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/drive.h"

// Parts that the tests of the inverses share.

/// One call of an inverse whose state starts from rest at the input's motion and current.
inline double first_command(const dashpot::InverseModel& inverse,
                            const dashpot::InverseInput& input) {
  std::vector<double> state(inverse.state_size());
  inverse.rest({input.displacement, input.velocity, input.current}, state);
  return inverse.command(input, state);
}

/// Every parameter that by default depends on the current grows linearly with it, from a quarter of
/// its example value to the whole at 1 A.
inline dashpot::LawModel driven(const dashpot::Law& law, double lag_rate) {
  using namespace dashpot;
  Dependence d;
  for (const ParamInfo& info : law.params) {
    const bool drives = info.fit == Fit::Drive;
    const bool follows = drives || (info.form != Form::Constant && is_estimated(info.fit));
    d.forms.push_back(follows ? Form::Linear : Form::Constant);

    if (drives)
      d.coefficients.push_back({0, 1});
    else if (follows)
      d.coefficients.push_back({0.25 * info.value, 0.75 * info.value});
    else
      d.coefficients.push_back({info.value});
  }
  return LawModel(law, d, DriveUnit::Ampere, lag_rate);
}

/// A model that counts how often its force is asked for; its copies count together.
class CountingModel final : public dashpot::DamperModel {
 public:
  CountingModel(std::unique_ptr<dashpot::DamperModel> model, std::size_t* count)
      : model_(std::move(model)), count_(count) {}

  dashpot::ModelKind kind() const override { return model_->kind(); }
  std::string name() const override { return model_->name(); }
  bool needs_displacement() const noexcept override { return model_->needs_displacement(); }
  std::size_t parameter_count() const noexcept override { return model_->parameter_count(); }
  std::size_t state_size() const noexcept override { return model_->state_size(); }
  void rest(const dashpot::DamperInput& input, std::span<double> state) const noexcept override {
    model_->rest(input, state);
  }
  void advance(const dashpot::DamperInput& from, const dashpot::DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    model_->advance(from, to, dt, state);
  }
  double force(const dashpot::DamperInput& input,
               std::span<const double> state) const noexcept override {
    ++*count_;
    return model_->force(input, state);
  }
  std::unique_ptr<dashpot::DamperModel> with_offset(double newton) const override {
    return std::make_unique<CountingModel>(model_->with_offset(newton), count_);
  }
  dashpot::Value to_json() const override { return model_->to_json(); }

 private:
  std::unique_ptr<dashpot::DamperModel> model_;
  std::size_t* count_;
};
