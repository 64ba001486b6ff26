#include "dashpot/driver.h"

#include <array>
#include <cmath>
#include <limits>

#include "support.h"

using namespace dashpot;

namespace {

using State = std::array<double, Driver::kStates>;

/// The coil's current `time` after a command from rest, in `steps` calls.
double after(const Driver& driver, double from, double command, double time, int steps) {
  State state;
  driver.rest(from, state);
  driver.command(command, state);
  for (int k = 0; k < steps; ++k) driver.advance(time / steps, state);
  return driver.current(state);
}

}  // namespace

TEST_CASE("driver: without lag, rate and period it gives the command, within the limits") {
  const Driver driver({.current_min = -1, .current_max = 2});
  CHECK(after(driver, 0, 1.5, 0, 0) == 1.5);
  CHECK(after(driver, 0, 5, 0, 0) == 2);
  CHECK(after(driver, 0, -std::numeric_limits<double>::infinity(), 1, 1) == -1);
  CHECK(after(driver, 0.5, std::nan(""), 1, 1) == 0.5);  // keeps the last command
}

TEST_CASE("driver: a lag is the exponential, whatever the steps") {
  const Driver driver({.current_max = 2, .lag_rate = 190});
  const double exact = 1.5 + (0.25 - 1.5) * std::exp(-190 * 0.004);
  for (const int steps : {1, 2, 7})
    CHECK_CLOSE(after(driver, 0.25, 1.5, 0.004, steps), exact, 1e-13, 0);
}

TEST_CASE("driver: a rate limit is a ramp, whatever the steps") {
  const Driver driver({.current_max = 2, .rate_max = 100});
  for (const int steps : {1, 3, 10}) {
    CHECK_CLOSE(after(driver, 0, 1.5, 0.01, steps), 1.0, 1e-12, 0);
    CHECK_CLOSE(after(driver, 1.5, 0, 0.01, steps), 0.5, 1e-12, 0);
    CHECK_CLOSE(after(driver, 0, 1.5, 0.1, steps), 1.5, 1e-12, 0);
  }
}

TEST_CASE("driver: lag behind a ramp, against the closed form") {
  const double r = 200, slope = 50, end = 1.0, ramp = end / slope, after_ramp = 0.003;
  const Driver driver({.current_max = 2, .rate_max = slope, .lag_rate = r});
  const double at_ramp_end = end - slope / r * (1 - std::exp(-r * ramp));
  const double exact = end + (at_ramp_end - end) * std::exp(-r * after_ramp);
  for (const int steps : {1, 5, 23})
    CHECK_CLOSE(after(driver, 0, end, ramp + after_ramp, steps), exact, 1e-12, 0);
}

TEST_CASE("driver: it looks at its command at its own instants only") {
  const Driver driver({.current_max = 2, .period = 0.01});
  State state;
  driver.rest(0, state);
  driver.command(1, state);  // an instant: the first
  CHECK(driver.current(state) == 1);
  driver.advance(0.004, state);
  driver.command(2, state);
  CHECK(driver.current(state) == 1);
  driver.advance(0.005, state);
  CHECK(driver.current(state) == 1);
  driver.advance(0.002, state);  // past the instant at 0.01 s
  CHECK(driver.current(state) == 2);
  // Steps that add up to the period by rounding alone meet every instant.
  int taken = 0;
  driver.rest(0, state);
  for (int k = 0; k < 1000; ++k) {
    driver.command(k % 2, state);
    const double before = driver.current(state);
    driver.advance(0.001, state);
    taken += k % 10 == 0 && before == k % 2;
  }
  CHECK(taken == 100);
}

TEST_CASE("driver: what makes no sense is refused") {
  CHECK(message_of([] {
          Driver({.current_min = 1, .current_max = 1});
        }).starts_with("driver: the currents 1 ... 1"));
  CHECK(message_of([] { Driver({.rate_max = 0}); }).find("rate limit of 0") != std::string::npos);
  CHECK(message_of([] { Driver({.lag_rate = -1}); }).find("lag rate of -1") != std::string::npos);
  CHECK(message_of([] { Driver({.period = INFINITY}); }).find("period of inf") !=
        std::string::npos);
}
