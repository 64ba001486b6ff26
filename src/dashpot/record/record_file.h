#pragma once
#include <filesystem>

#include "dashpot/base/print_units.h"
#include "dashpot/record.h"

namespace dashpot {

/// Time and channels as columns "name [unit]", time with twelve digits and channels with nine. Goes
/// to a temporary name first, which is then renamed; throws Error when the file cannot be written.
void save_csv(const Record& record, const std::filesystem::path& path,
              const PrintUnits& units = PrintUnits::si());

/// The same in SI as vectors of a MATLAB 5 file, "time" and one per channel; units in the text
/// "units". All digits are kept. Throws Error when the file cannot be written.
void save_mat(const Record& record, const std::filesystem::path& path);

}  // namespace dashpot
