#pragma once
#include <span>

#include "dashpot/damper_model.h"

namespace dashpot {

// A force that leaps where the stroke passes 0, as that of the law tanh_kwok, under an integrator
// of fixed steps. None of its steps ends at the leap, so that a run would change by the grain of a
// step and not with the damper's numbers: short differences of it would be nothing, or a leap over
// a tiny length. And nobody sees what goes on between two samples. So the force goes over the leap
// in a straight line along the stroke, in the time of one sample: what the steps see of it, summed
// as Runge-Kutta sums it, is then proportional to the time that is left behind the leap.
//
// A stroke that turns near 0 swings over the leap, the quicker the nearer. There the line is as
// long as makes that a swing of eleven samples, which samples can show and steps can follow. A fit
// says how long a sample is; a run that is to be the truth leaps at once.

/// The leap of one damper in one run.
class ForceLeap {
 public:
  /// damper, which must outlive it, at drives from low to high; time: s, in which it goes over the
  /// leap; yields: the acceleration of the stroke by each newton, 1/kg.
  ForceLeap(const DamperModel& damper, double low, double high, double time, double yields);

  /// What the damper's force has too much beside the line, N; 0 for one that does not leap.
  double beyond_line(const DamperInput& at, std::span<const double> state) const noexcept;

 private:
  const DamperModel* damper_;
  double half_time_;  ///< s
  double slow_ = 0;   ///< m/s, a speed at which the stroke turns near 0; 0: nothing leaps
};

/// Whether a force leaps, at one of these drives, where the stroke or the speed passes 0 about
/// rest.
bool leaps_at_rest(const DamperModel& damper, double low, double high);

}  // namespace dashpot
