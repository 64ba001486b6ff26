#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/fit_choices.h"

namespace dashpot {

std::string_view name_of(Form form);
Form parse_form(std::string_view text, const std::string& where);  ///< throws Error
constexpr bool is_polynomial(Form form) { return form != Form::Exponential; }
constexpr std::size_t coefficient_count(Form form) {
  return is_polynomial(form) ? static_cast<std::size_t>(form) + 1 : 3;
}

/// A law's parameters as functions of current: forms and coefficients, one list per parameter.
struct Dependence {
  std::vector<Form> forms;  ///< one per parameter
  std::vector<std::vector<double>> coefficients;

  /// Parameter k at current i.
  double at(std::size_t k, double i) const noexcept;
};

/// "c_a", "c_b" for a linear c; "c" for a constant one.
std::string coefficient_name(std::string_view param, Form form, std::size_t index);
/// The coefficient's unit: "N*s/m" -> "N*s/(m*A)" for the linear one ("V" for a voltage-driven
/// model).
std::string coefficient_unit(std::string_view unit, Form form, std::size_t index,
                             DriveUnit drive_unit);
/// What it is of the parameter: ", without drive", ", in saturation"; empty for a constant one.
std::string_view coefficient_place(Form form, std::size_t index);

}  // namespace dashpot
