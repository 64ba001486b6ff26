#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/evaluate.h"

namespace dashpot {

/// Scored samples first ... last - 1 of a left-out record.
struct LeftOutPart {
  const RecordResult* record;
  std::size_t first, last;
};

inline constexpr std::size_t kLeastUnits = 5;  ///< fewer records are cut into stretches

/// The records that were left out at once, as parts of which each can be compared with the others:
/// all scored samples of a record, or, where there are fewer records than kLeastUnits, as many
/// equal stretches of each as give that many parts. In the order of records and time.
std::vector<LeftOutPart> left_out_parts(const std::vector<RecordResult>& left_out);

}  // namespace dashpot
