#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/inverse/inverse.h"

namespace dashpot {

/// A way from a wanted force to a current, known by name.
struct InverseScheme {
  std::string_view name, title, equation, source, remarks;
  /// Whether the measured force is an input.
  bool needs_force = false;
  /// The inverse of this damper. A coil lag of the model's own is left to InverseLimits::lag_rate.
  /// Throws Error where the scheme does not apply.
  std::unique_ptr<InverseModel> (*make)(const DamperModel& forward,
                                        const InverseLimits& limits) = nullptr;
};

/// Every scheme, in alphabetical order.
std::span<const InverseScheme> inverse_schemes();
std::vector<std::string> inverse_names();
/// Throws Error "unknown inverse 'numerical'; did you mean ...; known: ...".
const InverseScheme& find_inverse(std::string_view name, const std::string& where = {});

}  // namespace dashpot
