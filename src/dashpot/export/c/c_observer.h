#pragma once
#include "dashpot/export/c/c_block.h"
#include "dashpot/suspension/observe/plant_observer.h"

namespace dashpot {

/// A plant's observer as a block: at each sample what is measured goes in, and the damper's force,
/// its standard deviation, the damper's motion and the plant's state come out. The filter is the
/// library's text. Throws Error where the damper's model has no C code.
CBlock c_observer_block(const PlantObserver& observer, const ObserverNames& names,
                        const ExportOptions& options);

}  // namespace dashpot
