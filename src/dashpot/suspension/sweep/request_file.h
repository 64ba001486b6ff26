#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// Reads a request in YAML, as docs/sweep.md describes it. source: the file's name, for messages.
/// folder: where the files that it names are looked for. Throws Error that names file and line.
SweepRequest parse_sweep(std::string_view text, const std::string& source,
                         const std::filesystem::path& folder = {});
SweepRequest load_sweep(const std::filesystem::path& path);
/// A request that comes with Dashpot, in data/sweeps.
SweepRequest named_sweep(const std::string& name);
std::vector<std::string> sweep_names();

}  // namespace dashpot
