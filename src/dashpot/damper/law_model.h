#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/dependence.h"
#include "dashpot/damper/law.h"
#include "dashpot/damper/model.h"

namespace dashpot {

/// A law at work: its parameters as functions of the coil current, the coil's first-order lag and an
/// RK4 integrator whose number of steps follows from the law's rate.
class LawModel final : public DamperModel {
 public:
  /// drive_unit: "A" or "V". lag_rate: 1/s, i' = -lag_rate (i - command); 0: no lag.
  LawModel(const Law& law, Dependence parameters, std::string drive_unit, double lag_rate);
  /// Every parameter constant, at the values given (in table order); tests and examples use it.
  static LawModel constant(const Law& law, const std::vector<double>& parameters);

  std::string kind() const override { return "law"; }
  std::string name() const override { return std::string(law_->name); }
  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override;  ///< the law's states, then the lagged current
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const Law& law() const { return *law_; }
  const Dependence& parameters() const { return parameters_; }
  double lag_rate() const { return lag_rate_; }
  const std::string& drive_unit() const { return drive_unit_; }

 private:
  const Law* law_;
  Dependence parameters_;
  std::string drive_unit_;
  double lag_rate_;
};

/// Reads what LawModel::to_json wrote. Throws Error on an unknown law, key or parameter, or a value
/// outside its bounds.
std::unique_ptr<LawModel> law_model_from_json(const Value& value);

}  // namespace dashpot
