#include "dashpot/suspension/dampers/law_loop.h"

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A law at its example values, and one parameter as a function of current.
LawModel with_form(const char* name, const char* parameter, Form form,
                   std::vector<double> coefficients) {
  const Law& law = find_law(name);
  Dependence dependence;
  for (const ParamInfo& row : law.params) {
    const bool own = row.name == std::string(parameter);
    dependence.forms.push_back(own ? form : Form::Constant);
    dependence.coefficients.push_back(own ? coefficients : std::vector{row.value});
  }
  return LawModel(law, dependence, DriveUnit::Ampere, 0);
}

}  // namespace

TEST_CASE("a law's loop is its own whatever the strength does with current") {
  const LawModel law = with_form("bouc_wen", "alpha", Form::Linear, {8e4, 2e4});
  const auto loop = loop_of(law);
  REQUIRE(loop);
  CHECK(loop->state == 0);
  CHECK(!loop->in_series);
  CHECK_CLOSE(loop->shape.z_max, std::sqrt(120 / 2e6), 1e-15, 0);  // A / (gamma + beta), n = 2
  CHECK_CLOSE(loop->shape.sigma, 0.5, 1e-15, 0);

  const auto published = loop_of(LawModel(load_parameters("spencer1997")));
  REQUIRE(published);
  CHECK(published->state == 1);
  CHECK(published->in_series);

  // Dahl's equation at any of these is that of its loop: w' = rho v slope, along the motion.
  const LawModel dahl = with_form("viscous_dahl", "f0", Form::Constant, {0});
  const auto friction = loop_of(dahl);
  REQUIRE(friction);
  for (const double w : {-1.0, -0.4, 0.0, 0.7, 1.0})
    for (const double v : {-0.3, 0.2}) {
      double rate = NAN;
      dahl.flow({0, v, 0}, std::span(&w, 1), std::span(&rate, 1));
      const double side = v < 0 ? -1 : 1, slope = LawLoopKind::slope(friction->shape, side * w);
      CHECK_CLOSE(rate, friction->shape.rate * v * slope, 1e-12, 1e-9);
    }
}

TEST_CASE("a shape that follows the current is none, wherever on the way it is another") {
  // The same at 0 and 1 A and at their middle: three looks would not have seen it.
  const std::vector<double> hidden{1e6, 1e6, -3e6, 2e6};
  CHECK(!loop_of(with_form("bouc_wen", "gamma", Form::Cubic, hidden)));
  CHECK(!loop_of(with_form("normalised_bouc_wen", "rho", Form::Linear, {100, 1})));
  CHECK(!loop_of(with_form("bouc_wen", "n", Form::Exponential, {2, 3, 1})));

  // What has the form of one but does not move is a shape.
  CHECK(loop_of(with_form("bouc_wen", "gamma", Form::Quadratic, {1e6, 0, 0})));
  CHECK(loop_of(with_form("bouc_wen", "n", Form::Exponential, {2, 2, 1})));
  CHECK(!loop_of(with_form("bingham", "f0", Form::Constant, {0})));
}
