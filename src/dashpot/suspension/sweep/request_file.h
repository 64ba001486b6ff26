#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// YAML as docs/sweep.md describes; `folder`: where files that it names are looked for. Throws
/// Error that names file and line.
SweepRequest parse_sweep(std::string_view text, const std::string& source,
                         const std::filesystem::path& folder = {});
SweepRequest load_sweep(const std::filesystem::path& path);
/// One that comes with Dashpot, of data/sweeps.
SweepRequest named_sweep(const std::string& name);
std::vector<std::string> sweep_names();

}  // namespace dashpot
