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

/// Code with each line `#include "name.h"` replaced by the text of that name, each once, without
/// its guard and its lines `#include <...>`. Throws Error where there is none of this name.
std::string with_texts(std::string_view code);

/// The rules of MISRA C:2012 from which exported C deviates, for a comment of its header.
std::string_view c_deviations();

/// A number as C writes it in double precision: 1.0, 0.25, 1e-07.
std::string c_number(double value);
/// {1.0, 2.0, 3.0}, wrapped.
std::string c_numbers(std::span<const double> values);
/// "bouc_wen" -> "BoucWen", as the structs of the laws are named.
std::string pascal_case(std::string_view name);

}  // namespace dashpot
