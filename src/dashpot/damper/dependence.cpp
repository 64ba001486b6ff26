#include "dashpot/damper/dependence.h"

#include <array>
#include <cmath>
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::array<std::pair<Form, std::string_view>, 5> kForms{
    {{Form::Constant, "constant"},
     {Form::Linear, "linear"},
     {Form::Quadratic, "quadratic"},
     {Form::Cubic, "cubic"},
     {Form::Exponential, "exponential"}}};

}  // namespace

std::string_view name_of(Form form) { return kForms[static_cast<std::size_t>(form)].second; }

Form parse_form(std::string_view text, const std::string& where) {
  std::vector<std::string> known;
  for (const auto& [form, name] : kForms) {
    if (text == name) return form;
    known.emplace_back(name);
  }
  throw Error(where, "unknown form '" + std::string(text) + "'", suggest(text, known));
}

double Dependence::at(std::size_t k, double i) const noexcept {
  const std::vector<double>& c = coefficients[k];
  if (forms[k] == Form::Exponential) return c[1] + (c[0] - c[1]) * std::exp(-c[2] * i);
  double value = 0;
  for (std::size_t power = c.size(); power-- > 0;) value = value * i + c[power];
  return value;
}

std::string coefficient_name(std::string_view param, Form form, std::size_t index) {
  std::string name(param);
  if (form != Form::Constant) name += {'_', static_cast<char>('a' + index)};
  return name;
}

std::string coefficient_unit(std::string_view unit, Form form, std::size_t index,
                             DriveUnit drive_unit) {
  std::string text(unit), drive(to_string(drive_unit));
  if (form == Form::Exponential) return index < 2 ? text : "1/" + drive;
  if (index == 0) return text;
  if (index > 1) drive.append("^").append(std::to_string(index));
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return text.append("/").append(drive);
  if (text[slash + 1] == '(')
    text.pop_back();
  else
    text.insert(slash + 1, 1, '(');
  return text.append("*").append(drive).append(")");
}

std::string_view coefficient_place(Form form, std::size_t index) {
  constexpr std::array<std::string_view, 4> kPowers{", without drive", ", per drive",
                                                    ", per drive squared", ", per drive cubed"};
  constexpr std::array<std::string_view, 3> kOfExponential{", without drive", ", in saturation",
                                                           ", rate of the change between the two"};
  if (form == Form::Constant) return "";
  return is_polynomial(form) ? kPowers[index] : kOfExponential[index];
}

}  // namespace dashpot
