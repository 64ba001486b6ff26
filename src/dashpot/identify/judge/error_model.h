#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/evaluate.h"

namespace dashpot {

// What a model gets wrong, learnt from its errors on records that its fits did not see, so that it
// can be carried to where the damper moves otherwise than on the bench:
//
//   error = b(motion, drive) + s(|v|, drive) n(t)
//
// b follows from the motion: it comes again whenever the motion does, and a vehicle meets it as a
// change of its damper. It is a sum of functions of one variable each: of the velocity, of its
// low-passes at a few lags (what a valve behind a spring, a bristle or a slow coil sees) and of the
// displacement. Of a sum each variable stays within what the bench has shown where their
// combination is new. Each function is a polygon between knots, constant beyond them, and linear in
// the drive between three of its values. Ridge regression fits all of them, with the penalty that
// predicts best what was left out of it: where motion says nothing of the error, b vanishes.
//
// What b leaves, on records left out of its fit, is noise: its size and its colour, a first-order
// autoregression, go by speed and drive. White noise beside it is the load cell's; it moves no
// damper and is not carried. The rest is the damper's or that of the motion's sensors, which a
// steep valve turns into force: each draw carries another share of it, from none to all.

/// The variables of b and their knots, and the classes of the noise.
struct ErrorTerms {
  static constexpr std::size_t kLags = 5;
  /// s; the first is the velocity itself.
  static constexpr double kLag[kLags] = {0, 2e-3, 6e-3, 2e-2, 6e-2};

  std::vector<double> velocities, displacements;  ///< m/s, m, ascending
  std::vector<double> drives;                     ///< A or V, ascending
  std::vector<double> speeds;                     ///< m/s, ascending, of the noise

  std::size_t weights() const {
    return (kLags * velocities.size() + displacements.size()) * drives.size();
  }
  std::size_t classes() const { return speeds.size() * drives.size(); }
};

/// One error that the model may have: b's weights, and what the noise is over time.
struct ErrorDraw {
  std::shared_ptr<const ErrorTerms> terms;
  std::vector<double> weights;                ///< N
  std::vector<std::vector<double>> noise;     ///< N, by class, every kNoiseStep
  static constexpr double kNoiseStep = 1e-3;  ///< s
};

/// A linear regression on sums over units, so that it can be made again with other counts of them.
struct RidgeRegression {
  /// Over one unit, each sample counting 1 / their number.
  struct Unit {
    std::vector<double> matrix, right;
    double power = 0;
  };
  std::vector<Unit> units;

  /// Weights that fit the units, each counted so often. penalty: as if so large a share of the
  /// samples had been spread over all terms, without an error.
  std::vector<double> weights(std::span<const double> counts, double penalty) const;
  /// Those of all units but every kParts-th from `part` on.
  static constexpr std::size_t kParts = 5;
  std::vector<double> weights_without(std::size_t part, double penalty) const;
  /// Power that these weights leave, summed over the units of a part.
  double power_left(std::size_t part, std::span<const double> weights) const;
};

/// The errors of one model.
class ErrorModel {
 public:
  /// Learns from the records that did not diverge, with their offsets. Throws Error where there is
  /// none.
  explicit ErrorModel(const std::vector<RecordResult>& left_out);

  /// N, root mean square of what b leaves on records that it was fitted without; every record
  /// counts as much as another.
  double unexplained() const { return unexplained_; }

  /// The error as the records would have it if they had been others of their kind (b is fitted anew
  /// to them, each counted at random, as in a Bayesian bootstrap), with a share of the noise, for
  /// so many seconds.
  ErrorDraw draw(double duration, std::uint64_t seed) const;

 private:
  struct NoiseClass {
    double size = 0;  ///< N, standard deviation
    double rate = 0;  ///< 1/s, at which it forgets
  };

  std::shared_ptr<const ErrorTerms> terms_;
  RidgeRegression regression_;
  double penalty_ = 0, unexplained_ = 0;
  std::vector<NoiseClass> classes_;
};

/// The model with that error added to its force.
std::shared_ptr<const DamperModel> erring(std::shared_ptr<const DamperModel> model,
                                          ErrorDraw error);

}  // namespace dashpot
