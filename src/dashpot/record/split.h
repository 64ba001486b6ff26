#pragma once
#include <string>
#include <vector>

#include "dashpot/record/dataset.h"

namespace dashpot {

/// One division of a dataset: what a model is fitted on and what it is judged on.
struct Fold {
  std::string name;  ///< "without 5 mm 3 Hz"
  std::vector<Record> training;
  std::vector<Record> left_out;  ///< judged from `warm_up` on
};

/// Throws Error when the dataset cannot be divided so: one condition only, say; the message names
/// the ways that would work.
std::vector<Fold> split(const Dataset& dataset, const LeaveOut& leave_out);

}  // namespace dashpot
