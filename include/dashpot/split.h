// Layer: record
#pragma once

// Division of a dataset into folds: records to fit a model on, and records to judge it on.

#include <string>
#include <string_view>
#include <vector>

#include "dashpot/dataset.h"

namespace dashpot {

/// One division of a dataset: what a model is fitted on and what it is judged on. Both hold copies
/// of the records.
struct Fold {
  std::string name;  ///< "without 5 mm 3 Hz"
  std::vector<Record> training;
  std::vector<Record> left_out;  ///< judged from `warm_up` on
};

/// The name of the fold that leaves out all records whose drive varies.
inline constexpr std::string_view kWithoutVaryingDrive = "without records of varying drive";

/// The way that the dataset file states; else the strictest one that the records allow: by
/// condition, current, record, or five blocks of the only one, one after the other. More than six
/// conditions or records are dealt to six groups.
LeaveOut default_leave_out(const Dataset& dataset);

/// The folds of a dataset, in the order of its records or of the values asked for. Throws Error
/// when the dataset cannot be divided so, with one condition only, say; the message names the ways
/// that would work.
std::vector<Fold> split(const Dataset& dataset, const LeaveOut& leave_out);

}  // namespace dashpot
