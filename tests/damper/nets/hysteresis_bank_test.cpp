#include "dashpot/damper/nets/hysteresis_bank.h"

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

const HysteresisBank kBank{
    .path_rates = {50, 800}, .velocity_rates = {20, 300}, .current_rates = {40}};

/// Velocity and current on straight lines from one end to the other.
DamperInput on_line(double share) { return {0, 0.3 - 0.5 * share, 2 * share}; }

std::vector<double> after(const HysteresisBank& bank, int steps, double time,
                          std::span<double> slopes = {}) {
  std::vector<double> state(bank.size());
  bank.rest(on_line(0), state);
  for (int k = 0; k < steps; ++k)
    bank.advance(on_line(static_cast<double>(k) / steps), on_line((k + 1.0) / steps), time / steps,
                 state, slopes);
  return state;
}

}  // namespace

TEST_CASE("states follow their closed forms over a line through zero velocity") {
  const double time = 0.01;
  const std::vector<double> state = after(kBank, 1, time);
  // v falls from 0.3 to -0.2: forth 0.3 / 2 * 0.6 T, back 0.2 / 2 * 0.4 T.
  const double forth = 0.09 * time, back = 0.04 * time;
  for (std::size_t k = 0; k < 2; ++k) {
    const double rate = kBank.path_rates[k], turned = 1 - std::exp(-rate * forth);
    CHECK_CLOSE(state[k], -1 + (turned + 1) * std::exp(-rate * back), 0, 1e-14);
  }
  // A lag tau that starts at 0 behind a + b t: a (1 - e) + b (t - tau (1 - e)), e = exp(-t / tau).
  const auto lagged = [&](double rate, double y0, double a, double b) {
    const double gone = 1 - std::exp(-rate * time);
    return y0 * (1 - gone) + a * gone + b * (time - gone / rate);
  };
  for (std::size_t k = 0; k < 2; ++k)
    CHECK_CLOSE(state[2 + k], lagged(kBank.velocity_rates[k], 0, 0.3, -0.5 / time), 0, 1e-14);
  CHECK_CLOSE(state[4], lagged(40, 0, 0, 2 / time), 0, 1e-14);
}

TEST_CASE("the step does not matter") {
  const std::vector<double> one = after(kBank, 1, 0.05), many = after(kBank, 997, 0.05);
  for (std::size_t k = 0; k < one.size(); ++k) CHECK_CLOSE(one[k], many[k], 0, 1e-11);
}

TEST_CASE("slopes are the derivatives by the logarithms of the rates") {
  std::vector<double> slopes(kBank.size());
  after(kBank, 13, 0.02, slopes);
  for (std::size_t k = 0; k < kBank.size(); ++k) {
    const auto moved = [&](double change) {
      HysteresisBank bank = kBank;
      std::vector<double> rates = bank.rates();
      rates[k] *= std::exp(change);
      bank.set_rates(rates);
      return after(bank, 13, 0.02)[k];
    };
    CAPTURE(k);
    CHECK_CLOSE(slopes[k], (moved(1e-5) - moved(-1e-5)) / 2e-5, 1e-6, 1e-9);
  }
}

TEST_CASE("rest, and what a network reads") {
  std::vector<double> state(kBank.size(), NAN), signals(kBank.signal_count());
  kBank.rest({1, 0.2, 3}, state);
  CHECK(state == std::vector<double>{0, 0, 0, 0, 3});
  state = {0.1, -0.2, 0.05, 0.3, 1.5};
  kBank.read({1, 0.2, 3}, state, signals.data());
  const std::vector<double> expected{0.2, 0.1, -0.2, 0.15, -0.1, 1.5};
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK_CLOSE(signals[k], expected[k], 0, 1e-15);
}
