#pragma once
#include <optional>
#include <span>
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
  std::string basis;     ///< "manifest.csv", "file name"
  bool of_name = false;  ///< a name's: a recorded drive goes before it
  std::string doubt;     ///< not empty: the name may mean two levels, so this one may not be used
  std::string note;      ///< how the name was read, where that is not plain
};

/// Everything that is known beside the table when it becomes a record.
struct BuildContext {
  const FileStatement* statement = nullptr;
  std::string stated_in;  ///< the dataset file's name, for the table of readings
  std::string name;       ///< of the record
  std::optional<KnownLevel> level;
  double velocity_cutoff_hz = 0;  ///< the caller's; 0: not stated
  /// The motion is left as it is given: nothing is integrated and no stroke centred, since models
  /// will be asked about other arrays like these.
  bool as_given = false;
};

/// The level of a drive that stands as a single number beside the columns, as 'current_A' of a MAT
/// file; in doubt where two such numbers differ. A name of one letter without a unit is none: it is
/// too often another thing.
std::optional<KnownLevel> level_of_scalars(const RawTable& table);

struct BuiltRecord {
  Record record;
  std::vector<ColumnReading> readings;
  std::optional<double> centred;  ///< m, subtracted from an absolute stroke
  std::string drive_note;         ///< how the drive was found, where sources do not agree
  std::string refusal;            ///< not empty: why this table is not a recording of a damper
};

/// The one way from the tables of a file to records in SI: channels and signs, time base, cuts,
/// resampling, centring, velocity, displacement, drive level. Every later room takes a Record for
/// granted: uniform or increasing time, all channels equally long, velocity present.
///
/// `stretches` are the parts of one recording between gaps in its time, one in most (stretches.h):
/// they share their columns, and the sign of the force and every centre are found over all of them.
/// One context per stretch; all but name and level are those of the first.
///
/// Takes the tables' columns, so that a long recording is in memory once. Throws Error(file:line,
/// ...) on numbers that cannot be used, and Error(file, ...) on time, units or cuts that cannot be;
/// tables that merely are no damper recording are no error but a `refusal` of the first.
std::vector<BuiltRecord> build_records(std::vector<RawTable> stretches,
                                       std::span<const BuildContext> contexts);

}  // namespace dashpot
