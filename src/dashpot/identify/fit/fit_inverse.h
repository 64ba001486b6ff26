#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/inverse/train_inverse.h"
#include "dashpot/identify/judge/track.h"
#include "dashpot/model_file.h"
#include "dashpot/split.h"

namespace dashpot {

struct InverseFitOptions {
  std::string network = "chang_zhou";
  double rate_max = 0;       ///< A/s, of its answers; 0: none
  InverseTraining training;  ///< its range of currents is the data's or the model's
};

/// A network that inverts a damper, and how near its currents come on what it had not seen. Where
/// the force hardly depends on the current, as where the motion turns, the current cannot be told:
/// an error counts by the force that it makes, or, where records come without a model, by v^2 /
/// (v^2 + v0^2) with v0 a fifth of the record's rms speed.
struct InverseFit {
  InverseNetwork network;
  std::string teacher;  ///< "tanh_kwok on noise, ..." or "20 records"
  Domain domain;
  std::vector<std::string> records;             ///< what it was taught with, when records
  double training_rmse = 0, left_out_rmse = 0;  ///< A, weighted so, in free run
  std::vector<std::string> warnings;
};

/// Taught on a model, which is moved over the range with all currents between the ends. Early
/// stopping and the left-out figure are each on motions and currents of their own.
InverseFit fit_inverse(const DamperModel& forward, const MotionRange& range,
                       const InverseLimits& limits, const InverseFitOptions& options);

/// Taught on records, the final network on all of them; the left-out figure comes from networks
/// that did not see those records. With a forward model, it gives the weights and each record's
/// force zero. Throws Error where the records cannot serve: one current only, or constant within
/// each record where the network feeds its currents back.
InverseFit fit_inverse(const Dataset& dataset, const LeaveOut& leave_out,
                       const DamperModel* forward, const InverseFitOptions& options);

/// The range that a model's domain allows.
MotionRange motion_range(const Domain& domain);

/// A motion that no network was taught with, and a force that the damper can give along it.
struct InverseTrial {
  std::string name;
  Motion motion;
  std::vector<double> wanted;
};
/// Noise, faster and smaller noise, and a sine, within the range.
std::vector<InverseTrial> inverse_trials(const DamperModel& forward, const MotionRange& range,
                                         const InverseLimits& limits);

}  // namespace dashpot
