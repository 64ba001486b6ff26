#pragma once
#include <functional>
#include <list>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/nets/free_run_record.h"
#include "dashpot/drive.h"
#include "dashpot/record.h"

namespace dashpot {

/// A part of the training records that a trial does without and is judged on.
struct FreeRunTrial {
  std::vector<const FreeRunRecord*> training, held_back;
};

/// The divisions of trial_folds() as fits of models with states of their own take them.
class Trials {
 public:
  Trials(const std::vector<Record>& training, DriveUnit drive_unit);
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;

  const std::vector<FreeRunTrial>& all() const { return trials_; }

  /// The weight decay with which trials predict best what was held back: the least sum of
  /// squares_left(trial, decay).
  double best_decay(
      std::span<const double> decays, int threads,
      const std::function<double(const FreeRunTrial&, double decay)>& squares_left) const;

 private:
  std::vector<const FreeRunRecord*> keep(std::vector<FreeRunRecord> records);

  std::list<std::vector<FreeRunRecord>> kept_;  ///< what the trials point into
  std::vector<FreeRunTrial> trials_;
};

}  // namespace dashpot
