#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/base/monitor.h"
#include "dashpot/record/leave_out.h"
#include "dashpot/record/record.h"

namespace dashpot {

/// How one column of a file was understood.
struct ColumnReading {
  std::string file;
  std::string column;   ///< as the file names it
  std::string channel;  ///< "" when the column is not used
  std::string unit;     ///< as read: "mm"
  double factor = 1;    ///< sample_si = factor * (raw - raw_offset) ...
  double raw_offset = 0;
  std::string
      basis;  ///< "header", "stated in utfsm.yaml", "assumed SI: no unit given", "not used: ..."
};

struct SourceFile {
  std::string path;
  std::string sha256;
};

/// A file that gave no record, and why.
struct PassedOver {
  std::string file, why;
};

/// Records that are identified and judged together, in the order in which they are shown: by
/// condition, then by drive level.
struct Dataset {
  std::string name;
  std::string citation;
  std::string drive_unit = "A";  ///< "A" (channel current) or "V" (channel voltage)
  std::vector<Record> records;
  std::vector<SourceFile> files;
  std::vector<ColumnReading> readings;
  std::vector<PassedOver> passed_over;
  std::vector<std::string> notes;     ///< what was inferred or assumed, in words
  std::optional<LeaveOut> leave_out;  ///< stated in the dataset file
};

/// How load_dataset looks for statements and derives velocity.
struct LoadOptions {
  std::string
      dataset_file;  ///< "" : dataset.yaml beside the data, else a shipped one that recognises it
  bool recognise = true;          ///< look among the shipped dataset files
  double velocity_cutoff_hz = 0;  ///< 0: chosen from the sample rate and the motion, and stated
  Monitor monitor;
};

/// Reads files and folders (CSV, DAQ text, MAT, the family paper's JSON; each also as .gz, except
/// MAT) or a dataset file (.yaml) into one dataset, in SI and Dashpot's signs, with a velocity
/// channel on every record that has displacement or velocity.
///
/// A file that the caller named itself, or that a dataset file states, is read or refused; other
/// files of a folder may be passed over and then stand in `passed_over` with the reason. Throws
/// Error on anything that cannot be used. The same files give the same dataset, to the bit.
Dataset load_dataset(const std::vector<std::filesystem::path>& paths,
                     const LoadOptions& options = {});

/// The table of what was understood, for people: one line per column, then per record.
std::string describe(const Dataset& dataset);

}  // namespace dashpot
