#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::studio {

/// What a child may take; 0: no limit.
struct ChildLimits {
  std::size_t memory = 0;       ///< bytes of address space
  std::size_t cpu_seconds = 0;  ///< of all its threads
  std::size_t file = 0;         ///< bytes of a file that it writes
};

/// How a child ended.
struct ChildEnd {
  int exit_code = -1;  ///< 128 + signal when it was killed by one
  std::string out;     ///< what it printed on stdout
  std::string err;     ///< the end of what it printed on stderr
};

/// This program with these arguments (one by one: there is no shell), in `folder`, ended with the
/// thread that calls. `on_line` gets each line of stderr as it comes; `pid` holds the child's id
/// while it runs, 0 before and after. Returns when it has ended. Throws Error where it cannot be
/// started.
ChildEnd run_self(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                  const ChildLimits& limits,
                  const std::function<void(std::string_view)>& on_line = {},
                  std::atomic<int>* pid = nullptr);

}  // namespace dashpot::studio
