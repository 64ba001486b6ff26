#pragma once
#include <string>

#include "dashpot/record/excitation.h"
#include "dashpot/value.h"

namespace dashpot::cli {

/// Describes a sequence, or anything that has the same description, with its parameters.
std::string sheet_text(const SequenceInfo& info, std::size_t width);
Value sheet_json(const SequenceInfo& info);

/// The sequences of motion and drive with their parameters, and the experiments made of them.
std::string sequences_text(int width);
Value sequences_json();

}  // namespace dashpot::cli
