#pragma once
#include <functional>
#include <span>
#include <vector>

#include "dashpot/damper/neural/train_bank.h"
#include "dashpot/record/record.h"

namespace dashpot {

/// A part of the training records that a trial does without and is judged on.
struct Trial {
  std::vector<const BankRecord*> training, held_back;
};

/// Parts that are held back: conditions, dealt out in turn, and each inner level of the drive; records that
/// have neither are cut, and their ends are held back. Points into `records`.
class Trials {
 public:
  Trials(const std::vector<Record>& training, const std::vector<BankRecord>& records);
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;

  const std::vector<Trial>& all() const { return trials_; }

  /// The price with which trials foretell best what was held back: the least sum of
  /// squares_left(trial, price).
  double best_price(std::span<const double> prices, int threads,
                    const std::function<double(const Trial&, double price)>& squares_left) const;

 private:
  void hold_back(const std::vector<BankRecord>& records, const std::function<bool(std::size_t)>& chosen);
  void cut(const std::vector<BankRecord>& records);

  std::vector<Trial> trials_;
  std::vector<BankRecord> cuts_;
};

}  // namespace dashpot
