#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// The published data set of the paper on families of dampers: NAME.json holds, per damper, one
/// record per field level (time s, velocity mm/s, displace mm, force N); inp_NAME.json beside it
/// holds each damper's viscosity, yield stress per level, areas, gap and pole length, which become
/// conditions. The values are believed, not the damper's name: "03L" has a length of 6 mm.
/// The documented layout, one file in SI with English keys (docs/dataset-files.md):
///   {"dampers": [{"name": "a", "gap": 0.001, ..., "levels": [{"current": 0.5, "time": [...],
///   ...}]}]}
bool is_family_json(const std::filesystem::path& path, std::string_view extension,
                    std::string_view head);
std::vector<RawTable> read_family_json(const std::filesystem::path& path);

}  // namespace dashpot
