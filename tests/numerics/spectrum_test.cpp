#include "dashpot/numerics/spectrum.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "support.h"

using namespace dashpot;

TEST_CASE("the lines of a sine sum to its power and peak at its frequency") {
  std::vector<double> x;
  for (int n = 0; n < 1500; ++n)
    x.push_back(7 + 3 * std::sin(2 * std::numbers::pi * 12.5 * n * 0.001));
  const PowerSpectrum spectrum = power_spectrum(x, 0.001);
  CHECK(spectrum.power.size() == 1025);
  CHECK_CLOSE(spectrum.spacing_hz, 1000.0 / 2048, 1e-12, 0);
  // Mean square of a sine of amplitude 3; the window weighs its 18.75 periods evenly to 1e-3.
  CHECK_CLOSE(std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0), 4.5, 1e-3, 0);
  const auto peak =
      std::max_element(spectrum.power.begin(), spectrum.power.end()) - spectrum.power.begin();
  CHECK_CLOSE(static_cast<double>(peak) * spectrum.spacing_hz, 12.5, 0, spectrum.spacing_hz);
}

TEST_CASE("a constant has no power") {
  const PowerSpectrum spectrum = power_spectrum(std::vector<double>(10, 2.5), 0.1);
  for (const double line : spectrum.power) CHECK_CLOSE(line, 0, 0, 1e-28);
}

TEST_CASE("the samples come back from half their spectrum; lengths of small factors") {
  for (const std::size_t count : {720, 675, 14}) {
    std::vector<double> x(count);
    for (std::size_t k = 0; k < count; ++k) x[k] = std::sin(0.37 * static_cast<double>(k * k % 91));
    const std::vector<double> back = from_half_spectrum(half_spectrum(x), count);
    REQUIRE(back.size() == count);
    for (std::size_t k = 0; k < count; ++k) CHECK_CLOSE(back[k], x[k], 0, 1e-12);
  }
  CHECK(quick_length(720) == 720);
  CHECK(quick_length(727) == 720);
  CHECK(quick_length(1) == 1);
}
