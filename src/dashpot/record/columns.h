#pragma once
#include <string>
#include <vector>

#include "dashpot/record/dataset_file.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A column that is used, and how: sample_si = factor * (raw - raw_offset).
struct ColumnUse {
  std::size_t column = 0;
  std::string channel;
  std::string unit;     ///< as read
  std::string si_unit;  ///< as stored
  double factor = 1, raw_offset = 0;
  bool centre = false;
  bool directed = false;  ///< 'sign' was stated
  bool placed = false;    ///< 'offset' or 'centre' was stated
  bool stated = false;
  double moving_mass = 0;    ///< kg, between load cell and damper
  bool keeps_noise = false;  ///< of a velocity: the displacement takes nothing off
  std::string basis;
};

struct ColumnUses {
  std::vector<ColumnUse> used;                              ///< one per channel
  std::vector<std::pair<std::size_t, std::string>> unused;  ///< column, why
};

/// Decides what every column of a table is: by the statements and, where these are silent, by its
/// name. Channels appear once. `stated_in` names the dataset file in messages. Throws Error when a
/// stated column is missing, a channel is stated twice or two different columns claim one channel.
ColumnUses understand_columns(const RawTable& table, const FileStatement& statement,
                              const std::string& stated_in);

}  // namespace dashpot
