#pragma once
#include <string>
#include <vector>

#include "dashpot/base/print_units.h"
#include "dashpot/dataset.h"

namespace dashpot {

/// As describe(dataset), with the records' extents in the units given.
std::string describe(const Dataset& dataset, const PrintUnits& units);

/// Files whose columns were understood alike.
struct FilesAlike {
  std::vector<std::string> files;      ///< names without their folders, one at least
  std::vector<ColumnReading> columns;  ///< of the first of them

  std::string heading() const;  ///< "run_1.csv and 3 more like it"
};
/// In the order of the first file of each.
std::vector<FilesAlike> files_alike(const std::vector<ColumnReading>& readings);

}  // namespace dashpot
