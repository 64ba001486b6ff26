#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/value.h"

namespace dashpot {

constexpr std::string_view kLineFamily = "ellipses";  ///< its kind in a model file

/// The simplest family: each damper turns its force with the motion, in a size and by a phase that
/// are lines in the field, the fluid and the geometry:
///   F = A (cos p v + sin p w x') / r + F_0,  x' = x - x_0,  q' = w (v - q),
///   r^2 = max(2 (q^2 + (v - q)^2), (v^2 + (w x')^2) / 2) + s^2.
/// In a sine at w, that of the fit's motion, q and v - q are a quarter of a cycle apart and equally
/// large, so that r is the amplitude of its speed at every instant; and the force stays below 1.5 A
/// in any motion. Its size does not follow the speed, as that of a slow damper with a yield stress
/// does not.
struct FamilyLine {
  static constexpr std::size_t kMostFeatures = 6;
  using Features = std::array<double, kMostFeatures>;

  /// True: 1, i, i^2, ln eta, ln L, ln h. False, where one fluid only was seen: 1, T_y, ln L, ln h.
  bool by_current = true;
  double current = 1;                              ///< A, of which the feature i is a share
  double yield_stress = 1;                         ///< Pa, of which the feature T_y is a share
  double pole_length = 1, gap = 1, viscosity = 1;  ///< over which the logarithms are taken
  double frequency = 1;                            ///< w, rad/s
  double centre = 0;                               ///< x_0, m
  double slow = 1e-3;                              ///< s, m/s: below it the force goes to 0
  double offset = 0;                               ///< F_0, N
  std::vector<double> size, phase;                 ///< of ln(A / N) and of p: one per feature

  std::size_t feature_count() const noexcept { return by_current ? kMostFeatures : 4; }
  /// r, m/s, of a motion whose velocity q follows.
  double amplitude(const DamperInput& input, double follower) const noexcept;
  /// q after a step.
  double follow(double before, double from, double to, double dt) const noexcept;
  Features features(const FamilyMember& member, double current) const noexcept;
};

class LineFamily final : public FamilyForce {
 public:
  explicit LineFamily(FamilyLine line, const std::string& where = {});

  bool needs_displacement() const noexcept override { return true; }
  std::size_t parameter_count() const noexcept override {
    return line_.size.size() + line_.phase.size() + 1;
  }
  std::size_t state_size() const noexcept override { return 1; }
  void rest(const DamperInput&, std::span<double> state) const noexcept override { state[0] = 0; }
  void advance(const FamilyMember& member, const DamperInput& from, const DamperInput& to,
               double dt, std::span<double> state) const noexcept override;
  void settle(const FamilyMember& member, const SteadySine& sine, double phase,
              std::span<double> state) const override;
  void flow(const DamperInput& input, std::span<const double> state,
            std::span<double> rates) const noexcept override;
  double force(const FamilyMember& member, const DamperInput& input,
               std::span<const double> state) const noexcept override;
  Value to_json() const override;
  const FamilyLine& line() const { return line_; }

 private:
  FamilyLine line_;
};

std::unique_ptr<FamilyForce> read_line_family(const Value& value, ObjectReader& reader);

}  // namespace dashpot
