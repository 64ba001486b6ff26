#include "dashpot/damper/inverse/polynomial.h"

#include <cmath>

#include "damper/inverse/inverses.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

/// The values of Lozoya and Tudon: TC-4.8b in docs/sources.md.
LawModel sp_lozoya() {
  return LawModel(find_law("semi_phenomenological"),
                  {{Form::Linear, Form::Constant, Form::Constant, Form::Constant, Form::Constant,
                    Form::Constant},
                   {{0, 600.95}, {37.85}, {22.15}, {2830.86}, {-7897.21}, {0}}},
                  DriveUnit::Ampere, 0);
}

/// Bingham with c0 = 1000 + 500 i and the friction 100 + 1000 i - 250 i^2, whose summit lies at 2
/// A.
LawModel parabola() {
  return LawModel(find_law("bingham"),
                  {{Form::Linear, Form::Quadratic, Form::Constant, Form::Constant},
                   {{1000, 500}, {100, 1000, -250}, {20}, {0}}},
                  DriveUnit::Ampere, 0);
}

}  // namespace

TEST_CASE("TC-6.3 the inverse of the semi-phenomenological law") {
  const PolynomialInverse inverse(sp_lozoya(), {.current_max = 2.5});
  CHECK(inverse.degree() == 1);
  const auto current = [&](double wanted, double x, double v) {
    return first_command(inverse, {.wanted = wanted, .displacement = x, .velocity = v});
  };
  CHECK_CLOSE(current(681.52688, 0.005, 0.05), 1, 1e-8, 0);
  CHECK_CLOSE(current(3000, 0, 1), 0.28145436, 0, 0.5e-8);
  CHECK_CLOSE(current(-2430.6051, 0.01, -0.3), 2.5, 1e-8, 0);
  CHECK(current(-500, 0, 0.3) == 0);
  CHECK(current(9000, 0, 1) == 2.5);
}

TEST_CASE("Bingham: I from f_c(I) = (F - c0 v - f0) sgn v, on the rising side of a parabola") {
  const PolynomialInverse inverse(parabola(), {.current_max = 3});
  CHECK(inverse.degree() == 2);
  for (const double v : {0.1, -0.1, 0.02})
    for (const double i : {0.0, 0.3, 1.1, 1.9}) {
      const double friction = 100 + 1000 * i - 250 * i * i;
      const double wanted = (1000 + 500 * i) * v + std::copysign(friction, v) + 20;
      CHECK_CLOSE(first_command(inverse, {.wanted = wanted, .velocity = v}), i, 1e-9, 1e-9);
    }
  // More than the summit: the current of the summit, d/di (500 * 0.1 i + 1000 i - 250 i^2) = 0.
  CHECK_CLOSE(first_command(inverse, {.wanted = 1e5, .velocity = 0.1}), 2.1, 1e-9, 0);
}

TEST_CASE("a cubic dependence: the least current that gives the force") {
  const LawModel model(find_law("bingham"),
                       {{Form::Constant, Form::Cubic, Form::Constant, Form::Constant},
                        {{0}, {100, 600, -900, 400}, {0}, {0}}},
                       DriveUnit::Ampere, 0);
  // 600 i - 900 i^2 + 400 i^3 rises to 125 at 0.5 and falls to 100 at 1: 120 N is met three times
  // in 0 ... 1.5.
  const PolynomialInverse inverse(model, {.current_max = 1.5});
  CHECK(inverse.degree() == 3);
  const double current = first_command(inverse, {.wanted = 220, .velocity = 1});
  CHECK(current < 0.5);
  CHECK_CLOSE(model.force({0, 1, current}, {}), 220, 1e-9, 0);
}

TEST_CASE("where the current has no effect, it stays") {
  const PolynomialInverse inverse(sp_lozoya(), {.current_max = 2.5});
  CHECK(first_command(inverse, {.wanted = 300, .velocity = 0, .current = 1.25}) == 1.25);
}

TEST_CASE("a force that is no polynomial of the current is refused in words") {
  const LawModel kwok = load_parameters("kwok2006");  // delta(i) stands inside the tanh
  CHECK(message_of([&] {
          PolynomialInverse(kwok, {});
        }).starts_with("tanh_kwok: its force is no polynomial of the current"));
}
