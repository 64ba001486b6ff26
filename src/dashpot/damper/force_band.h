#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "dashpot/base/value.h"
#include "dashpot/damper/model.h"

namespace dashpot {

/// An interval of the force around a model's: force -half ... force +half, its width by what is
/// known at run time. Constant in each band of speed, linear in the drive between knots, constant
/// beyond them; and the wider the less an ensemble's members agree.
struct ForceBand {
  double level = 0.9;       ///< share of samples that it claims to cover
  std::size_t records = 0;  ///< left-out records, or parts of them, that its width comes from
  std::vector<double>
      speeds;  ///< m/s, ascending: |v| where one band of speed ends and the next begins
  std::vector<double> drives;      ///< A or V, ascending: the knots, at least one
  std::vector<double> half_width;  ///< N, one row per band of speed, one column per knot

  double spread = 0;  ///< times the members' spread, N, is added in quadrature

  /// `members_spread`: DamperModel::spread of the model there.
  double half_width_at(const DamperInput& input, double members_spread = 0) const noexcept;
  /// The same shape, `factor` times as wide.
  ForceBand scaled(double factor) const;
};

Value to_json(const ForceBand& band);
/// Throws Error naming the key on anything unknown, missing, out of order or not positive.
ForceBand read_force_band(const Value& value);

}  // namespace dashpot
