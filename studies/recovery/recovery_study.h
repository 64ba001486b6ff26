#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// A test of the intervals that fits state: dampers with known parameters are recorded on the
/// virtual bench and identified again and again, with other noise each time.
struct RecoveryStudyOptions {
  std::vector<std::string> laws;  ///< empty: all
  int repetitions = 100;
  double force_noise = 0.01;  ///< standard deviation, share of each record's force span
  /// Motion from a noisy displacement sensor, as on a real bench; else exact. The intervals know of
  /// noise in the force alone.
  bool noisy_motion = false;
  std::uint64_t seed = 1;
  int threads = 0;
  Monitor monitor;
};

/// One coefficient of the law over all repetitions.
struct ParameterRecovery {
  std::string name, unit;
  double truth = 0;
  int counted = 0;   ///< repetitions in which the fit gave it an interval
  int inside = 0;    ///< of these, those whose interval holds the truth
  int weak = 0;      ///< the fit stated that these data do not determine it
  int at_bound = 0;  ///< the fit ended at a bound, where no interval holds
  bool fixed = false;
  double bias = 0;    ///< mean of found - truth over the mean standard error
  double spread = 0;  ///< standard deviation of found over the mean standard error
};

/// All coefficients of a law that fits estimate.
struct LawRecovery {
  std::string law;
  std::vector<ParameterRecovery> parameters;
  int failed = 0;      ///< fits without a model
  double seconds = 0;  ///< mean time of one fit
  int counted() const;
  int inside() const;
  double share() const;  ///< of intervals that hold the truth; NaN when none was counted
  /// Whether chance hardly gives this share to intervals that hold 95 %: so many were counted, or
  /// so few of them hold the truth.
  bool enough() const;
  /// Within 90 ... 99 %, which an interval that holds 95 % should be.
  bool trustworthy() const;
};

/// The law at the values of its table, with a moderate dependence on current where the table has
/// one.
LawModel known_damper(const Law& law);
/// The motions, currents and sensors of the study.
BenchOptions recovery_bench(const RecoveryStudyOptions& options, int repetition);

/// One entry for each law. The same bits on any number of threads, but for the times. Throws Error
/// on an unknown law, Interrupted when stopped.
std::vector<LawRecovery> study_recovery(const RecoveryStudyOptions& options);

}  // namespace dashpot
