#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/nets/gated_network.h"
#include "dashpot/damper/nets/hysteresis_bank.h"

namespace dashpot {

/// A law and a bank of states beside it, for what the law does not remember: what a network reads,
/// raw, at one instant.
///   motions: v, x where the law needs it, the law's states, its force; w and v - y of the bank
///   currents: that in the coil, u of the bank
struct HybridSource {
  LawModel law;
  HysteresisBank bank;

  std::size_t state_size() const noexcept { return law.state_size() + bank.size(); }
  std::size_t motions() const noexcept {
    return force_place() + 1 + bank.size() - bank.current_rates.size();
  }
  std::size_t currents() const noexcept { return 1 + bank.current_rates.size(); }
  /// Index of the law's force among the signals.
  std::size_t force_place() const noexcept {
    return 1 + law.law().needs_displacement + law.law().states.size();
  }
  void rest(const DamperInput& input, std::span<double> state) const noexcept;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept;
  /// Fills motions() + currents() numbers.
  void read(const DamperInput& input, std::span<const double> state,
            double* signals) const noexcept;
};

/// Makes signals of their own out of such that tell much the same: t = T (s - mean), T lower
/// triangular, so that each tells what those before it leave open, on the scale of the training
/// records.
struct SignalMixing {
  std::vector<double> mean;
  std::vector<double>
      rows;  ///< T row by row without its zeros; a row of zeros: nothing is left to tell

  static constexpr std::size_t kMost = GatedNetwork::kMaxSignals;
  void apply(const double* raw, double* mixed) const noexcept;
  /// d mixed by d raw times `change`.
  void apply_to_change(const double* change, double* mixed) const noexcept;
};

/// A force law and a network that adds what the law leaves: F = F_law(x, v, i, z) + N(T s, i). All
/// states are driven by motion and current alone and nothing feeds back, so the sum is as stable as
/// the law. Beyond the signals of the training records the network's part stays as at their edge.
class HybridModel final : public DamperModel {
 public:
  /// Throws Error, beginning with `where` (the name when empty), when the parts do not fit
  /// together.
  HybridModel(HybridSource source, SignalMixing mixing, GatedNetwork network, double offset = 0,
              const std::string& where = {});

  ModelKind kind() const override { return ModelKind::Hybrid; }
  std::string name() const override;
  bool needs_displacement() const noexcept override { return law().needs_displacement(); }
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override { return source_.state_size(); }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool flows() const noexcept override { return true; }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  const LawModel* law_inside() const noexcept override { return &source_.law; }
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const LawModel& law() const { return source_.law; }
  const HybridSource& source() const { return source_; }
  const SignalMixing& mixing() const { return mixing_; }
  const GatedNetwork& network() const { return network_; }
  double offset() const { return offset_; }

 private:
  HybridSource source_;
  SignalMixing mixing_;
  GatedNetwork network_;
  double offset_;
};

std::unique_ptr<HybridModel> hybrid_model_from_json(const Value& value);

}  // namespace dashpot
