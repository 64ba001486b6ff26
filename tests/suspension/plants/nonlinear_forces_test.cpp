#include "dashpot/suspension/plants/nonlinear_forces.h"

#include <cmath>

#include "support.h"

using namespace dashpot;

TEST_CASE("stops push back beyond their travel, on top of friction") {
  const Strut strut{.extension_stop = 0.04,
                    .compression_stop = 0.06,
                    .stop_stiffness = 1e5,
                    .friction = 50,
                    .friction_speed = 1e-3};
  const StrutResistance<double> r = resistance_of(strut);
  const double sliding = std::tanh(2e-3 / strut.friction_speed);
  CHECK(strut_resistance(r, 0.04, sliding) == 50 * sliding);
  CHECK_CLOSE(strut_resistance(r, 0.05, 0.0), 1000, 1e-12, 0);
  CHECK_CLOSE(strut_resistance(r, -0.08, -1.0), -2050, 1e-12, 0);
}

TEST_CASE("a stop of 0 is none") {
  const StrutResistance<double> r = resistance_of(Strut{.stop_stiffness = 1e5});
  CHECK(beyond_stop(r, 10.0) == 0);
  CHECK(beyond_stop(r, -10.0) == 0);
}

TEST_CASE("a tyre that may lift passes no pull on, another one does") {
  const Tyre tyre{.stiffness = 2e5, .damping = 100, .static_load = 4000};
  const TyreContact<double> lifts = contact_of(tyre, true), holds = contact_of(tyre, false);

  // A hole of 3 cm under a wheel that stays: 2000 N are missing to a load of 0.
  const double push = road_push(lifts, -0.03, 0.0), load = tyre_load(lifts, push, 0.0, 0.0);
  CHECK_CLOSE(push, -6000, 1e-12, 0);
  CHECK_CLOSE(load, -2000, 1e-12, 0);
  CHECK_CLOSE(push_on_wheel(lifts, push, load), -4000, 1e-12, 0);
  CHECK(push_on_wheel(holds, push, load) == push);

  // On the road both are alike.
  const double bump = road_push(lifts, 0.01, 0.5);
  CHECK_CLOSE(bump, 2050, 1e-12, 0);
  CHECK(push_on_wheel(lifts, bump, tyre_load(lifts, bump, 0.0, 0.0)) == bump);
}
