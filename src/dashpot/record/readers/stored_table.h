#pragma once
#include <string>

#include "dashpot/record/readers/stored_arrays.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// How a note names an array: "dataset", "40".
struct ArrayWords {
  std::string kind, size;
};

/// One table of the arrays that share the commonest length, wherever they lie: a matrix is as many
/// columns, "F(1)". Single numbers stand beside it; a note tells of each of the rest.
RawTable stored_table(const std::string& file, StoredArrays all,
                      ArrayWords (*described)(const StoredArray&));

}  // namespace dashpot
