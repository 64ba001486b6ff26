#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/record.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// What was measured on a plant: channels of any name on one uniform time base, in SI. Unlike a
/// bench's Record it need hold neither a force nor a motion of the damper.
struct PlantRecording {
  std::string name;         ///< of its file
  double sample_time = 0;   ///< s
  std::size_t samples = 0;  ///< of each channel
  std::vector<Channel> channels;
  std::vector<std::string> without_unit;   ///< channels whose columns stated none
  std::vector<std::string> unread_drives;  ///< columns in A or V that nobody asked for

  /// Throws Error that names the channels there are.
  const Channel& channel(std::string_view wanted) const;
};

/// Samples of a recording from `first` on, before `end`.
struct SampleRange {
  std::size_t first = 0, end = 0;
  std::size_t length() const { return end - first; }
};

/// Reads one table of any format that recordings come in. Column names hold their units:
/// "excitation [N]" or "excitation (N)"; one without a unit is taken as SI and says so in its
/// origin. Time comes from a column "time" or "t", in s unless it says else. Throws Error on a file
/// of several tables, on stamps that are not uniform, and, where a column is used (`wanted`), on
/// a cell that is no number or a column that is not there; columns of `also` may be missing.
PlantRecording read_plant_recording(const std::filesystem::path& path,
                                    const std::vector<std::string>& wanted,
                                    const std::vector<std::string>& also = {});

/// Which of their channels stated no unit, in a sentence; empty: all stated one.
std::string without_units(std::span<const PlantRecording> recordings);

/// Which of their columns in A or V nobody asked for, as nothing that drives a damper by its
/// plant's file, in a sentence; empty: none.
std::string unread_drives(std::span<const PlantRecording> recordings);

/// The same of a table that is at hand.
PlantRecording plant_recording(RawTable table, const std::vector<std::string>& wanted,
                               const std::vector<std::string>& also = {});

}  // namespace dashpot
