#pragma once
#include "dashpot/export/c/c_block.h"
#include "dashpot/suspension/observe/plant_observer.h"

namespace dashpot {

/// A plant's observer as a block: at each sample what is measured goes in, and each damper's force,
/// its standard deviation, the damper's motion and the plant's state come out. The filter is the
/// library's text, and the dampers are all alike; `origin` says in sentences where they come from
/// and what is known against them. Throws Error where their model has no C code.
CBlock c_observer_block(const PlantObserver& observer, const ObserverNames& names,
                        const std::string& origin, const ExportOptions& options);

}  // namespace dashpot
