#pragma once
#include <cstddef>
#include <functional>

namespace dashpot {

/// Threads to use when the caller asks for 0: the cores this process may run on, or its share of
/// them.
int default_threads();

/// From here on this process is one of so many that share all cores of the machine, where it has
/// not been given some of them alone.
void share_cores(std::size_t processes);

/// Calls task(0) ... task(count - 1), each once, on up to `threads` threads (0: default_threads()).
/// Tasks write only to their own slot, so results do not depend on the number of threads. The
/// exception of the lowest failing index is rethrown after all running tasks have ended.
///
/// The threads live on between calls. A task may call parallel_for itself: threads of the outermost
/// call that have nothing left to do help with it, so that there are never more at work than that
/// call asked for.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

/// CPU time of the calling thread, s, and of what it gave to other threads through parallel_for:
/// what work costs, whatever runs beside it. Differences count.
double cpu_seconds();

}  // namespace dashpot
