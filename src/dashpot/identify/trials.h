#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/record/record.h"

namespace dashpot {

/// Samples of a record that count; a model runs through the record from its beginning.
struct ScoredPart {
  std::size_t record = 0;           ///< its place among the training records
  std::size_t first = 0, last = 0;  ///< first ... last - 1
};
using ScoredParts = std::vector<ScoredPart>;

/// A part of the training records that a trial does without and is judged on: how a setting is chosen
/// without the left-out records.
struct Trial {
  ScoredParts training, held_back;
};

/// All samples behind the records' warm-ups.
ScoredParts all_parts(const std::vector<Record>& records);

/// What is held back in turn: conditions, dealt to at most four trials, and each inner level of the drive.
/// Records that have neither are cut, and their ends are held back.
std::vector<Trial> trials_of(const std::vector<Record>& training);

}  // namespace dashpot
