#include "dashpot/report/parameter_files.h"

#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/identify/fit/parameter_choice.h"
#include "dashpot/record/mat_bytes.h"
#include "dashpot/report/column_table.h"
#include "dashpot/report/report_json.h"

namespace dashpot {
namespace {

std::vector<double> numbers_of(const FitReport& fit, double FittedParameter::* figure) {
  std::vector<double> numbers;
  for (const FittedParameter& p : fit.parameters) numbers.push_back(p.*figure);
  return numbers;
}

std::vector<double> flags_of(const FitReport& fit, bool FittedParameter::* flag) {
  std::vector<double> numbers;
  for (const FittedParameter& p : fit.parameters) numbers.push_back(p.*flag ? 1 : 0);
  return numbers;
}

std::vector<std::string> texts_of(const FitReport& fit, std::string FittedParameter::* word) {
  std::vector<std::string> all;
  for (const FittedParameter& p : fit.parameters) all.push_back(p.*word);
  return all;
}

std::string parameters_csv(const FitReport& fit) {
  const std::size_t count = fit.parameters.size();
  ColumnTable table{.name = "parameters", .title = {}, .columns = {}};
  const auto add = [&](const std::string& name, std::vector<double> numbers,
                       std::vector<std::string> texts = {}) {
    table.columns.push_back({name, "1", {}, std::move(numbers), std::move(texts)});
  };

  // Numbers are in the unit of their line.
  std::vector<double> errors;
  for (std::size_t k = 0; k < count; ++k)
    errors.push_back(std::sqrt(fit.covariance[k * count + k]));
  add("parameter", {}, texts_of(fit, &FittedParameter::name));
  add("unit", {}, texts_of(fit, &FittedParameter::unit));
  add("value", numbers_of(fit, &FittedParameter::value));
  add("standard_error", std::move(errors));
  add("low", numbers_of(fit, &FittedParameter::low));
  add("high", numbers_of(fit, &FittedParameter::high));
  add("fixed", flags_of(fit, &FittedParameter::fixed));
  add("at_bound", flags_of(fit, &FittedParameter::at_bound));
  add("weak", flags_of(fit, &FittedParameter::weak));

  // The matrix is symmetric: column j holds the covariances with parameter j.
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<double> column;
    for (std::size_t k = 0; k < count; ++k) column.push_back(fit.covariance[k * count + j]);
    add("covariance " + fit.parameters[j].name, std::move(column));
  }
  return csv_table(table);
}

std::string parameters_mat(const FitReport& fit) {
  const std::size_t count = fit.parameters.size();
  std::vector<MatVariable> variables;
  for (const auto& [name, numbers] : {std::pair<std::string, std::vector<double>>{
                                          "value", numbers_of(fit, &FittedParameter::value)},
                                      {"low", numbers_of(fit, &FittedParameter::low)},
                                      {"high", numbers_of(fit, &FittedParameter::high)},
                                      {"fixed", flags_of(fit, &FittedParameter::fixed)}})
    variables.push_back({.name = name, .rows = count, .columns = 1, .values = numbers});
  variables.push_back(
      {.name = "covariance", .rows = count, .columns = count, .values = fit.covariance});
  variables.push_back({.name = "names",
                       .text = join(texts_of(fit, &FittedParameter::name), "; "),
                       .is_text = true});
  variables.push_back({.name = "units",
                       .text = join(texts_of(fit, &FittedParameter::unit), "; "),
                       .is_text = true});
  return mat_bytes(variables);
}

}  // namespace

Value parameters_json(const ModelFile& file) {
  const LawModel* model = model_as<LawModel>(*file.model);
  Value parameters = Value::array(), covariance;
  if (!model) return Value::object({{"parameters", parameters}, {"covariance", covariance}});

  // What the fit knew of them, as to_model_file() keeps it.
  const Value* known = file.quality.is_null() ? nullptr : file.quality.find("parameters");
  const Value* names = known ? known->find("names") : nullptr;
  const auto known_of = [&](const char* figure, const std::string& name) -> Value {
    for (std::size_t k = 0; names && k < names->items().size(); ++k)
      if (names->items()[k].as_string() == name) return known->find(figure)->items().at(k);
    return {};
  };

  const auto add = [&](const std::string& name, const std::string& unit, std::string_view meaning,
                       double value) {
    parameters.push_back(Value::object({{"name", name},
                                        {"unit", unit},
                                        {"meaning", meaning},
                                        {"value", value},
                                        {"low", known_of("low", name)},
                                        {"high", known_of("high", name)}}));
  };
  const Dependence& own = model->parameters();
  for (std::size_t p = 0; p < own.forms.size(); ++p) {
    const ParamInfo& row = model->law().params[p];
    if (row.fit == Fit::Drive) continue;
    for (std::size_t c = 0; c < own.coefficients[p].size(); ++c)
      add(coefficient_name(row.name, own.forms[p], c),
          coefficient_unit(row.unit, own.forms[p], c, file.drive_unit), row.meaning,
          own.coefficients[p][c]);
  }
  if (model->lag_rate() > 0)
    add(std::string(kLagParameter.name), std::string(kLagParameter.unit), kLagParameter.meaning,
        model->lag_rate());

  // The matrix belongs to these parameters in this order, or to others.
  bool is_of_these = names && names->items().size() == parameters.items().size();
  for (std::size_t k = 0; is_of_these && k < names->items().size(); ++k)
    is_of_these = names->items()[k].as_string() == parameters.items()[k].find("name")->as_string();
  if (is_of_these) covariance = *known->find("covariance");
  return Value::object({{"parameters", std::move(parameters)}, {"covariance", covariance}});
}

std::string parameter_file(const FitReport& fit, std::string_view format) {
  if (format == "csv") return parameters_csv(fit);
  if (format == "mat") return parameters_mat(fit);
  const Value all = presentable(fit_json(fit));
  return format_json(Value::object(
      {{"parameters", *all.find("parameters")}, {"covariance", *all.find("covariance")}}));
}

}  // namespace dashpot
