#include "dashpot/record/differentiate.h"

#include <numbers>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<double> sine(double amplitude, double hz, double dt, int samples) {
  std::vector<double> x;
  for (int n = 0; n < samples; ++n)
    x.push_back(amplitude * std::sin(2 * std::numbers::pi * hz * n * dt));
  return x;
}

}  // namespace

TEST_CASE("the velocity of a sine has its amplitude and no delay") {
  const double dt = 0.002, hz = 2, cutoff = 30;
  const std::vector<double> x = sine(0.02, hz, dt, 2000);
  const std::vector<double> v = differentiate_zero_phase(x, dt, cutoff);
  REQUIRE(v.size() == x.size());
  // Gain: 1 / (1 + (warped frequency ratio)^4) of the filter run twice, sin(w dt) / dt of the
  // differences.
  const double w = 2 * std::numbers::pi * hz;
  const double ratio =
      std::tan(std::numbers::pi * hz * dt) / std::tan(std::numbers::pi * cutoff * dt);
  const double amplitude = 0.02 * std::sin(w * dt) / dt / (1 + std::pow(ratio, 4));
  for (int n = 300; n < 1700; n += 7)
    CHECK_CLOSE(v[static_cast<std::size_t>(n)], amplitude * std::cos(w * n * dt), 1e-9, 1e-9);
}

TEST_CASE("ends follow a ramp") {
  std::vector<double> x;
  for (int n = 0; n < 100; ++n) x.push_back(0.3 * n * 0.01);
  for (const double v : differentiate_zero_phase(x, 0.01, 5)) CHECK_CLOSE(v, 0.3, 1e-3, 0);
}

TEST_CASE("a velocity that cannot be derived is refused") {
  const std::vector<double> x = sine(1, 1, 0.01, 100);
  CHECK(message_of([&] {
          differentiate_zero_phase(std::span(x).first(3), 0.01, 10);
        }).find("only 3 samples") != std::string::npos);
  CHECK(differentiate_zero_phase(std::span(x).first(4), 0.01, 10).size() == 4);
  CHECK(message_of([&] { differentiate_zero_phase(x, 0.01, 50); }).find("half the sample rate") !=
        std::string::npos);
}

TEST_CASE("the cut-off is ten times the frequency of the motion, within its limits") {
  // 99 % of a windowed sine's power lies below its frequency plus about the window's half
  // width, 1.5 / T.
  CHECK_CLOSE(choose_cutoff_hz(sine(0.01, 5, 0.001, 20000), 0.001), 50, 0.02, 0);
  CHECK_CLOSE(choose_cutoff_hz(sine(0.01, 0.5, 0.001, 20000), 0.001), 10, 1e-12, 0);  // lowest
  CHECK_CLOSE(choose_cutoff_hz(sine(0.01, 5, 0.01, 2000), 0.01), 40, 1e-12, 0);       // 0.4 / dt
  CHECK_CLOSE(choose_cutoff_hz(std::vector<double>(50, 1.0), 0.001), 10, 1e-12, 0);   // no motion
  // A record of 2.5 million samples is looked at in three parts.
  CHECK_CLOSE(choose_cutoff_hz(sine(0.01, 5, 0.0005, 2'500'000), 0.0005), 50, 0.02, 0);
  std::vector<double> noisy = sine(0.01, 5, 0.001, 20000);
  Random random(1);
  for (double& x : noisy) x += 1e-4 * random.normal();  // 0.02 % of the power
  CHECK_CLOSE(choose_cutoff_hz(noisy, 0.001), 50, 0.02, 0);
}
