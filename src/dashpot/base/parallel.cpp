#include "dashpot/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <exception>
#include <mutex>
#include <sched.h>
#include <thread>
#include <utility>
#include <vector>

namespace dashpot {

int default_threads() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

namespace {

/// Hands out task numbers and keeps the exception of the lowest failing one.
class Farm {
 public:
  Farm(std::size_t count, const std::function<void(std::size_t)>& task)
      : count_(count), task_(task) {}

  void work() {
    for (std::size_t k; (k = next_.fetch_add(1)) < count_;) {
      try {
        task_(k);
      } catch (...) {
        keep(k, std::current_exception());
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void keep(std::size_t k, std::exception_ptr failure) {
    const std::lock_guard lock(guard_);
    next_ = count_;  // start nothing more
    if (k >= failed_at_) return;
    failed_at_ = k;
    failure_ = std::move(failure);
  }

  std::size_t count_;
  const std::function<void(std::size_t)>& task_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex guard_;
  std::exception_ptr failure_;
  std::size_t failed_at_ = static_cast<std::size_t>(-1);
};

// A farm inside a task would start threads on top of threads: inner loops run where they are.
thread_local bool inside_a_task = false;

/// CPU time of the threads that worked for this one.
thread_local double seconds_of_others = 0;

}  // namespace

double cpu_seconds() {
  timespec own{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &own);
  return static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec) +
         seconds_of_others;
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  const auto wanted =
      inside_a_task ? 1 : static_cast<std::size_t>(threads > 0 ? threads : default_threads());
  const std::size_t workers = std::min(count, wanted);
  if (workers <= 1) {
    for (std::size_t k = 0; k < count; ++k) task(k);
    return;
  }

  // Every thread, the calling one too, takes tasks until none is left.
  Farm farm(count, task);
  const auto work = [&farm] {
    inside_a_task = true;
    farm.work();
    inside_a_task = false;
  };

  // The calling thread waits here; the time of the others counts as its own.
  std::vector<double> spent(workers);
  {
    std::vector<std::jthread> pool;
    try {
      for (std::size_t k = 1; k < workers; ++k)
        pool.emplace_back([&work, &seconds = spent[k]] {
          work();
          seconds = cpu_seconds();
        });
    } catch (const std::exception&) {
      // The machine gives no more threads; those that there are do all of the work.
    }
    work();
  }
  for (const double seconds : spent) seconds_of_others += seconds;
  farm.rethrow();
}

}  // namespace dashpot
