#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "command.h"
#include "console.h"
#include "dashpot/design/design_request.h"

namespace dashpot::cli {

/// `dashpot design --next`: which prototypes are to be built and recorded.
struct NextSettings {
  std::uint64_t count = 0;                   ///< 0: not asked
  std::vector<std::string> motions, levels;  ///< as of bench; none: of the family's recordings
};
std::vector<Option> next_options(NextSettings& settings);

/// Prints the drawings and writes them with the manifest of the recordings to come.
int run_next(const NextSettings& settings, const DesignRequest& request, const std::string& model,
             const std::string& folder, std::uint64_t seed, int threads, Console& console);

}  // namespace dashpot::cli
