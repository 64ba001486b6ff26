#include "dashpot/damper/kinds/fuzzy/sugeno.h"

#include "support.h"

using namespace dashpot;

namespace {

using Shape = Membership::Shape;

constexpr Sugeno::Input kPlain{.mean = 0, .scale = 1, .low = -100, .high = 100};

/// The bells and rules of TC-12a in docs/sources.md.
Sugeno two_by_two_bells() {
  return {.inputs = {kPlain, kPlain},
          .memberships = {{Shape::Bell, 0, -1, 1, 2},
                          {Shape::Bell, 0, 1, 1, 2},
                          {Shape::Bell, 1, 0, 0.5, 2},
                          {Shape::Bell, 1, 1, 0.5, 2}},
          .rules = {{0, 2}, {0, 3}, {1, 2}, {1, 3}},
          .consequents = {100, 10, 0, 200, -5, 1, -50, 20, 2, 300, 0, -1}};
}

}  // namespace

TEST_CASE("TC-12a: an ANFIS of 2 x 2 bells") {
  const Sugeno sugeno = two_by_two_bells();
  CHECK_CLOSE(sugeno.evaluate(std::array{0.2, 0.3}.data()), 14.753255, 0, 5e-7);
  CHECK_CLOSE(sugeno.evaluate(std::array{-0.5, 0.9}.data()), -103.97973, 0, 5e-6);
  CHECK(sugeno.parameter_count() == 24);
}

TEST_CASE("TC-12b: a Takagi-Sugeno model of two rules") {
  const Sugeno sugeno{
      .inputs = {kPlain, kPlain},
      .memberships = {{Shape::Sigmoid, 0, 0.1, 1, -20}, {Shape::Sigmoid, 0, 0.1, 1, 20}},
      .rules = {{1}, {0}},
      .consequents = {1000, 500, 100, 3000, 200, -50}};
  // mu1 = 1 / (1 + exp(-20 (v - 0.1))), f1 = 1000 v + 500 I + 100; mu2 = 1 - mu1, f2 = 3000 v + 200
  // I - 50
  CHECK_CLOSE(sugeno.evaluate(std::array{0.05, 1.0}.data()), 394.1295, 0, 5e-5);
  CHECK_CLOSE(sugeno.evaluate(std::array{0.2, 0.5}.data()), 561.92029, 0, 5e-6);
}

TEST_CASE("inputs and output are standardised inside") {
  Sugeno sugeno = two_by_two_bells();
  sugeno.inputs = {{1, 2, -100, 100}, {-3, 0.5, -100, 100}};
  sugeno.output_mean = 1000;
  sugeno.output_scale = 10;
  // TC-12a, at 1 + 2 * 0.2 and -3 + 0.5 * 0.3
  CHECK_CLOSE(sugeno.evaluate(std::array{1.4, -2.85}.data()), 1147.53255, 0, 5e-6);
}

TEST_CASE("beyond the data the output goes on along a straight line") {
  Sugeno sugeno = two_by_two_bells();
  sugeno.inputs[0].low = -2;
  sugeno.inputs[0].high = 2;
  const auto at = [&](double x) { return sugeno.evaluate(std::array{x, 0.3}.data()); };
  CHECK_CLOSE(at(5) - at(4), at(3) - at(2), 1e-12, 0);
  CHECK_CLOSE(at(1e9), 1e9 * (at(3) - at(2)), 1e-6, 0);
  CHECK(std::abs(at(3) - at(2) - (at(2) - at(1))) > 1);  // but not within it
}

TEST_CASE("no input and no width gives 0 / 0") {
  for (const Shape shape : {Shape::Bell, Shape::Gaussian, Shape::Sigmoid})
    for (const double slope : {0.1, 2.0, 50.0})
      for (const double width : {1e-9, 1.0, 1e9}) {
        const Sugeno sugeno{
            .inputs = {{0, 1, -1e300, 1e300}},
            .memberships = {{shape, 0, -1, width, slope}, {shape, 0, 2, width, -slope}},
            .rules = {{0, 0, 0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 1, 1, 1, 1}},
            .consequents = {0, 5, 0, 7}};
        Sugeno sound = sugeno;
        if (shape == Shape::Bell) sound.memberships[1].slope = slope;
        for (const double x : {-1e200, -1e9, -40.0, -1.0, 0.0, 0.5, 2.0, 40.0, 1e9, 1e200}) {
          const double force = sound.evaluate(&x);
          CAPTURE(x);
          CHECK((force >= 5 - 1e-12 && force <= 7 + 1e-12));
        }
      }
}

TEST_CASE("the gradient of a membership's logarithm is that of its differences") {
  const double h = 1e-6;
  for (const Membership& m :
       {Membership{Shape::Bell, 0, 0.3, 0.8, 1.7}, Membership{Shape::Gaussian, 0, 0.3, 0.8, 1},
        Membership{Shape::Sigmoid, 0, 0.3, 1, 4}, Membership{Shape::Sigmoid, 0, 0.3, 1, -4}})
    for (const double x : {-2.0, 0.1, 0.3, 0.31, 0.9, 3.0}) {
      const std::array<double, 3> gradient = m.log_gradient(x, m.at(x));
      const auto difference = [&](auto change) {
        Membership up = m, down = m;
        change(up, h);
        change(down, -h);
        return (std::log(up.at(x)) - std::log(down.at(x))) / (2 * h);
      };
      CHECK_CLOSE(gradient[0], difference([](Membership& c, double s) { c.centre += s; }), 1e-6,
                  1e-6);
      CHECK_CLOSE(gradient[1], difference([](Membership& c, double s) {
                    if (c.shape != Shape::Sigmoid) c.width *= std::exp(s);
                  }),
                  1e-6, 1e-6);
      CHECK_CLOSE(gradient[2], difference([](Membership& c, double s) {
                    if (c.shape != Shape::Gaussian) c.slope *= std::exp(s);
                  }),
                  1e-6, 1e-6);
    }
}
