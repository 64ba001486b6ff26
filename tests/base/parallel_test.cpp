#include "dashpot/base/parallel.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <vector>

#include <sys/wait.h>

#include "dashpot/error.h"
#include "dashpot/monitor.h"
#include "support.h"

using namespace dashpot;

namespace {

std::ptrdiff_t threads_now() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

}  // namespace

TEST_CASE("every task runs once, on any number of threads") {
  for (const int threads : {0, 1, 3, 16}) {
    std::vector<int> slots(1000, 0);
    parallel_for(slots.size(), threads, [&](std::size_t k) { slots[k] += 1; });
    CHECK(std::accumulate(slots.begin(), slots.end(), 0) == 1000);
  }
}

TEST_CASE("farms may be nested") {
  std::atomic<int> count = 0;
  parallel_for(4, 4, [&](std::size_t) { parallel_for(10, 4, [&](std::size_t) { ++count; }); });
  CHECK(count == 40);
}

TEST_CASE("nested farms use no more threads than the outermost asked for, and its idle ones") {
  std::atomic<int> at_work = 0, most = 0, inner_threads = 0;
  const auto count_in = [&] {
    const int now = ++at_work;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
  };
  parallel_for(16, 16, [](std::size_t) {});  // so that there are more threads than may be used
  parallel_for(3, 3, [&](std::size_t k) {
    if (k != 0) return;  // two threads have nothing to do soon
    std::mutex guard;
    std::set<std::thread::id> seen;
    parallel_for(30, 0, [&](std::size_t) {
      count_in();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      --at_work;
      const std::lock_guard lock(guard);
      seen.insert(std::this_thread::get_id());
    });
    inner_threads = static_cast<int>(seen.size());
  });
  CHECK(most <= 3);
  if (default_threads() > 1) CHECK(inner_threads > 1);
}

TEST_CASE("threads live on: a thousand farms start none") {
  parallel_for(8, 4, [](std::size_t) {});
  const auto before = threads_now();
  std::set<std::thread::id> seen;
  std::mutex guard;
  for (int k = 0; k < 1000; ++k)
    parallel_for(8, 4, [&](std::size_t) {
      const std::lock_guard lock(guard);
      seen.insert(std::this_thread::get_id());
    });
  CHECK(threads_now() == before);
  CHECK(seen.size() <= static_cast<std::size_t>(before));
}

TEST_CASE("a child that was forked works without the threads of its parent") {
  parallel_for(8, 4, [](std::size_t) {});
  const pid_t child = fork();
  if (child == 0) {
    std::atomic<int> count = 0;
    parallel_for(10, 4, [&](std::size_t) { ++count; });
    _exit(count == 10 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("a million threads are as many as a machine can bear") {
  std::atomic<int> count = 0;
  parallel_for(1000, 1000000, [&](std::size_t) { ++count; });
  CHECK(count == 1000);
  CHECK(threads_now() <= 600);
}

TEST_CASE("the exception of the lowest index comes out") {
  const auto run = [] {
    parallel_for(8, 4,
                 [](std::size_t k) { throw std::runtime_error("task " + std::to_string(k)); });
  };
  CHECK(message_of(run) == "task 0");
}

TEST_CASE("a monitor stops work") {
  std::atomic<bool> stop = false;
  double seen = 0;
  const Monitor monitor{[&](const Progress& p) { seen = p.fraction; }, &stop};
  monitor.report("half", 0.5);
  CHECK(seen == 0.5);
  stop = true;
  CHECK_THROWS_AS(monitor.check(), Interrupted);
}

TEST_CASE("CPU time counts the threads that worked for this one, and no waiting") {
  std::atomic<double> sink = 0;
  const auto work = [&](std::size_t) {
    double x = 1;
    for (int k = 0; k < 3000000; ++k) x = x * 1.0000001 + 1e-9;
    sink = x;
  };
  const auto cost = [&](int threads) {
    const double begin = cpu_seconds();
    parallel_for(8, threads, work);
    return cpu_seconds() - begin;
  };
  const double one = cost(1), four = cost(4);
  CHECK(one > 0);
  // Threads that share a core or its caches run slower, never four times cheaper.
  CHECK(four > one / 2);
  CHECK(four < one * 4);
  const double begin = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  CHECK(cpu_seconds() - begin < 0.02);
}
