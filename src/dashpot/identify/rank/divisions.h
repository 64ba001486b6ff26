#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/split.h"

namespace dashpot {

/// Every set of records that a ranking fits a model on.
struct Divisions {
  std::vector<Fold> folds;
  std::vector<Fold> held_back;   ///< of the only fold's training, for the interval of the force
  bool is_one = false;           ///< a part is set aside for good: the fold's fit is the final one
  std::vector<Record> training;  ///< of the final fit
};
/// Throws Error when the dataset cannot be divided so.
Divisions divide(const Dataset& dataset, const LeaveOut& leave_out);

/// The records of each fit that a ranking makes of one model, the final one first.
std::vector<const std::vector<Record>*> fits_of(const Divisions& divisions);

}  // namespace dashpot
