#pragma once
#include <string>

#include "dashpot/base/value.h"

namespace dashpot::cli {

/// The sequences of motion and drive with their parameters, and the experiments made of them.
std::string sequences_text(int width);
Value sequences_json();

}  // namespace dashpot::cli
