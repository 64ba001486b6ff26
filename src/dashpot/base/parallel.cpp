#include "dashpot/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <sched.h>
#include <thread>
#include <vector>

namespace dashpot {

int default_threads() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  // A farm inside a task would start threads on top of threads: inner loops run where they are.
  thread_local bool inside = false;
  const std::size_t wanted = inside ? 1 : static_cast<std::size_t>(threads > 0 ? threads : default_threads());
  const std::size_t workers = std::min(count, wanted);
  if (workers <= 1) {
    for (std::size_t k = 0; k < count; ++k) task(k);
    return;
  }
  std::atomic<std::size_t> next = 0;
  std::mutex guard;
  std::exception_ptr failure;
  std::size_t failed_at = count;
  const auto work = [&] {
    inside = true;
    for (std::size_t k; (k = next.fetch_add(1)) < count;) {
      try {
        task(k);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (k < failed_at) {
          failed_at = k;
          failure = std::current_exception();
        }
        next = count;  // start nothing more
      }
    }
    inside = false;
  };
  {
    std::vector<std::jthread> pool;
    for (std::size_t k = 1; k < workers; ++k) pool.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dashpot
