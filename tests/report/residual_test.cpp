#include "dashpot/report/residual.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("histogram: shares of equal bins add up to 100 %") {
  const Histogram h = histogram(std::vector<double>{0, 1, 1.5, 4}, 4);
  CHECK(h.low == 0);
  CHECK(h.width == 1);
  CHECK(h.shares == std::vector<double>{25, 50, 0, 25});  // the greatest belongs to the last bin
  CHECK(histogram(std::vector<double>{3, 3}, 4).shares == std::vector<double>{100});
  CHECK(histogram({}, 4).shares.empty());
}

TEST_CASE("autocorrelation of a sine is a cosine, of noise within its band") {
  std::vector<double> sine(20000), noise(20000);
  Random random(3);
  for (std::size_t i = 0; i < sine.size(); ++i) {
    sine[i] = 5 + std::sin(2 * std::numbers::pi * static_cast<double>(i) / 100);
    noise[i] = random.normal();
  }
  const Autocorrelation of_sine = autocorrelation(sine, 200, 200);
  REQUIRE(of_sine.lags.size() == 200);
  // Biased estimate: cos(2 pi lag / 100) (1 - lag / n).
  for (std::size_t k = 0; k < 200; k += 17)
    CHECK_CLOSE(of_sine.values[k],
                std::cos(2 * std::numbers::pi * static_cast<double>(of_sine.lags[k]) / 100), 0,
                0.015);
  const Autocorrelation of_noise = autocorrelation(noise, 100, 1000);
  CHECK_CLOSE(of_noise.band, 1.96 / std::sqrt(20000.0), 1e-12, 0);
  CHECK(of_noise.lags.back() > 900);
  const auto outside = std::count_if(of_noise.values.begin(), of_noise.values.end(),
                                     [&](double r) { return std::abs(r) > of_noise.band; });
  CHECK(outside < 15);  // 5 expected of 100; 15 is beyond 4 standard deviations
  CHECK(autocorrelation(std::vector<double>(50, 1.0), 10, 10).values.empty());
}
