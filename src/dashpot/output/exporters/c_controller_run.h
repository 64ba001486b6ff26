#pragma once
#include "dashpot/output/exporters/c_control_path.h"

namespace dashpot {

/// A table's rows, in C: what is measured along a random run, strut by strut, the plant's state where it is
/// looked at, and the commands that the library gives.
std::string controller_rows(const Vehicle& vehicle, const CControlPath& path, std::size_t count);

}  // namespace dashpot
