#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/damper/kinds/family/steady_sine.h"
#include "dashpot/damper/nets/hysteresis_bank.h"
#include "dashpot/damper/nets/mlp_evaluator.h"
#include "dashpot/damper_model.h"

namespace dashpot {

/// Steps one member of a family, of which it knows what stays as it is.
class MemberSteps {
 public:
  virtual ~MemberSteps() = default;
  virtual void advance(const DamperInput& from, const DamperInput& to, double dt,
                       std::span<double> state) const noexcept = 0;
};

/// The learned part of a family's force: member, motion, current -> N. Immutable; the state lives
/// outside.
class FamilyForce {
 public:
  virtual ~FamilyForce() = default;
  virtual bool needs_displacement() const noexcept = 0;
  virtual std::size_t parameter_count() const noexcept = 0;
  virtual std::size_t state_size() const noexcept { return 0; }
  virtual void rest(const DamperInput&, std::span<double>) const noexcept {}
  virtual void advance(const FamilyMember&, const DamperInput&, const DamperInput&, double,
                       std::span<double>) const noexcept {}
  /// What steps a member in place of advance(), where much of a step is the same each time; null.
  virtual std::shared_ptr<const MemberSteps> steps_of(const FamilyMember&) const { return {}; }
  /// The states where a sine that has long gone on passes a phase.
  virtual void settle(const FamilyMember&, const SteadySine&, double, std::span<double>) const {}
  virtual double force(const FamilyMember& member, const DamperInput& input,
                       std::span<const double> state) const noexcept = 0;
  /// Whether an integrator may step the states by flow(), their derivatives by time.
  virtual bool flows() const noexcept { return true; }
  virtual void flow(const DamperInput&, std::span<const double>, std::span<double>) const noexcept {
  }
  /// Whether its structure takes energy out over every cycle, whatever its numbers.
  virtual bool is_passive() const noexcept { return false; }
  /// These four do what those of DamperModel do.
  virtual bool is_ensemble() const noexcept { return false; }
  virtual double spread(const FamilyMember&, const DamperInput&) const noexcept { return 0; }
  virtual Value to_json() const = 0;
};
std::unique_ptr<FamilyForce> family_force_from_json(const Value& value);

/// A number of the member or the instant that a network reads. Throws Error(where, "unknown input
/// ...").
using FamilyInput = double (*)(const FamilyMember& member, const DamperInput& input);
FamilyInput family_input_named(std::string_view name, const std::string& where);

/// The mean of static networks of a member's numbers and its motion.
class FamilyNetwork final : public FamilyForce {
 public:
  /// inputs: names of member_fields(), "yield_stress", "displacement", "velocity", "current".
  FamilyNetwork(std::vector<std::string> inputs, std::vector<Mlp> members,
                const std::string& where = {});

  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override;
  double force(const FamilyMember& member, const DamperInput& input,
               std::span<const double> state) const noexcept override;
  bool is_ensemble() const noexcept override { return evaluators_.size() > 1; }
  double spread(const FamilyMember& member, const DamperInput& input) const noexcept override;
  Value to_json() const override;

  const std::vector<std::string>& inputs() const { return inputs_; }
  const std::vector<Mlp>& mlps() const { return mlps_; }

 private:
  using Row = std::array<double, Mlp::kMaxWidth>;
  Row read(const FamilyMember& member, const DamperInput& input) const noexcept;

  std::vector<std::string> inputs_;
  std::vector<FamilyInput> reads_;
  std::vector<Mlp> mlps_;
  std::vector<MlpEvaluator<double>> evaluators_;
};

/// Memory from a bank of states that read the velocity; geometry, fluid and field enter as gates,
/// polynomials of low order in few numbers:
///   F = sum_j (sum_k W_jk g_k) t_j / s_j,  t = [v, w, v - y, tanh(v / v_m), 1],  g = prod_n
///   q_n^e_kn,
/// q: the field's share i / (i + i_half), the logarithm of the viscosity, gap and pole length,
/// standardised.
struct FamilyGates {
  static constexpr std::size_t kQuantities = 4;  ///< q
  static constexpr std::size_t kGates = 13;      ///< g
  static constexpr std::size_t kSoftSpeeds = 2;  ///< v_m that a fit sets
  static constexpr std::size_t kMaxTerms = 32;   ///< t
  using Quantities = std::array<double, kQuantities>;

  HysteresisBank bank;              ///< without current lags
  std::vector<double> soft_speeds;  ///< v_m, m/s
  double half_current = 1;          ///< A
  Quantities mean{}, scale{1, 1, 1, 1};
  std::vector<double> term_scale;  ///< s
  std::vector<double> weights;     ///< W, row by row, N

  std::size_t term_count() const noexcept { return bank.signal_count() + soft_speeds.size() + 1; }
  void read_terms(const DamperInput& input, std::span<const double> state,
                  double* terms) const noexcept;
  Quantities quantities(const FamilyMember& member,
                        double current) const noexcept;  ///< standardised
  /// Powers of the quantities in each gate.
  static std::span<const std::array<int, kQuantities>> exponents();
  static std::array<double, kGates> gates(const Quantities& quantities) noexcept;
};

class GatedFamily final : public FamilyForce {
 public:
  explicit GatedFamily(FamilyGates gates, const std::string& where = {});

  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override { return gates_.bank.size(); }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const FamilyMember& member, const DamperInput& from, const DamperInput& to,
               double dt, std::span<double> state) const noexcept override;
  void settle(const FamilyMember& member, const SteadySine& sine, double phase,
              std::span<double> state) const override;
  double force(const FamilyMember& member, const DamperInput& input,
               std::span<const double> state) const noexcept override;
  Value to_json() const override;
  void flow(const DamperInput& input, std::span<const double> state,
            std::span<double> rates) const noexcept override {
    gates_.bank.flow(input, state, rates);
  }
  const FamilyGates& gates() const { return gates_; }

 private:
  FamilyGates gates_;
};

}  // namespace dashpot
