#pragma once
#include <string>
#include <string_view>

namespace dashpot {

/// The bytes of a file that dashpot-hdf5 makes of a request, "write-mat" or "write-hdf5": the
/// libraries that do so are loaded where they are needed, and nowhere else. Throws Error where it
/// cannot be made.
std::string made_file(const std::string& how, std::string_view request);

}  // namespace dashpot
