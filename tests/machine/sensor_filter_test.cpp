#include "dashpot/machine/sensor_filter.h"

#include <cmath>
#include <numbers>

#include "support.h"

using namespace dashpot;

TEST_CASE("a sensor's filter: a sine comes out as its response says, and a level as it is") {
  constexpr double kStep = 0.002, kPi = std::numbers::pi;
  for (const int order : {1, 2, 3, 4, 8})
    for (const double cutoff : {8.0, 60.0, 300.0, 3000.0, 2e5})
      for (const double frequency : {3.0, 40.0, 180.0}) {
        const SensorFilter filter{cutoff, order};
        std::vector<double> sine;
        for (int k = 0; k < 3000; ++k)
          sine.push_back(1 + std::sin(2 * kPi * frequency * kStep * k));
        const std::vector<double> out = behind(filter, sine, kStep);

        // Once it has forgotten its beginning.
        const std::complex<double> response = response_at(filter, 2 * kPi * frequency);
        const auto settled = static_cast<int>(2 * memory_of(filter) / kStep) + 50;
        REQUIRE(settled < 2800);
        double worst = 0;
        for (int k = settled; k < 2950; ++k)
          worst = std::max(
              worst, std::abs(out[static_cast<std::size_t>(k)] - 1 -
                              std::abs(response) *
                                  std::sin(2 * kPi * frequency * kStep * k + std::arg(response))));
        CAPTURE(order);
        CAPTURE(cutoff);
        CAPTURE(frequency);
        CHECK(worst < 5e-5);

        // And back again, up to the cut-off.
        const std::vector<double> in = in_front_of(filter, out, kStep);
        double back = 0;
        for (std::size_t k = 1400; k < 1600; ++k) back = std::max(back, std::abs(in[k] - sine[k]));
        CHECK((back < 2e-3 || frequency > cutoff));
      }
}

TEST_CASE("a sensor's filter: its cut-off, its delay and its memory") {
  constexpr double kPi = std::numbers::pi;
  for (const int order : {1, 2, 5}) {
    const SensorFilter filter{50, order};
    CHECK_CLOSE(std::abs(response_at(filter, 2 * kPi * 50)), std::sqrt(0.5), 1e-12, 0);
    CHECK_CLOSE(-std::arg(response_at(filter, 0.1)) / 0.1, delay_of(filter), 1e-5, 0);
  }
  CHECK_CLOSE(delay_of({50, 2}), std::sqrt(2.0) / (2 * kPi * 50), 1e-12, 0);
  CHECK_CLOSE(memory_of({50, 1}), std::log(1000.0) / (2 * kPi * 50), 1e-12, 0);
  for (const std::size_t count : {std::size_t{2}, std::size_t{101}, std::size_t{100001}}) {
    const std::vector<double> level(count, 3.0);
    const std::vector<double> in = in_front_of({200, 2}, level, 0.002);
    REQUIRE(in.size() == count);
    CHECK_CLOSE(in.front(), 3, 1e-9, 0);
    CHECK_CLOSE(in.back(), 3, 1e-9, 0);
  }
  CHECK(behind({}, std::vector<double>{1, 5, 2}, 0.01) == std::vector<double>{1, 5, 2});
}
