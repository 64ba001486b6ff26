#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/nets/ensemble.h"
#include "dashpot/damper_model.h"

namespace dashpot {

/// "displacement", "velocity" or "current". Throws Error(where, ...) at another.
double DamperInput::* input_field(std::string_view input, const std::string& where);

/// A static network, or the mean of several: present inputs -> force. No state.
class NetworkModel final : public DamperModel {
 public:
  /// inputs: a choice of "displacement", "velocity", "current", in the network's input order.
  NetworkModel(std::string name, std::vector<std::string> inputs, std::vector<Mlp> members,
               double offset = 0);

  ModelKind kind() const override { return ModelKind::Network; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double>) const noexcept override {}
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool is_ensemble() const noexcept override { return members_.size() > 1; }
  double spread(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const std::vector<Mlp>& members() const { return members_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  double offset() const { return offset_; }

 private:
  MlpEnsemble::Answer answer(const DamperInput& input) const noexcept;

  std::string name_;
  std::vector<std::string> inputs_;
  std::vector<double DamperInput::*> fields_;
  std::vector<Mlp> members_;
  std::unique_ptr<const MlpEnsemble> ensemble_;
  double offset_;
};

std::unique_ptr<NetworkModel> network_model_from_json(const Value& value);

}  // namespace dashpot
