// Our fits to public recordings of a 1.6 kN damper: TC-4.17 in docs/sources.md. Expected forces:
// the formulas with those numbers, worked out apart from the laws, at a current of 0.5 A.

#include <vector>

#include "dashpot/damper/parameter_set.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kX = 0.004, kV = 0.03, kCurrent = 0.5;
constexpr double kRise = 0.8;  // m/s^2

/// Force of a set at kX, v, with the acceleration a where the law has a filter for it.
double force(const char* name, double v, double a = kRise) {
  const LawModel model = load_parameters(name);
  if (model.state_size() == 0) return model.force({kX, v, kCurrent}, {});
  const double rate = model.parameters().at(model.law().index_of("r"), kCurrent);
  return model.force({kX, v, kCurrent}, std::vector<double>{v - a / rate});
}

}  // namespace

TEST_CASE("Bingham's fit") { CHECK_CLOSE(force("vrths_mr_bingham", kV), 602.3798, 1e-8, 0); }

TEST_CASE("Kwok's fit") { CHECK_CLOSE(force("vrths_mr_tanh_kwok", kV), 700.1018054, 1e-8, 0); }

TEST_CASE("semi-phenomenological fit") {
  CHECK_CLOSE(force("vrths_mr_semi_phenomenological", kV), 695.2377436, 1e-8, 0);
}

TEST_CASE("inverse tangent's fit, on both branches") {
  // a_s = 1e-3 leaves 1 - s = 8e-7 at 0.8 m/s^2
  CHECK_CLOSE(force("vrths_mr_arctan", kV), 689.4518728, 1e-6, 0);
  CHECK_CLOSE(force("vrths_mr_arctan", kV, -kRise), 710.1202153, 1e-6, 0);
}

TEST_CASE("sigmoid's fit, on both branches") {
  CHECK_CLOSE(force("vrths_mr_sigmoid", kV), 692.1662674, 1e-6, 0);
  CHECK_CLOSE(force("vrths_mr_sigmoid", kV, -kRise), 695.8703752, 1e-6, 0);
}

TEST_CASE("fit of the tanh of velocity and acceleration") {
  CHECK_CLOSE(force("vrths_mr_tanh_acceleration", kV), 687.4392698, 1e-8, 0);
  CHECK_CLOSE(force("vrths_mr_tanh_acceleration", kV, -kRise), 696.6774744, 1e-8, 0);
}
