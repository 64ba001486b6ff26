#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/model.h"
#include "dashpot/damper/neural/mlp_evaluator.h"

namespace dashpot {

/// "displacement", "velocity" or "current". Throws Error(where, ...) at another.
double DamperInput::* input_field(std::string_view input, const std::string& where);

/// A static network: present inputs -> force. No state.
class NetworkModel final : public DamperModel {
 public:
  /// inputs: a choice of "displacement", "velocity", "current", in the network's input order.
  NetworkModel(std::string name, std::vector<std::string> inputs, Mlp mlp, double offset = 0);

  std::string kind() const override { return "network"; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override { return mlp_.parameters.size(); }
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double, std::span<double>) const noexcept override {}
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const Mlp& mlp() const { return mlp_; }
  const std::vector<std::string>& inputs() const { return inputs_; }

 private:
  std::string name_;
  std::vector<std::string> inputs_;
  std::vector<double DamperInput::*> fields_;
  Mlp mlp_;
  std::unique_ptr<const MlpEvaluator<double>> evaluator_;
  double offset_;
};

std::unique_ptr<NetworkModel> network_model_from_json(const Value& value);

}  // namespace dashpot
