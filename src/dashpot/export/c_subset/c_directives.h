#pragma once
#include <span>
#include <vector>

#include "dashpot/export/c_subset/c_tokens.h"

namespace dashpot {

/// The words, numbers and marks that the parser reads, and an End: without blanks and comments,
/// with each name that #define gives replaced by the tokens it stands for (which then have the line
/// of the name), without what #ifdef and #ifndef leave out, and without #include. Throws Error,
/// with the line, at any other directive and at a macro with arguments.
std::vector<CToken> c_preprocessed(std::span<const CToken> tokens);

}  // namespace dashpot
