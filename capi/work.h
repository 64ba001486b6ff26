#pragma once
#include <functional>

#include "dashpot.h"
#include "dashpot/monitor.h"

namespace dashpot::capi {

/// Runs `work`; with a monitor on a thread of its own, while the calling one keeps asking the
/// caller whether to go on, so that callbacks come from it alone. Rethrows what `work` throws.
void run_watched(const dashpot_monitor* monitor, const std::function<void(const Monitor&)>& work);

}  // namespace dashpot::capi
