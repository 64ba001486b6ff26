#pragma once
#include <cmath>
#include <optional>

#include "dashpot/damper/laws/normalised_bouc_wen.h"
#include "dashpot/suspension/dampers/loop_path.h"

namespace dashpot {

class DamperModel;

/// A law's hysteresis loop, as LoopPath follows it.
struct LawLoop {
  std::size_t state;        ///< the place of z among the law's states
  bool in_series;           ///< the speed that drives it is less by the rate of the first state
  LoopShape<double> shape;  ///< the same at any current
};

/// The loop of a model that is a law with a loop of Bouc-Wen's kind; none where it has another
/// shape at another current.
std::optional<LawLoop> loop_of(const DamperModel& model);

/// What LoopPath wants to know of it.
struct LawLoopKind {
  using Number = double;
  static bool any(bool mask) { return mask; }
  static double exp_of_twice(double r) {
    static const double settled = std::exp(2 * LoopPath<LawLoopKind>::kSettled);
    return r < LoopPath<LawLoopKind>::kSettled ? std::exp(2 * r) : settled;
  }
  static double arctanh(double m, bool) { return std::atanh(m); }
  static double slope(const LoopShape<double>& loop, double m) {
    return normalised_bouc_wen_slope(loop.sigma, loop.n, m);
  }
};

}  // namespace dashpot
