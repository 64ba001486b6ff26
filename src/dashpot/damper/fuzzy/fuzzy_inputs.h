#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/model.h"

namespace dashpot {

/// What a fuzzy model sees of a damper's motion: a choice of "displacement", "velocity", "current" and
/// "velocity_change". The last is what the velocity is ahead of itself after a first-order lag, v - v_past
/// with lag v_past' = v - v_past: the past velocity of the literature, whatever the sample time. It is a state.
class FuzzyInputs {
 public:
  /// Throws Error for an unknown name. `lag` in s, positive.
  FuzzyInputs(std::vector<std::string> names, double lag, const std::string& where);

  const std::vector<std::string>& names() const { return names_; }
  double lag() const { return lag_; }
  bool has(std::string_view name) const noexcept;
  std::size_t state_size() const noexcept { return has_past_ ? 1 : 0; }

  void rest(std::span<double> state) const noexcept;
  /// Exact for a velocity that is linear in between.
  void advance(const DamperInput& from, const DamperInput& to, double dt, std::span<double> state) const noexcept;
  /// One number per name.
  void read(const DamperInput& input, std::span<const double> state, double* values) const noexcept;

 private:
  std::vector<std::string> names_;
  std::vector<double DamperInput::*> fields_;  // nullptr: velocity_change
  double lag_;
  bool has_past_;
};

}  // namespace dashpot
