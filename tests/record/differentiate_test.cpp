#include "dashpot/record/differentiate.h"

#include <algorithm>
#include <cmath>
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
  // Gain: 1 / (1 + (warped frequency ratio)^4) of the filter run twice, 3 sin(w dt) / (2 + cos(w
  // dt)) / dt of the differences.
  const double w = 2 * std::numbers::pi * hz;
  const double ratio =
      std::tan(std::numbers::pi * hz * dt) / std::tan(std::numbers::pi * cutoff * dt);
  const double amplitude =
      0.02 * 3 * std::sin(w * dt) / (2 + std::cos(w * dt)) / dt / (1 + std::pow(ratio, 4));
  for (int n = 300; n < 1700; n += 7)
    CHECK_CLOSE(v[static_cast<std::size_t>(n)], amplitude * std::cos(w * n * dt), 1e-9, 1e-9);
}

TEST_CASE("a cut-off that is chosen on the way gives the slope that it gives when stated") {
  Random random(2);
  std::vector<double> fast = sine(0.01, 1, 0.001, 20000);
  for (std::size_t k = 9000; k < 9400; ++k)
    fast[k] += 0.002 * std::sin(0.2 * static_cast<double>(k - 9000));
  std::vector<double> many(120'000);
  for (double& x : many) x = random.normal();
  for (const auto& [x, dt] : {std::pair{fast, 0.001}, {fast, 0.02}, {many, 0.001}}) {
    const Derivative chosen = smooth_derivative(x, dt);
    CHECK(chosen.cutoff_hz == choose_cutoff_hz(x, dt));
    CHECK(chosen.slope == differentiate_zero_phase(x, dt, chosen.cutoff_hz));
    const Derivative stated = smooth_derivative(x, dt, 7);
    CHECK(stated.cutoff_hz == 7);
    CHECK(stated.slope == differentiate_zero_phase(x, dt, 7));
  }
}

TEST_CASE("a velocity is right where few samples tell a period") {
  // Central differences would make it 6.5 % too small with 10 samples, 1.6 % with 20.
  for (const auto& [samples, off] : {std::pair{10, 1.5e-3}, {20, 1e-4}}) {
    const double hz = 100.0 / samples, w = 2 * std::numbers::pi * hz;
    const std::vector<double> v = smooth_derivative(sine(0.02, hz, 0.01, 2000), 0.01).slope;
    for (std::size_t n = 300; n < 1700; n += 7)
      CHECK_CLOSE(v[n], 0.02 * w * std::cos(w * static_cast<double>(n) * 0.01), 0, 0.02 * w * off);
  }
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

TEST_CASE("the cut-off leaves the speed of what is fast only for a while") {
  // A shock dyno's record: one stroke, ever faster, 4 cycles each. Most of the time and of the
  // displacement's power is slow: 99 % of it asks for 10 Hz, which would take 5 % off the speed at
  // 5 Hz and a fifth at 8 Hz.
  constexpr double kStep = 0.002, kStroke = 0.025;
  std::vector<double> x, v;
  for (const double hz : {0.2, 0.5, 1.0, 2.0, 5.0, 8.0}) {
    const double w = 2 * std::numbers::pi * hz;
    for (double t = 0; t < 4 / hz; t += kStep) {
      x.push_back(kStroke * std::sin(w * t));
      v.push_back(kStroke * w * std::cos(w * t));
    }
    for (int k = 0; k < 100; ++k) x.push_back(0), v.push_back(0);
  }
  Random random(3);
  const double clean = choose_cutoff_hz(x, kStep);
  for (double& at : x) at += 2e-5 * random.normal();
  for (const double cutoff : {clean, choose_cutoff_hz(x, kStep)}) {
    CAPTURE(cutoff);
    CHECK(cutoff <= 50);
    const std::vector<double> found = differentiate_zero_phase(x, kStep, cutoff);
    CHECK_CLOSE(*std::max_element(found.begin(), found.end()),
                *std::max_element(v.begin(), v.end()), 0.03, 0);
  }

  // Noise, a rest and strokes of constant speed are no reason to let more through.
  std::vector<double> noise(20000), strokes(20000);
  for (double& at : noise) at = random.normal();
  for (std::size_t k = 0; k < strokes.size(); ++k)
    strokes[k] = std::abs(std::remainder(1e-3 * static_cast<double>(k), 2.0));
  CHECK_CLOSE(choose_cutoff_hz(noise, 0.001), 400, 1e-12, 0);
  CHECK(choose_cutoff_hz(strokes, 0.001) < 20);
  for (std::size_t k = 0; k < 8000; ++k) strokes[k] = 0;
  CHECK(choose_cutoff_hz(strokes, 0.001) < 20);
}
