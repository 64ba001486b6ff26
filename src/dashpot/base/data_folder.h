#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot {

/// The folder `kind` of the data that come with Dashpot ("parameters", "dampers"): of
/// $DASHPOT_DATA, of the installation that the program or library is part of, or of the source that
/// it was built from.
std::filesystem::path data_folder(std::string_view kind);

/// Names without their ending of the files of that kind, in alphabetical order.
std::vector<std::string> data_names(std::string_view kind, std::string_view extension);

}  // namespace dashpot
