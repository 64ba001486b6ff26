#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// A passive damper by its measured force over velocity: monotone between the points (Fritsch and
/// Carlson, SIAM J. Numerical Analysis 17 (1980) 238), straight on beyond them, blind to current
/// and displacement.
class PassiveCurve final : public DamperModel {
 public:
  /// velocity m/s, rising; force N, one per velocity. Throws Error on less than two points, on
  /// velocities that do not rise, on numbers that are not finite.
  PassiveCurve(std::string name, std::vector<double> velocity, std::vector<double> force);

  ModelKind kind() const override { return ModelKind::Other; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override { return force_.size(); }
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double>) const noexcept override {}
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  double velocity_min() const { return velocity_.front(); }  ///< m/s, of the points
  double velocity_max() const { return velocity_.back(); }

 private:
  std::string name_;
  std::vector<double> velocity_, force_, slope_;
};

/// Names of the curves that come with Dashpot, in alphabetical order.
std::vector<std::string> passive_curve_names();
/// One of those, or a file with the columns velocity and force in units that it states. Throws
/// Error with what is missing.
PassiveCurve load_passive_curve(const std::string& name_or_path);

}  // namespace dashpot
