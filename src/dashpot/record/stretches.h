#pragma once
#include <string>
#include <vector>

#include "dashpot/record/dataset_file.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// The rows of a table that can be used, as one table or as several where time has gaps: rows at
/// the end without samples are left out, as are bad rows where the statement says 'on_bad_row:
/// drop', and a gap of more than 5 median steps ends one table and begins the next, since nothing
/// is known of what lies in it. Stretches outside the stated cut, and those of fewer than 20
/// samples, are left out. Every rule that was used is a note of the tables. A table without gaps
/// and bad rows comes back as it is. Throws Error where only stretches that are too short are left.
std::vector<RawTable> usable_stretches(RawTable table, const FileStatement& statement,
                                       const std::string& stated_in);

}  // namespace dashpot
