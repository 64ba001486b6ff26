#pragma once
#include <memory>
#include <span>
#include <string>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/passive_network/passive_network_model.h"

namespace dashpot {

/// A force law and a passive network side by side: F = (1 - b) F_law + b F_network + offset, the
/// network's share b in 0 ... 1. Two dampers that share a motion take out what both do, so it
/// generates no energy where the law does not: docs/passive-network.md. Its state: the law's, then
/// the network's.
class PassiveHybridModel final : public DamperModel {
 public:
  /// Throws Error, beginning with `where` (the name when empty), at a share beyond 0 ... 1 and
  /// at a law that may feed energy in within its bounds.
  PassiveHybridModel(LawModel law, PassiveNetworkModel network, double network_share,
                     double offset = 0, const std::string& where = {});

  ModelKind kind() const override { return ModelKind::PassiveHybrid; }
  std::string name() const override;
  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override;
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool flows() const noexcept override { return law_.flows(); }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  bool is_ensemble() const noexcept override { return network_.is_ensemble(); }
  double spread(const DamperInput& input, std::span<const double> state) const noexcept override;
  const LawModel* law_inside() const noexcept override { return &law_; }
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const LawModel& law() const { return law_; }
  double law_share() const { return 1 - network_share_; }
  const PassiveNetworkModel& network() const { return network_; }
  double network_share() const { return network_share_; }
  double offset() const { return offset_; }

 private:
  LawModel law_;
  PassiveNetworkModel network_;
  double network_share_;
  double offset_;
};

std::unique_ptr<PassiveHybridModel> passive_hybrid_model_from_json(const Value& value);

}  // namespace dashpot
