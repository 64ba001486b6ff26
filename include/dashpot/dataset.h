// Layer: record
#pragma once

// Recordings, read: files and folders become one Dataset in SI and Dashpot's signs, with a
// statement of how each column was understood. A program begins here with load_dataset().

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/monitor.h"
#include "dashpot/record.h"

namespace dashpot {

/// How one column of a file was understood.
struct ColumnReading {
  std::string file;
  std::string column;   ///< as the file names it
  std::string channel;  ///< "" when the column is not used
  std::string unit;     ///< as read: "mm"
  double factor = 1;    ///< sample_si = factor * (raw - raw_offset) ...
  double raw_offset = 0;
  /// "header", "stated in utfsm.yaml", "assumed SI: no unit given", "not used: ...".
  std::string basis;
};

struct SourceFile {
  std::string path;
  std::string sha256;
};

/// A file that gave no record, and the reason.
struct PassedOver {
  std::string file, why;
};

/// A record that something speaks against, and what, with its place: a channel that sticks, say.
struct Suspect {
  std::string record, why;
};

/// How records are left out to judge a model: always whole stretches of time, never samples picked
/// at random, since neighbouring samples of a recording are nearly the same.
struct LeaveOut {
  enum class By {
    Condition,  ///< one motion after the other
    Current,    ///< one drive level after the other
    Record,     ///< one record after the other
    Fraction,   ///< the end of every record
    Blocks,     ///< one block of the time of every record after the other
    Groups,     ///< conditions, or records where all have one, dealt to groups: one group after the
                ///< other
    Roles,      ///< the parts to which the dataset file gives the role "left_out"
    Each        ///< one combination of the conditions named in `values` after the other
  };
  By by = By::Condition;
  /// Which of them: levels (as texts), conditions or names of records. Empty: each one; for Current
  /// each inner level, since a model is not asked to extrapolate in current, and then all records
  /// whose drive varies, at once (by name: "varies"). For Each: names of
  /// conditions of the records, gap or viscosity; records that agree in all of them are left out
  /// together.
  std::vector<std::string> values;
  double fraction = 0.3;   ///< Fraction: share of every record's end that is left out, in (0, 1)
  std::size_t blocks = 5;  ///< Blocks: equal parts of every record's time, 2 or more
  std::size_t groups = 6;  ///< Groups: 2 or more
};

/// From "current", "current=0.87,1.98", "fraction=0.33", "blocks=5", "groups=6",
/// "each=gap,pole_length". Throws Error on an unknown way and on values that it does not take.
LeaveOut parse_leave_out(const std::string& text);
/// The text that parse_leave_out reads back as the same.
std::string format_leave_out(const LeaveOut& leave_out);

/// Records that are identified and judged together, in the order in which they are shown: by
/// condition, then by drive level.
struct Dataset {
  std::string name;
  std::string citation;
  DriveUnit drive_unit = DriveUnit::Ampere;  ///< "A" (channel current) or "V" (channel voltage)
  std::vector<Record> records;
  std::vector<SourceFile> files;
  std::vector<ColumnReading> readings;
  std::vector<PassedOver> passed_over;
  /// Files of a folder that are recordings by their format and could not be used: each with its
  /// error. Results are those of the others.
  std::vector<PassedOver> unread;
  /// Records that look damaged. They are used; whoever names a result names them, too.
  std::vector<Suspect> suspects;
  std::vector<std::string> notes;     ///< inferences and assumptions, in words
  std::optional<LeaveOut> leave_out;  ///< stated in the dataset file
};

/// How load_dataset looks for statements and derives velocity.
struct LoadOptions {
  /// "" : dataset.yaml beside the data, else a shipped one that recognises it.
  std::string dataset_file;
  bool recognise = true;          ///< look among the shipped dataset files
  double velocity_cutoff_hz = 0;  ///< 0: chosen from the sample rate and the motion, and stated
  Monitor monitor;
};

/// Reads files and folders (CSV, DAQ text, MAT, the family paper's JSON; each also as .gz, except
/// MAT) or a dataset file (.yaml) into one dataset, in SI and Dashpot's signs, with a velocity
/// channel on every record that has displacement or velocity.
///
/// A file that the caller named itself is read or refused; other
/// files of a folder may be passed over and then stand in `passed_over` with the reason, or cannot
/// be used and stand in `unread`. Several folders keep their own dataset.yaml. Throws Error on a
/// named file and on a statement that cannot be used, and where no file gave a record. The same
/// files give the same dataset, to the bit.
Dataset load_dataset(const std::vector<std::filesystem::path>& paths,
                     const LoadOptions& options = {});

/// The readings as a table for people: one line per column, then one per record.
std::string describe(const Dataset& dataset);

}  // namespace dashpot
