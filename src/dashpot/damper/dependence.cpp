#include "dashpot/damper/dependence.h"

#include <array>
#include <utility>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr std::array<std::pair<Form, std::string_view>, 3> kForms{
    {{Form::Constant, "constant"}, {Form::Linear, "linear"}, {Form::Quadratic, "quadratic"}}};

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

void Dependence::evaluate(double i, double* out) const noexcept {
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    double value = 0;
    for (std::size_t power = coefficients[k].size(); power-- > 0;) value = value * i + coefficients[k][power];
    out[k] = value;
  }
}

std::string coefficient_name(std::string_view param, Form form, std::size_t index) {
  std::string name(param);
  if (form != Form::Constant) name += {'_', static_cast<char>('a' + index)};
  return name;
}

std::string coefficient_unit(std::string_view unit, std::size_t index, std::string_view drive_unit) {
  std::string text(unit);
  if (index == 0) return text;
  std::string drive(drive_unit);
  if (index > 1) drive.append("^").append(std::to_string(index));
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return text.append("/").append(drive);
  if (text[slash + 1] == '(')
    text.pop_back();
  else
    text.insert(slash + 1, 1, '(');
  return text.append("*").append(drive).append(")");
}

}  // namespace dashpot
