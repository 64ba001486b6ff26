#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/export.h"

namespace dashpot {

/// The C99 texts that come with Dashpot, by file name.
std::vector<std::pair<std::string_view, std::string_view>> c_texts();
bool has_c_text(std::string_view name);
/// One of them. Throws Error when there is none of this name.
std::string_view c_text(std::string_view name);

/// Code with each line `#include "name.h"` that names such a text replaced by it, each once,
/// without its guard and what it includes in <>.
std::string with_texts(std::string_view code);

/// C code in double precision as code of this precision, comments untouched: in single precision
/// `double` becomes `float`, `exp` becomes `expf`, 0.5 becomes 0.5F.
std::string in_precision(std::string_view code, CPrecision precision);
/// Every name that begins with "damper_" or "DAMPER_" with this prefix in its place.
std::string with_prefix(std::string_view code, std::string_view prefix);

/// Throws Error where an interface with this prefix would have names that the code has inside.
void require_free_names(const std::string& prefix, const std::string& code);
/// From which rules of MISRA C:2012 exported C deviates, for a comment of its header.
std::string_view c_deviations();
/// Text that ends no comment.
std::string in_comment(std::string text);

/// A number as C writes it in double precision: 1.0, 0.25, 1e-07.
std::string c_number(double value);
/// {1.0, 2.0, 3.0}, wrapped.
std::string c_numbers(std::span<const double> values);
/// "bouc_wen" -> "BoucWen", as the structs of the laws are named.
std::string pascal_case(std::string_view name);

}  // namespace dashpot
