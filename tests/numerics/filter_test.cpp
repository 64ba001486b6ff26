#include "dashpot/numerics/filter.h"

#include <complex>
#include <numbers>

#include "support.h"

using namespace dashpot;

namespace {

/// |H| of the cascade at a frequency.
double gain(const std::vector<Biquad>& sections, double hz, double dt) {
  const std::complex<double> w = std::polar(1.0, -2 * std::numbers::pi * hz * dt);
  std::complex<double> h = 1;
  for (const Biquad& s : sections)
    h *= (s.b0 + w * (s.b1 + w * s.b2)) / (1.0 + w * (s.a1 + w * s.a2));
  return std::abs(h);
}

std::vector<double> test_signal() {
  std::vector<double> x;
  for (int n = 0; n < 40; ++n) x.push_back(std::sin(0.3 * n) + 0.5 * (n % 7) + 0.01 * n * n);
  return x;
}

}  // namespace

TEST_CASE("a Butterworth low-pass has the gain of its definition") {
  for (const int order : {2, 4, 8}) {
    const std::vector<Biquad> sections = butterworth_lowpass(order, 30, 0.002);
    CHECK(sections.size() == static_cast<std::size_t>(order / 2));
    for (const double hz : {0.0, 5.0, 30.0, 60.0, 120.0}) {
      // |H|^2 = 1 / (1 + (tan(pi f dt) / tan(pi fc dt))^(2 order)): the analogue gain, frequency
      // warped.
      const double ratio =
          std::tan(std::numbers::pi * hz * 0.002) / std::tan(std::numbers::pi * 30 * 0.002);
      CHECK_CLOSE(gain(sections, hz, 0.002), 1 / std::sqrt(1 + std::pow(ratio, 2 * order)), 1e-10,
                  1e-14);
    }
  }
}

TEST_CASE("sections are those of scipy") {
  // scipy 1.10.1: signal.butter(2, 30, fs=500, output='sos')
  const Biquad section = butterworth_lowpass(2, 30, 1.0 / 500).front();
  CHECK_CLOSE(section.b0, 0.027859766117136024, 1e-13, 0);
  CHECK_CLOSE(section.b1, 0.05571953223427205, 1e-13, 0);
  CHECK_CLOSE(section.a1, -1.475480443592646, 1e-13, 0);
  CHECK_CLOSE(section.a2, 0.5869195080611902, 1e-13, 0);
}

TEST_CASE("zero-phase filtering is that of scipy") {
  struct Golden {
    int order;
    double cutoff_hz, sample_rate;
    std::array<double, 6> y;
  };
  // scipy 1.10.1: signal.sosfiltfilt(signal.butter(order, cutoff, fs=rate, output='sos'), x)
  // at 0 1 7 20 38 39
  const std::array<Golden, 3> goldens{{
      {2,
       30,
       500,
       {-0.01449291370967265, 0.6321578537100684, 2.7067532963201923, 5.304589512259571,
        15.654486800656212, 16.561918044624072}},
      {4,
       30,
       500,
       {0.05906576671568564, 0.7185882635060131, 2.921968912858099, 5.263042087377125,
        15.55016375290548, 16.45384106906969}},
      {6,
       10,
       100,
       {0.0052176942902202456, 0.9671416669577331, 2.9229745923143864, 5.216794878822321,
        15.290973230179668, 16.47394298569924}},
  }};
  for (const Golden& golden : goldens) {
    const std::vector<double> y = filter_zero_phase(
        butterworth_lowpass(golden.order, golden.cutoff_hz, 1 / golden.sample_rate), test_signal());
    REQUIRE(y.size() == 40);
    const std::array<std::size_t, 6> at{0, 1, 7, 20, 38, 39};
    for (std::size_t k = 0; k < at.size(); ++k) CHECK_CLOSE(y[at[k]], golden.y[k], 1e-12, 1e-12);
  }
}

TEST_CASE("a straight line and short signals pass unchanged") {
  const std::vector<Biquad> sections = butterworth_lowpass(2, 30, 0.002);
  std::vector<double> line;
  for (int n = 0; n < 200; ++n) line.push_back(3 - 0.5 * n);
  const std::vector<double> y = filter_zero_phase(sections, line);
  CHECK_CLOSE(y[100], line[100], 1e-6, 0);
  CHECK(filter_zero_phase(sections, {}).empty());
  const std::vector<double> one{4.0};
  CHECK_CLOSE(filter_zero_phase(sections, one).front(), 4.0, 1e-14, 0);
  CHECK(filter_zero_phase(sections, std::vector<double>{1, 2, 3}).size() == 3);
}

TEST_CASE("a filter that cannot be is refused") {
  CHECK(message_of([] { butterworth_lowpass(3, 10, 0.01); }).find("order 3 is not even") !=
        std::string::npos);
  CHECK(message_of([] { butterworth_lowpass(2, 50, 0.01); }).find("half the sample rate, 50 Hz") !=
        std::string::npos);
  CHECK(message_of([] { butterworth_lowpass(2, 0, 0.01); }) != "");
  CHECK(message_of([] { butterworth_lowpass(2, 10, 0); }) != "");
}
