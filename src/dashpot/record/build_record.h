#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/drive.h"
#include "dashpot/record.h"
#include "dashpot/record/columns.h"

namespace dashpot {

/// A drive level that is known from beside the table.
struct KnownLevel {
  double value = 0;
  DriveUnit unit = DriveUnit::Ampere;
  std::string basis;  ///< "manifest.csv", "file name"
};

/// What a table is turned into a record with.
struct BuildContext {
  const FileStatement* statement = nullptr;
  std::string stated_in;  ///< the dataset file's name, for the table of readings
  std::string name;       ///< of the record
  std::optional<KnownLevel> level;
  double velocity_cutoff_hz = 0;  ///< the caller's; 0: not stated
};

struct BuiltRecord {
  Record record;
  std::vector<ColumnReading> readings;
  std::string refusal;  ///< not empty: why this table is not a recording of a damper
};

/// Table -> record in SI: channels, signs, time base, cuts, velocity. Takes the table's columns.
/// Throws Error(file:line, ...) on numbers that cannot be used.
BuiltRecord build_record(RawTable table, const BuildContext& context);

}  // namespace dashpot
