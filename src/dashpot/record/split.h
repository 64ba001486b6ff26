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

/// What the dataset file states; else the strictest way that the records allow: by condition, current,
/// record, or the end of the only one.
LeaveOut default_leave_out(const Dataset& dataset);

/// Throws Error when the dataset cannot be divided so: one condition only, say; the message names
/// the ways that would work.
std::vector<Fold> split(const Dataset& dataset, const LeaveOut& leave_out);

/// Divides a training part once more, without a look at what is judged: by condition or current where that is
/// how the judged part was left out and several remain; else in three, of whole records where whole records
/// are judged and there are three, or of each record's time. Folds that would be empty are left away.
std::vector<Fold> hold_back(const std::vector<Record>& training, const LeaveOut& judged);

/// Divisions of a training part on which a fit tries what it must choose by itself. Conditions are dealt in
/// turn to four at most, and each inner level of the drive is held back; of records that have neither, the
/// last 30 %. One at least.
std::vector<Fold> trial_folds(const std::vector<Record>& training);

}  // namespace dashpot
