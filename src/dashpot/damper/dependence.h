#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot {

/// How a parameter depends on the coil current i:
///   Constant p_a;  Linear p_a + p_b i;  Quadratic p_a + p_b i + p_c i^2.
enum class Form { Constant, Linear, Quadratic };

std::string_view name_of(Form form);
Form parse_form(std::string_view text, const std::string& where);  ///< throws Error
constexpr std::size_t coefficient_count(Form form) { return static_cast<std::size_t>(form) + 1; }

/// A law's parameters as functions of current: forms and coefficients, one list per parameter.
struct Dependence {
  std::vector<Form> forms;  ///< one per parameter
  std::vector<std::vector<double>> coefficients;

  /// Parameters at current i, into out[0 ... forms.size()-1].
  void evaluate(double i, double* out) const noexcept;
};

/// "c_a", "c_b" for a linear c; "c" for a constant one.
std::string coefficient_name(std::string_view param, Form form, std::size_t index);
/// The coefficient's unit: "N*s/m" -> "N*s/(m*A)" for the linear one ("V" for a voltage-driven model).
std::string coefficient_unit(std::string_view unit, std::size_t index, std::string_view drive_unit);

}  // namespace dashpot
