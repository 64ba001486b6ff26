#pragma once
#include <filesystem>

#include "dashpot/record.h"

namespace dashpot {

/// Time and channels as columns "name [unit]", in SI, with nine digits.
void save_csv(const Record& record, const std::filesystem::path& path);

/// The same as vectors of a MATLAB 5 file, "time" and one per channel; units in the string "units".
void save_mat(const Record& record, const std::filesystem::path& path);

}  // namespace dashpot
