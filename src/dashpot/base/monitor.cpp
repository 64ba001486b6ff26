#include "dashpot/monitor.h"

#include <mutex>

#include "dashpot/error.h"

namespace dashpot {

void Monitor::check() const {
  if (stop && stop->load(std::memory_order_relaxed)) throw Interrupted();
}

void Monitor::report(const std::string& stage, double fraction) const {
  check();
  if (!on_progress) return;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  on_progress({stage, fraction});
}

}  // namespace dashpot
