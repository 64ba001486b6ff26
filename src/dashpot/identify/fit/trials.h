#pragma once
#include <functional>
#include <list>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/nets/train_bank.h"
#include "dashpot/drive.h"
#include "dashpot/record.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {

/// A part of the training records that a trial does without and is judged on.
struct BankTrial {
  std::vector<const BankRecord*> training, held_back;
};

/// The divisions of trial_folds() as fits of state networks take them.
class Trials {
 public:
  Trials(const std::vector<Record>& training, DriveUnit drive_unit);
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;

  const std::vector<BankTrial>& all() const { return trials_; }

  /// The price with which trials foretell best what was held back: the least sum of
  /// squares_left(trial, price).
  double best_price(
      std::span<const double> prices, int threads,
      const std::function<double(const BankTrial&, double price)>& squares_left) const;

 private:
  std::vector<const BankRecord*> keep(std::vector<BankRecord> records);

  std::list<std::vector<BankRecord>> kept_;  ///< what the trials point into
  std::vector<BankTrial> trials_;
};

}  // namespace dashpot
