#include "dashpot/design/sensitivity.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("sensitivity: derivatives and shares of a product by hand") {
  // Resistance = rho N l / A with wire and length off by 1 %: ln R moves by -2 x 1 % and 1 %, so
  // that the shares of the variance are 4 : 1 to first order; the turns' tolerance does nothing to
  // the stroke.
  const DesignRequest request = parse_request(R"(
damper: passenger_car
at: {current: 1 A}
vary: {gap: {from: 1 mm, to: 2 mm}}
tolerances: {wire_diameter: 0.005 mm, turn_length: 1 mm, friction: 1 N}
constraints: [{quantity: resistance, max: 1.1341 ohm}, {quantity: stroke, min: 100 mm}]
goals: [{minimise: resistance}]
)",
                                              "request.yaml");
  const std::unique_ptr<DesignModel> model = make_design_model("physics", "");
  const DesignProblem problem(request, *model, 1);
  const Sensitivity result = sensitivity(problem, request.damper, {.samples = 4096, .threads = 1});
  REQUIRE(result.figures.size() == 3);
  const Sensitivity::Figure& resistance = result.figures[0];
  CHECK_CLOSE(resistance.local[0], -0.02 * resistance.drawn, 1e-3, 0);
  CHECK_CLOSE(resistance.local[1], 0.01 * resistance.drawn, 1e-6, 0);
  CHECK(resistance.local[2] == 0);
  CHECK_CLOSE(resistance.total[0], 0.8, 0, 0.04);
  CHECK_CLOSE(resistance.total[1], 0.2, 0, 0.02);
  CHECK(resistance.total[2] == 0);
  CHECK_CLOSE(resistance.alone[0] + resistance.alone[1], 1, 0, 0.08);
  CHECK(result.figures[2].low == result.figures[2].high);
  CHECK_CLOSE(result.holding, 0.5, 0, 0.03);  // the bound is the drawn value
  SensitivityOptions several{.samples = 256, .threads = 3};
  const Sensitivity on_three = sensitivity(problem, request.damper, several);
  several.threads = 1;
  CHECK(on_three.figures[0].total ==
        sensitivity(problem, request.damper, several).figures[0].total);
}
