#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/export/c/law_equations.h"
#include "dashpot/value.h"
#include "fuzz.h"
#include "model_runs.h"

// Laws from files.

namespace {

/// What is understood has numbers or none, and is written as it is read.
void law_yaml(const std::string& input) {
  const auto text = dashpot::parse_law_text(input, "fuzz.yaml");
  const std::string definition = dashpot::format_json(text->definition());
  const auto again = dashpot::parse_law_text(definition, "again.json");
  require_true(dashpot::format_json(again->definition()) == definition);
  std::vector<double> values;
  for (const dashpot::ParamInfo& row : text->law().params) values.push_back(row.value);
  require_runs(dashpot::LawModel::constant(text->law(), values));
  require_true(!dashpot::c_law_equations(text->law()).empty());
}

const FuzzTarget target("law_yaml", law_yaml);

}  // namespace
