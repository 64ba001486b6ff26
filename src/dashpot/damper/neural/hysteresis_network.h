#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/model.h"
#include "dashpot/damper/neural/gated_network.h"
#include "dashpot/damper/neural/hysteresis_bank.h"

namespace dashpot {

/// A bank of states and the network that reads it.
struct BankNetwork {
  HysteresisBank bank;
  GatedNetwork network;

  /// Rates, weights of neurons and gates.
  std::size_t parameter_count() const noexcept { return bank.size() + network.parameter_count(); }
};

/// Velocity and current -> force with hysteresis: the mean of a few networks on banks of states of their
/// own. Bounded by construction for bounded inputs: the states are, and nothing feeds back.
class HysteresisNetwork final : public DamperModel {
 public:
  /// Throws Error, beginning with `where` (the name when empty), when the parts do not fit together.
  HysteresisNetwork(std::string name, std::vector<BankNetwork> members, double offset = 0,
                    const std::string& where = {});

  std::string kind() const override { return "state_network"; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override { return state_size_; }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool flows() const noexcept override { return true; }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  bool is_ensemble() const noexcept override { return members_.size() > 1; }
  double spread(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const std::vector<BankNetwork>& members() const { return members_; }
  double offset() const { return offset_; }

 private:
  std::string name_;
  std::vector<BankNetwork> members_;
  double offset_;
  std::size_t state_size_ = 0;
};

std::unique_ptr<HysteresisNetwork> hysteresis_network_from_json(const Value& value);

}  // namespace dashpot
