#include "dashpot/suspension/ride/ride.h"

#include <array>
#include <cmath>
#include <numbers>

#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/suspension/ride/weighting.h"
#include "support.h"

using namespace dashpot;

namespace {

/// The one-sensor paper's quarter car with a linear damper, on a step of 3 cm, by Runge-Kutta in
/// steps of 0.1 ms.
struct StepResponse {
  std::vector<double> acceleration, tyre;
};
StepResponse step_response(double c) {
  using State = std::array<double, 4>;
  const auto slope = [c](const State& x) {
    const double force = 37300 * (x[0] - x[1]) + c * (x[2] - x[3]);
    return State{x[2], x[3], -force / 387, (force - 295200 * (x[1] - 0.03)) / 139.5};
  };
  const auto moved = [](const State& x, const State& d, double h) {
    return State{x[0] + h * d[0], x[1] + h * d[1], x[2] + h * d[2], x[3] + h * d[3]};
  };
  StepResponse out;
  State x{};
  constexpr double h = 1e-4;
  for (int k = 0; k <= 60000; ++k) {
    const State k1 = slope(x);
    if (k % 10 == 0) {
      out.acceleration.push_back(k1[2]);
      out.tyre.push_back(x[1] - 0.03);
    }
    const State k2 = slope(moved(x, k1, h / 2)), k3 = slope(moved(x, k2, h / 2)),
                k4 = slope(moved(x, k3, h));
    for (std::size_t i = 0; i < 4; ++i) x[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
  }
  return out;
}

double greatest(const std::vector<double>& x) {
  double top = 0;
  for (const double value : x) top = std::max(top, std::abs(value));
  return top;
}

std::vector<double> sine(double f, double dt, double seconds) {
  std::vector<double> x;
  for (double t = 0; t < seconds; t += dt) x.push_back(std::sin(2 * std::numbers::pi * f * t));
  return x;
}

}  // namespace

TEST_CASE("settling time, decay ratio and deviation of a step: TC-10.2") {
  const StepResponse soft = step_response(1800), nominal = step_response(2280);
  const auto acceleration = [](const StepResponse& r) {
    return step_measures(r.acceleration, 1e-3, 0, 0.05 * greatest(r.acceleration));
  };
  const auto tyre = [](const StepResponse& r) {
    return step_measures(r.tyre, 1e-3, 0, 0.05 * 0.03);
  };
  CHECK_CLOSE(acceleration(nominal).settling_time, 0.703, 0, 1.1e-3);
  CHECK_CLOSE(tyre(nominal).settling_time, 0.360, 0, 1.1e-3);
  CHECK_CLOSE(*acceleration(nominal).decay_ratio, 0.077995, 1e-4, 0);
  CHECK_CLOSE(acceleration(soft).settling_time, 1.036, 0, 1.1e-3);
  CHECK_CLOSE(tyre(soft).settling_time, 0.546, 0, 1.1e-3);
  CHECK_CLOSE(*acceleration(soft).decay_ratio, 0.140617, 1e-4, 0);
  CHECK_CLOSE(acceleration(nominal).greatest_deviation, 7.284117, 1e-5, 0);
  CHECK_CLOSE(root_mean_square(nominal.acceleration), 0.705644, 2e-4, 0);
  CHECK(tyre(nominal).greatest_deviation == -0.03);
  CHECK(!step_measures(std::vector<double>{0, 1, 2, 3}, 1, 3, 0.1).decay_ratio);
}

TEST_CASE("the weightings of ISO 2631-1: TC-10.3") {
  const double f[] = {0.5, 0.63, 0.8,  1,  1.25, 1.6, 2,    2.5, 3.15, 4,  5, 6.3,
                      8,   10,   12.5, 16, 20,   25,  31.5, 40,  50,   63, 80};
  const double wk[] = {0.418246, 0.458668, 0.476976, 0.482473, 0.484549, 0.494247,
                       0.531411, 0.630518, 0.803971, 0.967181, 1.038826, 1.054377,
                       1.036366, 0.988406, 0.902309, 0.768699, 0.635923, 0.512717,
                       0.404751, 0.314400, 0.245790, 0.186082, 0.132372};
  for (int k = 0; k < 23; ++k)
    CHECK_CLOSE(std::abs(weighting_response(find_weighting("Wk"), f[k])), wk[k], 0, 6e-7);
  const double fd[] = {1, 2, 4, 8, 20}, wd[] = {1.011017, 0.890243, 0.511912, 0.253125, 0.100154};
  for (int k = 0; k < 5; ++k)
    CHECK_CLOSE(std::abs(weighting_response(find_weighting("Wd"), fd[k])), wd[k], 0, 6e-7);
}

TEST_CASE("a weighted sine has the weighting's gain, at 1 kHz within half a per cent up to 20 Hz") {
  for (const char* name : {"Wk", "Wd", "Wj", "We"})
    for (const double f : {1.0, 4.0, 8.0, 20.0}) {
      CAPTURE(name);
      CAPTURE(f);
      const std::vector<double> x = sine(f, 1e-3, 15);
      const RideComfort comfort = ride_comfort(find_weighting(name), x, 1e-3);
      const double expected = std::abs(weighting_response(find_weighting(name), f)) / std::sqrt(2);
      CHECK_CLOSE(comfort.weighted_rms, expected, 5e-3, 0);
      CHECK_CLOSE(comfort.rms, std::sqrt(0.5), 1e-3, 0);
      CHECK_CLOSE(comfort.mtvv, comfort.weighted_rms, 1e-2, 0);
      CHECK_CLOSE(comfort.crest, std::sqrt(2), 1e-2, 0);
      // The mean fourth power of a sine of amplitude a is 3/8 a^4, over 10 s.
      CHECK_CLOSE(comfort.vdv, expected * std::sqrt(2) * std::pow(0.375 * 10, 0.25), 1e-2, 0);
    }
  CHECK(RideComfort{.weighted_rms = 0.2}.feeling() == "not uncomfortable");
  CHECK(RideComfort{.weighted_rms = 3}.feeling() == "extremely uncomfortable");
}

TEST_CASE("the gain at a frequency is that of its fundamental, the variance gain counts all") {
  const std::vector<double> u = sine(2, 1e-3, 4);
  std::vector<double> y;
  for (std::size_t k = 0; k < u.size(); ++k)
    y.push_back(3 * u[k] + 4 * std::sin(2 * std::numbers::pi * 14 * 1e-3 * static_cast<double>(k)));
  const Gain gain = gain_at(y, u, 1e-3, 2, 4);
  CHECK_CLOSE(gain.fundamental, 3, 1e-9, 0);
  CHECK_CLOSE(gain.variance, 5, 1e-9, 0);
  const std::vector<double> f{0, 1, 2}, g{1, 1, 1};
  CHECK_CLOSE(gain_integral(f, g), std::sqrt(2), 1e-12, 0);
}

TEST_CASE("measures of signals that do not serve are refused") {
  const std::vector<double> x(100);
  CHECK(message_of([&] { weigh(find_weighting("Wk"), x, 0.01); }).find("0.0025 s at most") !=
        std::string::npos);
  CHECK(message_of([&] { ride_comfort(find_weighting("Wk"), x, 1e-3); }).find("no longer than") !=
        std::string::npos);
  CHECK(message_of([&] { gain_at(x, x, 1e-3, 1, 5); }).find("0.1 periods; 5") != std::string::npos);
  CHECK(message_of([&] { find_weighting("Wx"); }).find("unknown weighting") != std::string::npos);
}
