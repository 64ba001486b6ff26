#include "dashpot/monitor.h"

#include <mutex>

#include "dashpot/error.h"

namespace dashpot {

void Monitor::check() const {
  if (stop && stop->load(std::memory_order_relaxed)) throw Interrupted();
}

namespace {

std::mutex one_at_a_time;

}  // namespace

// The parameter is what is being done now; a monitor's own stage is that of its fit.
void Monitor::report(const std::string& now, double fraction) const {
  check();
  if (!on_progress) return;
  const std::lock_guard lock(one_at_a_time);
  on_progress({now, fraction});
}

void Monitor::report_cost(double cost) const {
  check();
  if (!on_cost) return;
  const std::lock_guard lock(one_at_a_time);
  on_cost(stage, cost);
}

}  // namespace dashpot
