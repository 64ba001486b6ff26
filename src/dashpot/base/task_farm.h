#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace dashpot {

class Store;

struct FarmReport {
  std::size_t found = 0;  ///< loads of `store` meanwhile that found a result; in a worker 0
  double wall_seconds = 0;
};

/// Calls task(n) for each n of `numbers`, each once, on up to `threads` threads (as parallel_for)
/// of this process and, under mpirun, of every other one (base/ranks.h): what a task makes goes
/// into `store`, and is there for all of them when this returns. Under mpirun every process comes
/// here with a store of the same basis and the same `work`, which says what else the tasks depend
/// on: a process that differs is refused. The numbers handed out are those of rank 0. The exception
/// of a task ends the work, in whatever process it is thrown.
FarmReport farm_out(std::span<const std::size_t> numbers, int threads, Store& store,
                    const std::string& work, const std::function<void(std::size_t)>& task);

}  // namespace dashpot
