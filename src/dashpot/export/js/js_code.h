#pragma once
#include <span>
#include <string>
#include <string_view>

#include "dashpot/export/c_subset/c_syntax.h"

namespace dashpot {

/// C code as JavaScript. All that C keeps in memory lies in one Float64Array named $, numbers,
/// whole numbers and pointers alike, a place each; a pointer is the place where it points. The code
/// calls no function that is at work already (none of Dashpot's does), so every variable that needs
/// memory has a place of its own. Other variables are JavaScript's.
struct JsCode {
  /// Definitions of $ with the code's tables in it, of the fields' places (BoucWen$alpha), and of
  /// the functions under their names in C. Pointers and numbers go in, a number comes out.
  std::string text;
  std::size_t room = 0;  ///< where in $ the room begins that the caller asked for
};

/// Those functions of the program that `roots` need, and `room` numbers in $ for who calls them.
/// Throws Error with the function's name at what the code must not have: functions of math.h that
/// JavaScript has not, structs by value as arguments, calls in a circle.
JsCode js_code(const CProgram& program, std::span<const std::string_view> roots, std::size_t room);

}  // namespace dashpot
