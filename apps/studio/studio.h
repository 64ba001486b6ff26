#pragma once
#include <functional>
#include <string>

namespace dashpot::studio {

struct StudioOptions {
  std::string folder = ".";
  int port = 0;  ///< 0: a free one
};

/// Serves the studio of a folder to this machine until `stop` says true. `ready` gets the address
/// to open, with its token. Throws Error where the folder or the port cannot be had.
void run_studio(const StudioOptions& options, const std::function<void(const std::string&)>& ready,
                const std::function<bool()>& stop);

}  // namespace dashpot::studio
