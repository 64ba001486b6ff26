#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/record.h"

namespace dashpot {

/// A record without one of the equal blocks that its scored samples are divided into.
struct BlockLeftOut {
  /// From the record's start to the block's end, scored on the block only: what comes before is its
  /// run-in.
  Record left_out;
  /// What lies before the block and what lies after it, as records of their own; an end of the
  /// record has one neighbour only. A model that begins in the middle of a motion takes a while to
  /// reach its state, so the part after the block has a run-in of its own: the record's warm-up or,
  /// where that is less, a twentieth of the record, and at most a quarter of the part. Neither part
  /// holds a sample of the block.
  std::vector<Record> training;
};

/// block: 0 ... blocks - 1. The record must have at least `blocks` samples behind its warm-up.
BlockLeftOut leave_out_block(const Record& record, std::size_t block, std::size_t blocks);

/// Samples of the record that a block has when there are so many of them.
std::size_t samples_per_block(const Record& record, std::size_t blocks);

}  // namespace dashpot
