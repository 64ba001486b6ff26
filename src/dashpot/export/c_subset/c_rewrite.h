#pragma once
#include <string>
#include <string_view>

#include "dashpot/export.h"

namespace dashpot {

// Rewrites C text token by token; all that is not named here stays byte for byte.

/// C code in double precision as code of this precision. In single precision
/// * `double` becomes `float`, `exp` becomes `expf`, and so on for the functions of math.h, but
///   tanh, for which the code gets a function of its own behind #include <math.h>;
/// * 0.5 becomes 0.5F; what is too small for a float becomes the smallest normal one;
/// * a number that depends on the precision says so itself, by a mark behind it,
///       const double tolerance = 1e-9; // with: /* single precision: 1e-5 */
///   and becomes 1e-5F; /* double precision: 1e-9 */.
/// Comments stay but for these marks. Throws Error where a float cannot hold a number, and where a
/// mark stands behind no number.
std::string in_precision(std::string_view code, CPrecision precision);

/// Every name that begins with "damper_" or "DAMPER_" with this prefix in its place, in comments,
/// too, but not in strings.
std::string with_prefix(std::string_view code, std::string_view prefix);

/// Every name that the code defines at file scope, its macros and the words of its enumerations
/// included, with `before` in front of it wherever it stands: so that two codes may stand in one
/// file.
std::string with_own_names(std::string_view code, std::string_view before);

/// Throws Error where an interface with this prefix would have names that the code has inside.
void require_free_names(const std::string& prefix, std::string_view code);

}  // namespace dashpot
