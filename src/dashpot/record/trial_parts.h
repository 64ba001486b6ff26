#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/split.h"

namespace dashpot {

/// Divides a training part once more, without a look at what is judged: by condition or current
/// where that is how the judged part was left out and several remain; else in six, of whole records
/// where whole records are judged and there are three at least, or of each record's time. Folds
/// that would be empty are left away.
std::vector<Fold> hold_back(const std::vector<Record>& training, const LeaveOut& judged);

/// Samples first ... last - 1 of a record that count; a model runs through the record from its
/// beginning.
struct ScoredPart {
  std::size_t record = 0;  ///< its place among the training records
  std::size_t first = 0, last = 0;
};
using ScoredParts = std::vector<ScoredPart>;
/// All samples behind the records' warm-ups.
ScoredParts all_parts(const std::vector<Record>& records);

/// A part of the training records that a trial does without and is judged on.
struct TrialParts {
  ScoredParts training, held_back;
};
/// Divisions of a training part on which a fit tries what it must choose by itself. Conditions are
/// dealt in turn to at most four groups, each held back once; so is each inner level of the drive.
/// Of records that have neither, the last 30 % are held back. At least one.
std::vector<TrialParts> trial_parts(const std::vector<Record>& training);
/// The same with copies of the records.
std::vector<Fold> trial_folds(const std::vector<Record>& training);

}  // namespace dashpot
