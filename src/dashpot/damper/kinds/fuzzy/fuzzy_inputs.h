#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// The inputs of a fuzzy model: a choice of "displacement", "velocity", "velocity_change" and
/// "current". velocity_change is v - v_past with velocity_lag v_past' = v - v_past: it stands for
/// the past velocity of the literature, whatever the sample time. The current lags likewise behind
/// its command, by coil_lag.
class FuzzyInputs {
 public:
  struct Lags {
    double velocity = 0.01;  ///< s, positive
    double coil = 0;         ///< s, 0: none
  };

  /// Throws Error, beginning with `where`, for an unknown name or lags out of range.
  FuzzyInputs(std::vector<std::string> names, Lags lags, const std::string& where);

  const std::vector<std::string>& names() const noexcept { return names_; }
  const Lags& lags() const noexcept { return lags_; }
  bool has(std::string_view name) const noexcept;
  std::size_t state_size() const noexcept { return (has_past_ ? 1 : 0) + (has_coil_ ? 1 : 0); }

  void rest(const DamperInput& input, std::span<double> state) const noexcept;
  /// Exact for inputs that are linear in between.
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept;
  /// One number per name.
  void read(const DamperInput& input, std::span<const double> state, double* values) const noexcept;

 private:
  enum class Source { Displacement, Velocity, VelocityChange, Current };
  static Source source_of(const std::string& name, const std::string& where);

  std::vector<std::string> names_;
  std::vector<Source> sources_;
  Lags lags_;
  bool has_past_, has_coil_;  // states, in this order
};

}  // namespace dashpot
