#include <memory>

#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/design/design_problem.h"
#include "dashpot/machine/comfort_ride.h"
#include "dashpot/model_file.h"
#include "dashpot/physics/damper_physics.h"
#include "fuzz.h"
#include "model_runs.h"

// Files of models, of inverses and of dampers.

namespace {

/// What is read can be run, written, and read again.
void model_json(const std::string& input) {
  const dashpot::ModelFile file = dashpot::parse_model(input, "fuzz.json");
  const std::string text = dashpot::format_model(file);
  require_true(dashpot::format_model(dashpot::parse_model(text, "again")) == text);
  require_runs(*file.model);
}

void inverse_json(const std::string& input) {
  const dashpot::InverseFile file = dashpot::parse_inverse(input, "fuzz.json");
  const std::string text = dashpot::format_inverse(file);
  require_true(dashpot::format_inverse(dashpot::parse_inverse(text, "again")) == text);
  const dashpot::HistoryNetwork inverse(
      file.network, {file.network.current_min, file.network.current_max, file.network.spacing, 0});
  std::vector<double> state(inverse.state_size());
  inverse.rest({}, state);
  for (const double force : {1.0, -1e300, 1e300}) {
    const double current = inverse.command({force, 0.01, 0.1, 0.5, 0}, state);
    require_true(current >= file.network.current_min && current <= file.network.current_max);
  }
}

void parameter_set_json(const std::string& input) {
  const dashpot::ParameterSet set = dashpot::parse_parameter_set(input, "fuzz.json", "fuzz");
  require_true(set.drive_min <= set.drive_max);
  require_runs(set.model);
}

/// Its text reads back as the same, and the chain from coil to force has an answer.
void damper_yaml(const std::string& input) {
  const dashpot::DamperDescription description = dashpot::parse_description(input, "fuzz.yaml");
  const std::string text = dashpot::format_description(description);
  require_true(dashpot::format_description(dashpot::parse_description(text, "again.yaml")) == text);
  (void)dashpot::evaluate_physics(description, {0.5, 0.1});
}

/// What is understood can be searched: figures of the middle of all ranges.
void design_yaml(const std::string& input) {
  const dashpot::DesignRequest request = dashpot::parse_request(
      input, "request.yaml", "/nonexistent", dashpot::Goals::Required, dashpot::read_comfort_ride);
  const std::unique_ptr<dashpot::DesignModel> model = dashpot::make_design_model("physics", "");
  const dashpot::DesignProblem problem(request, *model, 1);
  const std::vector<double> middle(problem.size(), 0.5);
  const dashpot::Assessment assessment = problem.assess(problem.damper_at(middle));
  require_true(assessment.slack.size() == request.constraints.size());
}

const FuzzTarget targets[] = {{"model_json", model_json},
                              {"inverse_json", inverse_json},
                              {"design_yaml", design_yaml},
                              {"parameter_set_json", parameter_set_json},
                              {"damper_yaml", damper_yaml}};

}  // namespace
