#pragma once
#include "dashpot/output/exporters/c_control_path.h"

namespace dashpot {

/// Rows of what is measured along a random run, strut by strut, the plant's state where it is
/// looked at, and the commands that the library gives.
std::vector<std::vector<double>> controller_run(const Vehicle& vehicle, const CControlPath& path,
                                                std::size_t count);

}  // namespace dashpot
