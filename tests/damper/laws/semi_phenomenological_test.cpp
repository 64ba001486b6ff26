#include "dashpot/damper/laws/semi_phenomenological.h"

#include <array>

#include "dashpot/damper/parameter_set.h"
#include "support.h"

TEST_CASE("the semi-phenomenological law gives the forces of TC-4.8b, Lozoya's set") {
  const dashpot::LawModel model = dashpot::load_parameters("lozoya");
  const auto force = [&](double x, double v, double i) { return model.force({x, v, i}, {}); };
  CHECK_CLOSE(force(0.005, 0.05, 0), 102.05695, 0, 5e-6);
  CHECK_CLOSE(force(0.005, 0.05, 1), 681.52688, 0, 5e-6);
  CHECK_CLOSE(force(0.01, -0.3, 2.5), -2430.6051, 0, 5e-5);
  CHECK_CLOSE(force(0, 1, 2.5), 4333.235, 0, 5e-4);
}

TEST_CASE("the semi-phenomenological law gives the forces of TC-4.8c, the INOVE damper") {
  const dashpot::LawModel model = dashpot::load_parameters("inove");
  // the test case states f_c u in N; the current has settled, so the lag's state is u itself
  const auto force = [&](double x, double v, double newton) {
    const double u = newton / 28.07;
    return model.force({x, v, u}, std::array{u});
  };
  CHECK_CLOSE(force(0.005, 0.05, 28.07), 31.598192, 0, 5e-7);
  CHECK_CLOSE(force(0, -0.1, 10), -16.587519, 0, 5e-7);
}
