#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "dashpot/damper/inverse/history_network.h"
#include "dashpot/drive.h"
#include "dashpot/model_file.h"

namespace dashpot {

/// An inverse network with all that must travel with it: a versioned JSON file.
struct InverseFile {
  /// Its spacing stands in the file as the sample time, its currents as the domain's.
  InverseNetwork network;
  DriveUnit drive_unit = DriveUnit::Ampere;
  Domain domain;  ///< of what it was taught
  Provenance provenance;
  Value quality;  ///< figures on what it had not seen; may be null
};

/// Throws Error with file and key on anything unknown, missing or out of bounds.
InverseFile load_inverse(const std::filesystem::path& path);
/// Throws Error(where, ...) where the inverse gives another drive than the damper takes.
void require_drive(const InverseFile& file, DriveUnit taken, const std::string& where);
void save_inverse(const InverseFile& file, const std::filesystem::path& path);
InverseFile parse_inverse(std::string_view text, const std::string& source);
std::string format_inverse(const InverseFile& file);

}  // namespace dashpot
