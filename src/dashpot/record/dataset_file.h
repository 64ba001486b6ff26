#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/drive.h"

namespace dashpot {

/// How a channel is made from a column, as a dataset file states it: sample = sign * scale * (raw -
/// offset), in `unit`, then converted to SI.
struct ChannelStatement {
  std::string channel;    ///< a standard channel, "time", or a name of its own
  std::string column;     ///< name in the file; "" when `index` says which
  std::size_t index = 0;  ///< from 1; 0: by name
  std::string unit;       ///< "": from the name, else SI
  double scale = 1, offset = 0, sign = 1;
  bool centre = false;       ///< subtract the record's mean
  bool placed = false;       ///< 'offset' or 'centre' says where its zero is
  bool directed = false;     ///< 'sign' says which way is positive
  double moving_mass = 0;    ///< kg, of force: what moves between load cell and damper
  bool keeps_noise = false;  ///< of velocity: its noise stays
  std::string where;
};

/// Part of a record with a role of its own.
struct RoleStatement {
  Role role = Role::Training;
  std::optional<double> from, to, score_from;  ///< s
};

/// A drive level: a number, one number per part of the file, or a column of the manifest.
using LevelStatement = std::variant<std::monostate, double, std::vector<double>, std::string>;

/// A condition that stands in a column of the manifest.
struct ManifestCondition {
  std::string name, column;
  std::string unit;  ///< "": from the column's name
  std::string where;
};

/// The drawing of the damper that a record is of: a file beside the dataset file or, in a column of
/// the manifest, beside that; or a damper that comes with Dashpot.
struct DrawingStatement {
  std::string file, column;  ///< one of the two; both "": none is stated
  std::string where;
};

/// What a dataset file states about the files that one set of patterns matches. What it does not
/// state is inferred.
struct FileStatement {
  std::vector<std::string> match;  ///< patterns relative to the root: "*.csv"
  std::vector<ChannelStatement> channels;
  bool only_stated = false;                ///< columns that are not stated are not used
  std::optional<double> sample_time;       ///< s: time = row * sample_time
  std::optional<double> cut_from, cut_to;  ///< s
  bool cut_rest = false;                   ///< drop what comes before the motion starts
  std::optional<double> resample_hz;
  bool drop_bad_rows = false;     ///< 'on_bad_row: drop'
  double velocity_cutoff_hz = 0;  ///< 0: not stated
  std::string name;               ///< template of the record's name; "" : from the file's
  std::string condition;          ///< template; "" : inferred
  LevelStatement level;
  std::vector<std::pair<std::string, double>> conditions;  ///< SI
  std::vector<ManifestCondition> manifest_conditions;
  DrawingStatement drawing;
  std::vector<RoleStatement> roles;
  bool states_nothing = false;  ///< 'match' is all: read as without a dataset file
  std::string where;
};

/// A dataset file: what people state about recordings. docs/dataset-files.md explains every key.
/// One that nobody wrote (path "") matches every file and states nothing else.
struct DatasetFile {
  std::string path;  ///< "" when nothing was stated
  std::string name, citation;
  std::filesystem::path root;
  std::optional<DriveUnit> drive_unit;  ///< empty: inferred from the channels
  std::string manifest;                 ///< "" : manifest.csv when there is one
  std::optional<LeaveOut> leave_out;
  std::string recognise_file, recognise_sha256;
  std::vector<FileStatement> files;
  std::vector<std::string> notes;
};

/// Parses and checks; no recording is opened. Throws Error(file:line, ...) on an unknown key, unit,
/// role or number.
DatasetFile load_dataset_file(const std::filesystem::path& path);

/// The dataset files that ship with Dashpot: of $DASHPOT_DATA, the source tree or the installation.
std::vector<std::filesystem::path> shipped_dataset_files();

}  // namespace dashpot
