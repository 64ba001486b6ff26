#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot {

/// The folder `kind` of the data that come with Dashpot ("parameters", "dampers"): of
/// $DASHPOT_DATA, of the installation that the program or library is part of, or of the source that
/// it was built from. Throws Error where $DASHPOT_DATA is stated and no folder.
std::filesystem::path data_folder(std::string_view kind);

/// A program that Dashpot starts for work of its own, such as "dashpot-hdf5": in $DASHPOT_PROGRAMS;
/// beside the program or library that runs, or in the lib/dashpot of its installation; in the build
/// that it comes from; or where it was to be installed. Throws Error where it is nowhere.
std::filesystem::path own_program(const std::string& name);

/// Names without their ending of the files of that kind, in alphabetical order.
std::vector<std::string> data_names(std::string_view kind, std::string_view extension);

}  // namespace dashpot
