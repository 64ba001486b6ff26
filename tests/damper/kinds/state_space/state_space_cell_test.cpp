#include "dashpot/damper/kinds/state_space/state_space_cell.h"

#include "dashpot/damper/nets/hysteresis_bank.h"
#include "state_space_example.h"
#include "support.h"

using namespace dashpot;

namespace {

DamperInput moving(double t) {
  return {0, 0.3 * std::sin(11 * t) + 0.1 * std::sin(37 * t), 1 + 0.8 * std::sin(5 * t)};
}

/// States after `time`, in steps of one size.
std::vector<double> after(const StateSpaceCell& cell, double time, int steps,
                          StateSpaceCell::Slopes* slopes = nullptr) {
  std::vector<double> state(cell.size());
  cell.rest(moving(0), state, slopes);
  for (int k = 0; k < steps; ++k)
    cell.advance(moving(time * k / steps), moving(time * (k + 1) / steps), time / steps, state,
                 slopes);
  return state;
}

}  // namespace

TEST_CASE("without feedback it is a bank of Dahl states and lags") {
  StateSpaceCell cell = example_state_space().cell;
  cell.initialise(3, 1);
  const HysteresisBank bank{
      .path_rates = {12 / 0.2, 100 / 0.2}, .velocity_rates = {60}, .current_rates = {50}};
  std::vector<double> expected(4);
  const int steps = 4000;
  bank.rest(moving(0), expected);
  for (int k = 0; k < steps; ++k)
    bank.advance(moving(k * 1e-4), moving((k + 1) * 1e-4), 1e-4, expected);
  const std::vector<double> state = after(cell, 0.4, steps);
  // Speeds are held over a step here and are straight lines there: what differs falls with its
  // square.
  for (std::size_t k = 0; k < 2; ++k) CHECK_CLOSE(state[k], expected[k], 0, 1e-4);
  CHECK_CLOSE(state[2], expected[2] / 0.2, 0, 1e-4);
  CHECK_CLOSE(state[3], expected[3] - 1, 0, 1e-12);
}

TEST_CASE("a longer step is divided into the model's own, and those are fine enough") {
  StateSpaceCell cell = example_state_space().cell;
  std::vector<double> once(4), often(4);
  cell.rest(moving(0), once);
  cell.rest(moving(0), often);
  const auto line = [](double share) { return DamperInput{0, 0.3 - 0.5 * share, 2 * share}; };
  cell.advance(line(0), line(1), 0.02, once);
  for (int k = 0; k < 10; ++k) cell.advance(line(k / 10.0), line((k + 1) / 10.0), 0.002, often);
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(once[k], often[k], 1e-12, 1e-14);
  const std::vector<double> own = after(cell, 0.4, 200), fine = after(cell, 0.4, 6400);
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(own[k], fine[k], 0, 0.05);
}

TEST_CASE("slopes are the derivatives by the parameters") {
  const StateSpaceCell cell = example_state_space().cell;
  StateSpaceCell::Slopes slopes(cell);
  after(cell, 0.3, 60, &slopes);
  const std::vector<double> parameters = cell.parameters();
  REQUIRE(slopes.columns == parameters.size());
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto moved = [&](double by) {
      std::vector<double> changed = parameters;
      changed[p] += by;
      StateSpaceCell other = cell;
      other.set_parameters(changed.data());
      return after(other, 0.3, 60);
    };
    const std::vector<double> above = moved(1e-5), below = moved(-1e-5);
    CAPTURE(p);
    for (std::size_t k = 0; k < cell.motions(); ++k)
      CHECK_CLOSE(slopes.motion(k)[p], (above[k] - below[k]) / 2e-5, 1e-6, 1e-8);
    if (p == cell.motions())
      CHECK_CLOSE(slopes.currents[0], (above[3] - below[3]) / 2e-5, 1e-6, 1e-9);
  }
}

TEST_CASE("at rest it has settled under its current") {
  const StateSpaceCell cell = example_state_space().cell;
  std::vector<double> state(4);
  const DamperInput still{0.1, 0, 1.7};
  cell.rest(still, state);
  const std::vector<double> before = state;
  cell.advance(still, still, 0.1, state);
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(state[k], before[k], 0, 1e-9);
}

TEST_CASE("random steps of any size leave paths within 1 and lags near the velocity") {
  const StateSpaceCell cell = example_state_space().cell;
  double reach = 0;  // of B phi for the lag: |x|, |u|, |tanh| <= 1
  for (std::size_t f = 0; f < cell.features(); ++f)
    reach += std::abs(cell.feedback[2 * cell.features() + f]);
  std::vector<double> state(4);
  Random random(7);
  const auto any = [&](double least, double most) {
    return (random.uniform() < 0.5 ? -1 : 1) * std::pow(10, random.uniform(least, most));
  };
  DamperInput from;
  cell.rest(from, state);
  double fastest = 0;
  std::size_t outside = 0;
  for (int k = 0; k < 3000; ++k) {
    const DamperInput to{0, any(-9, 30), any(-9, 30)};
    cell.advance(from, to, std::abs(any(-9, 4)), state);
    fastest = std::max(fastest, std::abs(to.velocity) / cell.velocity_scale);
    outside += !(std::abs(state[0]) <= 1 && std::abs(state[1]) <= 1 &&
                 std::abs(state[2]) <= (fastest + reach) * (1 + 1e-12));
    from = to;
  }
  CHECK(outside == 0);
}
