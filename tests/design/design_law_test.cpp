#include "dashpot/design/design_law.h"

#include "dashpot/damper/kinds/law/law_model.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("law of a design: near its physics, and a model file that reads back") {
  for (const char* name : {"passenger_car", "family_prototype"}) {
    const DesignRequest request = named_request(name);
    const std::unique_ptr<DesignModel> model = make_design_model("physics", "");
    const DesignLaw law = law_of_design(request.damper, request, *model);
    CHECK(law.rms_error < 0.01 * law.largest_force);
    const DesignGoal& goal = request.goals[0];
    const double force = law.file.model->force({0, goal.at.velocity, goal.at.current},
                                               std::vector<double>{goal.at.current});
    CHECK_CLOSE(force, evaluate_physics(request.damper, goal.at).force, 0.03, 0);
    const ModelFile read = parse_model(format_model(law.file), "model");
    CHECK(format_model(read) == format_model(law.file));
    const auto& same = dynamic_cast<const LawModel&>(*read.model);
    CHECK_CLOSE(1 / same.lag_rate(),
                evaluate_physics(request.damper, {law.file.domain.current_max, goal.at.velocity})
                    .time_constant,
                1e-12, 0);
  }
}
