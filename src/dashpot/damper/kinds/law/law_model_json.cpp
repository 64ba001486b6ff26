#include "dashpot/base/units.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// Factor that brings a value in `unit` to the parameter's SI unit.
double factor_to_si(const Value& unit, const ParamInfo& info) {
  const Unit given = require_unit(unit.as_string(), unit.where());
  if (given.dimension != require_unit(info.unit, "law table").dimension || given.offset != 0)
    throw Error(unit.where(),
                "'" + unit.as_string() + "' does not measure " + std::string(info.name),
                "write " + std::string(info.unit) + " or another unit of its dimension");
  return given.factor;
}

void read_parameter(const Value& value, const ParamInfo& info, Dependence& into) {
  ObjectReader reader(value, "parameter " + std::string(info.name));
  const Value& form = reader.required("form");
  const Value& numbers = reader.required("coefficients");
  const double factor = factor_to_si(reader.required("unit"), info);
  reader.finish();
  into.forms.push_back(parse_form(form.as_string(), form.where()));
  into.coefficients.push_back(numbers.as_numbers());

  // Convert to SI, and check that the form has so many.
  for (std::size_t k = 0; k < into.coefficients.back().size(); ++k)
    if (is_polynomial(into.forms.back()) ||
        k < 2)  // the third of an exponential is a rate per ampere
      into.coefficients.back()[k] *= factor;
  if (const std::size_t wanted = coefficient_count(into.forms.back());
      into.coefficients.back().size() != wanted)
    throw Error(numbers.where(),
                "has " + std::to_string(into.coefficients.back().size()) + " numbers",
                "a " + form.as_string() + " parameter has " + std::to_string(wanted));
}

}  // namespace

Value LawModel::to_json() const {
  Value parameters = Value::object();
  for (std::size_t k = 0; k < law_->params.size(); ++k)
    parameters.add(std::string(law_->params[k].name),
                   Value::object({{"form", name_of(parameters_.forms[k])},
                                  {"coefficients", Value::array(parameters_.coefficients[k])},
                                  {"unit", law_->params[k].unit}}));
  Value value = Value::object({{"law", law_->name},
                               {"drive_unit", name_of(drive_unit_)},
                               {"lag_rate", lag_rate_},
                               {"parameters", parameters}});
  if (text_) value.add("definition", text_->definition());
  return value;
}

std::unique_ptr<LawModel> law_model_from_json(const Value& value) {
  ObjectReader reader(value, "a law model");
  const Value& name = reader.required("law");
  const Value* definition = reader.optional("definition");
  const DriveUnit drive_unit = read_drive_unit(reader);
  const double lag_rate = reader.number("lag_rate");
  const Value& parameters = reader.required("parameters");
  reader.finish();

  // A law from a file travels with the model.
  const std::shared_ptr<const LawText> text = definition ? LawText::make(*definition) : nullptr;
  if (text && text->law().name != name.as_string())
    throw Error(name.where(), "is '" + name.as_string() + "', but '" +
                                  std::string(text->law().name) + "' in its definition");
  if (text && is_own_law(name.as_string()))
    throw Error(definition->where(), "defines '" + name.as_string() + "' anew",
                "a law of Dashpot's own stands without a definition");
  const Law& own = text ? text->law() : find_law(name.as_string(), name.where());

  // A law with rebound and compression apart is told by its rows.
  const Law& law = parameters.find(kSideFriction) ? with_side(own) : own;
  ObjectReader rows(parameters, "the parameter table of " + std::string(law.name));
  Dependence dependence;
  for (const ParamInfo& info : law.params)
    read_parameter(rows.required(info.name), info, dependence);
  rows.finish();
  return std::make_unique<LawModel>(law, std::move(dependence), drive_unit, lag_rate);
}

}  // namespace dashpot
