#include "dashpot/damper/laws/tanh_kwok.h"

#include "dashpot/damper/parameter_set.h"
#include "support.h"

TEST_CASE("Kwok's law gives the forces of TC-4.7") {
  const dashpot::LawModel model = dashpot::load_parameters("kwok2006");
  const auto force = [&](double x, double v, double i) { return model.force({x, v, i}, {}); };
  CHECK_CLOSE(force(0.004, 0.05, 0), 170.99909, 0, 5e-6);
  CHECK_CLOSE(force(0.004, 0.05, 1), 916.63897, 0, 5e-6);
  CHECK_CLOSE(force(-0.004, 0.005, 1), -214.86647, 0, 5e-6);
  CHECK_CLOSE(force(0, 0, 1.5), 30, 0, 1e-9);
  CHECK_CLOSE(force(-0.01, -0.1, 2), -1397, 0, 1e-4);
}

TEST_CASE("the sign of the stroke is zero at its centre") {
  const TanhKwok damper{.c = 0, .k = 0, .alpha = 10, .beta = 1, .delta = 0.5, .f0 = 0};
  CHECK(tanh_kwok_force(&damper, 0, 0, nullptr) == 0);
  CHECK(tanh_kwok_force(&damper, 1e-12, 0, nullptr) ==
        -tanh_kwok_force(&damper, -1e-12, 0, nullptr));
  CHECK_CLOSE(tanh_kwok_force(&damper, 1e-12, 0, nullptr), 10 * std::tanh(0.5), 1e-15, 0);
}
