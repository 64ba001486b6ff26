#include "dashpot/design/design_problem.h"
#include "fuzz.h"

/// What is understood can be searched: figures of the middle of all ranges.
void fuzz(const std::string& input) {
  const dashpot::DesignRequest request = dashpot::parse_request(input, "request.yaml", "/nonexistent");
  const std::unique_ptr<dashpot::DesignModel> model = dashpot::make_design_model("physics", "");
  const dashpot::DesignProblem problem(request, *model, 1);
  const std::vector<double> middle(problem.size(), 0.5);
  const dashpot::Assessment assessment = problem.assess(problem.damper_at(middle));
  if (assessment.slack.size() != request.constraints.size()) std::abort();
}
