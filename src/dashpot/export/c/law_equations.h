#pragma once
#include <string>

#include "dashpot/damper/law.h"

namespace dashpot {

/// The C text of a law from a file, as `damper/laws/<law>.h` is that of a law of Dashpot's own: a
/// struct of its parameters and functions whose names begin with c_law_name(). Made of the parsed
/// equations alone; no text of the file but checked names and comments is in it.
std::string c_law_equations(const Law& law);

/// What the names of a law's C functions begin with: its name, for a law from a file "own_" before
/// it, so that it meets no other name of the code.
std::string c_law_name(const Law& law);

}  // namespace dashpot
