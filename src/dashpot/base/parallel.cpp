#include "dashpot/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <ctime>
#include <exception>
#include <mutex>
#include <pthread.h>
#include <sched.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace dashpot {

namespace {

std::atomic<int> sharing_processes = 1;

}  // namespace

int default_threads() {
  const auto all = static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  cpu_set_t allowed;
  const int own = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : all;
  return std::max(1, own < all ? own : all / sharing_processes);
}

void share_cores(std::size_t processes) {
  sharing_processes = static_cast<int>(std::max<std::size_t>(1, processes));
}

namespace {

/// CPU time of the threads that worked for this one.
thread_local double seconds_of_others = 0;

/// One parallel_for: hands out task numbers and keeps the exception of the lowest failing one.
class Farm {
 public:
  Farm(std::size_t count, const std::function<void(std::size_t)>& task, std::size_t threads,
       Farm* outer)
      : root(outer ? outer->root : this), most_helpers(threads - 1), count_(count), task_(task) {}

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

  std::size_t count() const { return count_; }

  /// Whether a further thread may come and finds something to do. Under the pool's lock.
  bool wants_help() const {
    return next_ < count_ && helpers < most_helpers && root->helpers_below < root->most_helpers;
  }

  // What the pool knows of it, under the pool's lock.
  Farm* const root;                ///< the outermost farm of which this is a part
  const std::size_t most_helpers;  ///< threads beside the one that called
  std::size_t helpers = 0;         ///< at work here
  std::size_t helpers_below = 0;   ///< of a root: at work here and in all farms inside
  double seconds = 0;              ///< CPU time of those that have left

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

/// The innermost farm whose task this thread does.
thread_local Farm* current_farm = nullptr;

/// Does tasks of a farm until none is left, on whatever thread this is.
void work_in(Farm& farm) {
  Farm* const outer = std::exchange(current_farm, &farm);
  farm.work();
  current_farm = outer;
}

/// Threads that wait for farms as long as the program lives. The farm that was opened first is
/// helped first: where its tasks are all taken, what would wait for the last of them helps with the
/// farms inside these. Never are more threads at work for an outermost farm than it asked for.
class Pool {
 public:
  Pool() = default;
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  ~Pool() {
    {
      const std::lock_guard lock(guard_);
      ends_ = true;
    }
    wanted_.notify_all();
  }  // and the threads are joined

  /// Does all tasks; the caller works too, and waits for the others in the end. Their CPU time
  /// counts as its own.
  void run(Farm& farm) {
    open(farm);
    work_in(farm);
    close(farm);
    seconds_of_others += farm.seconds;
  }

 private:
  void open(Farm& farm) {
    std::size_t called = 0;
    {
      const std::lock_guard lock(guard_);
      farms_.push_back(&farm);
      if (farm.root == &farm) need(farm.most_helpers);
      called = std::min({idle_, farm.most_helpers, farm.count() - 1});
    }
    for (; called > 0; --called) wanted_.notify_one();
  }

  void close(Farm& farm) {
    std::unique_lock lock(guard_);
    std::erase(farms_, &farm);
    if (farm.root == &farm) needed_ -= farm.most_helpers;
    left_.wait(lock, [&] { return farm.helpers == 0; });
  }

  /// Starts threads where fewer live than farms of different callers ask for together; never so
  /// many that other programs of the machine could start none.
  void need(std::size_t helpers) {
    constexpr std::size_t kMostThreads = 512;
    needed_ += helpers;
    try {
      while (threads_.size() < std::min(needed_, kMostThreads))
        threads_.emplace_back([this] { help(); });
    } catch (const std::exception&) {
      // The machine gives no more threads; those that there are do all of the work.
    }
  }

  /// What a thread of the pool does.
  void help() {
    std::unique_lock lock(guard_);
    while (!ends_) {
      const auto found =
          std::ranges::find_if(farms_, [](const Farm* farm) { return farm->wants_help(); });
      if (found == farms_.end()) {
        ++idle_;
        wanted_.wait(lock);
        --idle_;
        continue;
      }

      Farm& farm = **found;
      ++farm.helpers;
      ++farm.root->helpers_below;
      lock.unlock();
      const double begin = cpu_seconds();
      work_in(farm);
      const double spent = cpu_seconds() - begin;
      lock.lock();
      farm.seconds += spent;
      --farm.root->helpers_below;
      if (--farm.helpers == 0) left_.notify_all();
    }
  }

  std::mutex guard_;
  std::condition_variable wanted_, left_;  ///< a farm has come; a farm's last helper has left
  std::vector<Farm*> farms_;               ///< in the order in which they were opened
  std::size_t idle_ = 0, needed_ = 0;
  bool ends_ = false;
  std::vector<std::jthread> threads_;  ///< the last member: the others outlive them
};

std::atomic<Pool*> the_pool = nullptr;

/// Ends the threads with the program, or when a library is unloaded that holds this code.
struct PoolEnd {
  ~PoolEnd() { delete the_pool.exchange(nullptr); }
} const pool_end;

Pool& pool() {
  static std::mutex guard;
  if (Pool* there = the_pool) return *there;
  const std::lock_guard lock(guard);
  if (!the_pool) {
    // A child that was forked has none of the threads: it begins without a pool.
    static const int kForked = pthread_atfork(nullptr, nullptr, [] { the_pool = nullptr; });
    static_cast<void>(kForked);
    the_pool = new Pool;
  }
  return *the_pool;
}

}  // namespace

double cpu_seconds() {
  timespec own{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &own);
  return static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec) +
         seconds_of_others;
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  const auto wanted = static_cast<std::size_t>(threads > 0 ? threads : default_threads());
  if (std::min(count, wanted) <= 1) {
    for (std::size_t k = 0; k < count; ++k) task(k);
    return;
  }
  Farm farm(count, task, wanted, current_farm);
  pool().run(farm);
  farm.rethrow();
}

}  // namespace dashpot
