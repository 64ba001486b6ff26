#pragma once
#include "dashpot/export/c/c_block.h"
#include "dashpot/export/c/c_control_path.h"

namespace dashpot {

/// What is measured along a random run, signal by signal, then the plant's state where it is looked
/// at, and the commands that the library gives.
std::vector<CBlock::Sample> controller_run(const Vehicle& vehicle, const CControlPath& path,
                                           std::size_t count);

}  // namespace dashpot
