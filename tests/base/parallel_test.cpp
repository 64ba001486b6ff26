#include "dashpot/base/parallel.h"

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "dashpot/base/error.h"
#include "dashpot/base/monitor.h"
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
    parallel_for(8, 4, [](std::size_t k) { throw std::runtime_error("task " + std::to_string(k)); });
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
