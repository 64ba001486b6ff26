#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/dependence.h"
#include "dashpot/damper/law.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/damper_model.h"
#include "dashpot/drive.h"

namespace dashpot {

class LawText;

/// A law at work: its parameters as functions of the coil current, the coil's first-order lag and
/// an RK4 integrator whose number of steps follows from the law's rate.
class LawModel final : public DamperModel {
 public:
  /// lag_rate: 1/s, i' = -lag_rate (i - command); 0: no lag. Throws Error when the number of
  /// parameters or of their coefficients is not what the law and the forms ask for.
  LawModel(const Law& law, Dependence parameters, DriveUnit drive_unit, double lag_rate);
  /// Every parameter constant, at the values given (in table order), no lag; tests and examples use
  /// it.
  static LawModel constant(const Law& law, const std::vector<double>& parameters);

  ModelKind kind() const override { return ModelKind::Law; }
  std::string name() const override { return std::string(law_->name); }
  bool needs_displacement() const noexcept override;
  /// Coefficients of the parameters that the law does not call fixed.
  std::size_t parameter_count() const noexcept override;
  /// The law's states, then the current in the coil when it lags.
  std::size_t state_size() const noexcept override;
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::size_t run(std::span<const DamperInput> inputs, Steps steps, std::span<double> state,
                  Response to) const noexcept override;
  /// Not where a law that steps itself is stiffer than a vehicle's integrator can follow.
  bool flows() const noexcept override { return !steps_itself_; }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  /// flow() of a law without a lag, with its parameters at the input's current, for whoever has
  /// them at hand.
  double flow(const double* parameters, const DamperInput& input, const double* state,
              double* rates) const noexcept {
    const double x = input.displacement, v = input.velocity;
    const double force = law_->flow ? law_->flow(parameters, x, v, state, rates)
                                    : law_->force(parameters, x, v, state);
    return law_->side_row > 0 ? force + side_force(*law_, parameters, v) : force;
  }
  const LawModel* law_inside() const noexcept override { return this; }
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  /// The parameters at a current, in table order, into out[0 ... law().params.size()-1].
  void parameters_at(double current, double* out) const noexcept {
    const std::size_t count = law_->params.size();
    if (!follows_current_) {
      std::copy_n(by_power_[0].data(), count, out);
      return;
    }
    for (std::size_t k = 0; k < count; ++k)
      out[k] =
          by_power_[0][k] +
          current * (by_power_[1][k] + current * (by_power_[2][k] + current * by_power_[3][k]));
    for (const std::size_t k : exponential_) out[k] = parameters_.at(k, current);
  }
  bool follows_current() const noexcept { return follows_current_; }
  /// The current in the coil at this instant.
  double coil_current(const DamperInput& input, std::span<const double> state) const noexcept {
    return lag_rate_ > 0 ? state[law_->states.size()] : input.current;
  }

  const Law& law() const { return *law_; }
  const Dependence& parameters() const { return parameters_; }
  double lag_rate() const { return lag_rate_; }
  DriveUnit drive_unit() const { return drive_unit_; }

 private:
  const Law* law_;
  std::shared_ptr<const LawText> text_;  ///< of a law from a file, which ends with its last model
  Dependence parameters_;
  DriveUnit drive_unit_;
  double lag_rate_;
  bool follows_current_ = false;  ///< some parameter depends on the current
  bool steps_itself_ = false;
  /// The polynomials' coefficients by power of the current, padded with zeros: one straight loop
  /// evaluates them.
  std::array<std::array<double, kMaxParams>, 4> by_power_{};
  std::vector<std::size_t> exponential_;  ///< the parameters that no polynomial describes
};

/// Reads what LawModel::to_json wrote; a parameter may stand in any unit of the right dimension
/// ("N*s/cm") and is converted. Throws Error on an unknown law, key or parameter and on what is
/// missing.
std::unique_ptr<LawModel> law_model_from_json(const Value& value);

/// Throws Error(where, ...) when a parameter is outside its law's bounds at this current.
void require_bounds(const LawModel& model, double current, const std::string& where);

}  // namespace dashpot
