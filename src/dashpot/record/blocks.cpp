#include "dashpot/record/blocks.h"

#include <algorithm>

namespace dashpot {

std::size_t samples_per_block(const Record& record, std::size_t blocks) {
  return (record.size() - std::min(record.warm_up, record.size())) / blocks;
}

BlockLeftOut leave_out_block(const Record& record, std::size_t block, std::size_t blocks) {
  constexpr std::size_t kRunIn = 20, kLeastScored = 4;  // a twentieth; a quarter
  const std::size_t scored = record.size() - std::min(record.warm_up, record.size());
  const std::size_t from = record.warm_up + scored * block / blocks;
  const std::size_t to = record.warm_up + scored * (block + 1) / blocks;

  // The block, run from the record's start.
  BlockLeftOut divided{.left_out = record.slice(0, to), .training = {}};
  divided.left_out.warm_up = from;

  // Its neighbours.
  if (block > 0) divided.training.push_back(record.slice(0, from));
  if (block + 1 < blocks) {
    Record after = record.slice(to, record.size());
    const std::size_t run_in = std::max(record.warm_up, record.size() / kRunIn);
    after.warm_up = std::min(run_in, after.size() / kLeastScored);
    divided.training.push_back(std::move(after));
  }
  return divided;
}

}  // namespace dashpot
