#pragma once
#include <string>
#include <string_view>

#include "dashpot/base/print_units.h"

// Quantities in the words of a document: a text carries their numbers in SI, and the renderers show
// them in the units of the document (in_units). Columns, axes, cells and sentences of one document
// can therefore not differ in their units.
namespace dashpot {

/// A number of `digits` significant digits, as number_text() has it, of a quantity in an SI unit
/// that PrintUnits::of() knows; without its unit. "-" when not finite.
std::string quantity(double value, std::string_view si_unit, int digits = 3);
/// The same without an exponent up to a million, as people write forces.
std::string plain_quantity(double value, std::string_view si_unit, int digits = 3);
/// So many decimals in SI, and more or fewer where the unit is larger or smaller.
std::string fixed_quantity(double value, std::string_view si_unit, int decimals);
/// The same with its sign.
std::string signed_quantity(double value, std::string_view si_unit, int decimals);
/// "8 ... 12", or "12" where both are the same as they are printed.
std::string quantity_range(double least, double greatest, std::string_view si_unit, int digits = 3);
/// The name of the unit in which these are shown.
std::string unit_name(std::string_view si_unit);

/// The text as people see it.
std::string in_units(std::string_view text, const PrintUnits& units);

}  // namespace dashpot
