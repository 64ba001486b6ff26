#pragma once
#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "dashpot/damper/c_text/physics_family.h"
#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/value.h"

namespace dashpot {

constexpr std::string_view kPhysicsFamily = "plate_flow";  ///< its kind in a model file

/// One row of the table of what a fit learns; `numbers` of FamilyPhysics are in its order, that of
/// PhysicsIndex.
struct PhysicsNumber {
  std::string_view name, meaning;
  double prior;      ///< what it is without data: that of physics, where there is one
  double belief;     ///< in that: the ridge, where geometry has no part in it
  double low, high;  ///< ends of its search
  bool is_geometry;  ///< a correction whose ridge a fit chooses
};

/// Plate flow and seal friction, each in series with a spring, times corrections that are positive
/// and smooth:
///   F = g (f_1 + f_2) + F_0,  f_k' = K_k (v - u_k),  f_k = u_k D_k(s_k) / s_k,
///   s_k^2 = b (p^2 + (v - p)^2) + (1 - b) u_k^2 + s_0^2,  p' = w (v - p).
/// D_1 is the seal's force, which may grow with the current, D_2 that of the plate flow at a speed
/// s_k. With b = 0 this is plate flow and friction as they stand in books. In a sine at w, that of
/// the fit's motion, p and v - p are a quarter of a cycle apart and equally large: their squares
/// sum to the mean square of v at every instant, so that b > 0 rounds the loop, and 1 makes it an
/// ellipse. In a motion much slower or faster the sum goes to v^2, and the loop to that of books.
/// Whatever sets the resistances D_k / s_k, they are positive, and the springs do not change with
/// the current: over any closed cycle the damper takes energy out.
struct FamilyPhysics {
  using Numbers = std::array<double, kPhysicsNumbers>;

  /// The middle of the dampers and motions of the fit: numbers are shares and exponents over it.
  using Reference = PhysicsReference;
  /// How one build differs from its drawing: logarithms of its whole force, of the flow and of the
  /// springs beyond that, and its offset over the reference force.
  static constexpr std::size_t kDeviations = 4;
  using Deviation = std::array<double, kDeviations>;

  Reference reference{1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  Numbers numbers{};
  Deviation deviation{};  ///< of this build
  /// Covariance of the deviations of dampers left out of the fit, row by row, and what then remains
  /// of a record's force, as a share. 0: not known.
  std::array<double, kDeviations * kDeviations> covariance{};
  double record_error = 0;
  /// Of the fit's numbers and its offset over the reference force: the inverse of their covariance,
  /// builds and errors of a drawing as `covariance` has them. Row by row; empty: not known.
  std::vector<double> information = {};

  /// The deviations' covariance, of which no direction is known exactly.
  std::vector<double> deviation_covariance() const;

  /// What one damper at one current comes to.
  using Element = PhysicsElement;
  Element element(const FamilyMember& member, double current) const noexcept;
  /// The same of another build.
  Element element(const FamilyMember& member, const Deviation& build,
                  double current) const noexcept;
  /// The numbers without data.
  static Numbers priors() noexcept;
  static std::span<const PhysicsNumber, kPhysicsNumbers> table();
};

/// Force of the family in free run at every sample, without the family's offset.
std::vector<double> run_family_physics(const FamilyPhysics& physics, const FamilyMember& member,
                                       std::span<const DamperInput> inputs,
                                       std::span<const double> time);

/// State: the seal's force and that of the flow, N, and what follows the velocity, m/s.
constexpr std::size_t kPhysicsStates = 3;

class PhysicsFamily final : public FamilyForce {
 public:
  explicit PhysicsFamily(FamilyPhysics physics, const std::string& where = {});

  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override { return kPhysicsNumbers + 1; }
  std::size_t state_size() const noexcept override { return kPhysicsStates; }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  std::shared_ptr<const MemberSteps> steps_of(const FamilyMember& member) const override;
  void settle(const FamilyMember& member, const SteadySine& sine, double phase,
              std::span<double> state) const override;
  double force(const FamilyMember& member, const DamperInput& input,
               std::span<const double> state) const noexcept override;
  /// Its springs may be too stiff for the integrator of a vehicle: it steps itself.
  bool flows() const noexcept override { return false; }
  bool is_passive() const noexcept override { return true; }
  Value to_json() const override;
  const FamilyPhysics& physics() const { return physics_; }
  static constexpr std::string_view kDeviationNames[] = {"force", "flow", "stiffness", "offset"};

 private:
  FamilyPhysics physics_;
};

std::unique_ptr<FamilyForce> read_physics_family(const Value& value, ObjectReader& reader);

}  // namespace dashpot
