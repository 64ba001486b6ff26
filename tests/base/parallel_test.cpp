#include "dashpot/base/parallel.h"

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "dashpot/error.h"
#include "dashpot/monitor.h"
#include "support.h"

using namespace dashpot;

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
