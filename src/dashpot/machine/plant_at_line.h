#pragma once
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

// A plant at one frequency, and small Hermitian matrices: what spectra of several sensors are
// weighed by.

/// The spring and the dashpot that stand for a damper along one motion.
struct StandIn {
  double stiffness = 0, damping = 0;  ///< N/m, N*s/m
};
/// By least squares about the means; nothing where the motion cannot tell them apart.
std::optional<StandIn> stand_in_of(std::span<const DamperInput> motion,
                                   std::span<const double> force);

/// What the sensors show at one frequency, with a spring and a dashpot in each damper's place. All
/// that it is made from must outlive it; the setup's delays hold.
class PlantAtLine {
 public:
  /// stand_ins: of each damper.
  PlantAtLine(const DrivenPlant& plant, const InPlantSetup& setup,
              std::span<const StandIn> stand_ins);

  /// w: rad/s.
  void move_to(double w);
  double w() const { return w_; }
  std::complex<double> iw() const { return {0, w_}; }

  /// What the sensors show of a force of a damper's, of an input, of a push at a coordinate: one
  /// number per sensor.
  void of_force(std::size_t damper, std::vector<std::complex<double>>& shows);
  void of_input(std::size_t u, std::vector<std::complex<double>>& shows);
  void of_push(std::size_t at, std::vector<std::complex<double>>& shows);

 private:
  static constexpr std::size_t kNone = -1;
  template <class Push>
  void respond(const Push& push, std::size_t input, std::size_t damper,
               std::vector<std::complex<double>>& shows);
  std::complex<double> seen(const PlantSensorPlace& place, std::size_t input,
                            std::size_t damper) const;

  const DrivenPlant& plant_;
  const InPlantSetup& setup_;
  std::span<const StandIn> stand_ins_;
  double w_ = 0;
  std::vector<std::complex<double>> admittance_, matrix_, inverse_, late_, q_;
};

/// Adds noise of this density, which the sensors show so, to the lower triangle of their
/// covariance.
void add_noise(const std::vector<std::complex<double>>& shows, double density,
               std::complex<double>* covariance);

/// Adds what two noises of a density share, `shared` of it, on top of each by itself.
void add_shared_noise(const std::vector<std::complex<double>>& one,
                      const std::vector<std::complex<double>>& other, double shared,
                      std::complex<double>* covariance);

/// The lower factor of a Hermitian matrix, in place; false where it is not positive definite.
bool factorise(std::complex<double>* a, std::size_t n);

/// x of L x = x, in place; every `stride`-th number.
void solve_lower(const std::complex<double>* factor, std::size_t n, std::complex<double>* x,
                 std::size_t stride = 1);

}  // namespace dashpot
