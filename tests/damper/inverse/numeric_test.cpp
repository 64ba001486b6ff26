#include "dashpot/damper/inverse/numeric.h"

#include <cmath>
#include <limits>

#include "damper/inverse/inverses.h"
#include "dashpot/damper/inverse/wanted.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/identify/judge/track.h"
#include "support.h"

using namespace dashpot;

namespace {

LawModel bingham(std::vector<double> friction) {
  const Form form = friction.size() == 1   ? Form::Constant
                    : friction.size() == 2 ? Form::Linear
                                           : Form::Quadratic;
  return LawModel(
      find_law("bingham"),
      {{Form::Constant, form, Form::Constant, Form::Constant}, {{1000}, friction, {20}, {0}}},
      DriveUnit::Ampere, 0);
}

}  // namespace

TEST_CASE("numeric inverse: the closed form of Bingham, from either side and at the ends") {
  const NumericInverse inverse(bingham({100, 800}), {.current_max = 2});
  for (const double v : {0.1, -0.3})
    for (const double i : {0.0, 0.001, 0.7, 1.3, 2.0}) {
      const double wanted = 1000 * v + std::copysign(100 + 800 * i, v) + 20;
      CHECK_CLOSE(first_command(inverse, {.wanted = wanted, .velocity = v, .current = 1}), i, 0,
                  1e-5);
    }
  CHECK(first_command(inverse, {.wanted = 1e6, .velocity = 0.1}) == 2);
  CHECK(first_command(inverse, {.wanted = -1e6, .velocity = 0.1, .current = 1}) == 0);
}

TEST_CASE("numeric inverse: it stays on the rising side, also when warm") {
  const NumericInverse inverse(bingham({100, 1000, -250}),
                               {.current_max = 4});  // back to 100 N at 4 A
  std::vector<double> state(inverse.state_size());
  inverse.rest({}, state);
  for (int k = 0; k < 400; ++k) {
    const double i = 1 + 0.95 * std::sin(0.05 * k), v = k % 90 < 45 ? 0.1 : -0.1;
    const double wanted = 1000 * v + std::copysign(100 + 1000 * i - 250 * i * i, v) + 20;
    CHECK_CLOSE(inverse.command({.wanted = wanted, .velocity = v, .current = i}, state), i, 0,
                1e-3);
  }
}

TEST_CASE("numeric inverse: a force that does not depend on the current leaves it alone") {
  const NumericInverse inverse(bingham({100}), {.current_max = 2});
  CHECK(first_command(inverse, {.wanted = 500, .velocity = 0.1, .current = 0.6}) == 0.6);
}

TEST_CASE("input that is not finite keeps the present current, and the inverse recovers") {
  const LawModel model = load_parameters("spencer1997");
  const NumericInverse inverse(model, {.current_max = 2.25});
  std::vector<double> state(inverse.state_size());
  inverse.rest({}, state);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    CHECK(inverse.command({.wanted = bad, .current = 0.5}, state) == 0.5);
    CHECK(inverse.command({.wanted = 100, .velocity = bad, .current = 5}, state) == 2.25);
    CHECK(inverse.command({.wanted = 100, .velocity = 0.1, .current = bad}, state) >= 0);
  }

  // It looks at no measured force.
  std::vector<double> same = state;
  CHECK(inverse.command({.wanted = 300, .velocity = 0.1, .measured = nan}, state) ==
        inverse.command({.wanted = 300, .velocity = 0.1, .measured = 200}, same));
  CHECK(std::isfinite(
      inverse.command({.wanted = 100, .displacement = 1e300, .velocity = -1e300}, state)));
  for (int k = 0; k < 200; ++k)
    inverse.command({.wanted = 900, .displacement = 1e-4 * k, .velocity = 0.1}, state);
  CHECK(inverse.command({.wanted = 900, .displacement = 0.02, .velocity = 0.1, .current = 1},
                        state) > 0.5);
}

TEST_CASE("the command leads a lagging coil so that it arrives one sample later") {
  const InverseLimits limits{.current_max = 2, .sample_time = 2e-3, .lag_rate = 100};
  const NumericInverse inverse(bingham({100, 800}), limits);
  const double command =
      first_command(inverse, {.wanted = 1020, .velocity = 0.1, .current = 0.95});  // 1 A
  CHECK_CLOSE(0.95 + (command - 0.95) * (1 - std::exp(-0.2)), 1.0, 0, 1e-5);
}

TEST_CASE("few force evaluations per call") {
  for (const char* name : {"spencer1997", "kwok2006"}) {
    const ParameterSet damper = load_parameter_set(name);
    std::size_t count = 0;
    const BareDamper bare = without_coil_lag(damper.model);
    const CountingModel counted(bare.model->with_offset(0), &count);
    const DriverOptions driver = driver_of(damper.model, {.current_max = damper.drive_max});
    const InverseLimits limits = limits_of(driver, 1e-3);
    const NumericInverse inverse(counted, limits);
    const Motion motion = random_motion({.frequency = 3, .duration = 3});
    count = 0;
    track(damper.model, inverse, Driver(driver), motion,
          admissible_force(damper.model, motion, limits, 2, 5));
    const double per_call = static_cast<double>(count) / static_cast<double>(motion.size());
    CAPTURE(per_call);
    CHECK(per_call < 7);  // a bracket, its refinement, and now and then a search of the whole range
    MESSAGE(std::string(name) << ": " << per_call << " force evaluations per call");
  }
}
