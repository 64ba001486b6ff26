#include "dashpot/suspension/sweep/distribution.h"

#include <cmath>
#include <functional>

#include "support.h"

using namespace dashpot;

namespace {

constexpr ParameterRow kMass{"sprung_mass", "kg", 400, 1, 1e6, "body"};
constexpr ParameterRow kCount{"waves", "1", 1000, 10, 1e5, "cosines", true};

Distribution read(const std::string& yaml, const ParameterRow& row = kMass) {
  return read_distribution(*parse_yaml("a: " + yaml, "test.yaml").find("a"), row);
}

/// Mean of f over the distribution, by the middles of many equal shares.
double mean_of(const Distribution& distribution, const std::function<double(double)>& f) {
  constexpr int kShares = 200000;
  double sum = 0;
  for (int k = 0; k < kShares; ++k) sum += f(distribution.at((k + 0.5) / kShares));
  return sum / kShares;
}
double mean_of(const Distribution& distribution) {
  return mean_of(distribution, [](double x) { return x; });
}
double variance_of(const Distribution& distribution) {
  const double mean = mean_of(distribution);
  return mean_of(distribution, [&](double x) { return (x - mean) * (x - mean); });
}

double bell(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * std::acos(-1.0)); }
double share_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

}  // namespace

TEST_CASE("a uniform distribution has the moments of one") {
  const Distribution d = read("{uniform: [0.3 t, 500 kg]}");
  CHECK_CLOSE(mean_of(d), 400, 1e-9, 0);
  CHECK_CLOSE(variance_of(d), 200.0 * 200 / 12, 1e-6, 0);
  CHECK(d.description("kg") == "uniform, 300 ... 500 kg");
  CHECK(read("{uniform: [20 t, 250 t]}").description("kg") == "uniform, 20000 ... 250000 kg");
}

TEST_CASE(
    "a normal distribution that is cut off has the moments of one (closed form of the truncated "
    "normal)") {
  const Distribution whole = read("{normal: 400 kg, sd: 10 %}");
  CHECK_CLOSE(mean_of(whole), 400, 1e-6, 0);
  CHECK_CLOSE(std::sqrt(variance_of(whole)), 40, 1e-3, 0);
  CHECK_CLOSE(whole.at(0.975), 400 + 40 * 1.959963984540054, 1e-12, 0);  // the table's 97.5 % point

  const Distribution cut = read("{normal: 400, sd: 40, from: 380, to: 500}");
  const double a = -0.5, b = 2.5, z = share_below(b) - share_below(a);
  const double shift = (bell(a) - bell(b)) / z;
  CHECK_CLOSE(mean_of(cut), 400 + 40 * shift, 1e-6, 0);
  CHECK_CLOSE(variance_of(cut), 1600 * (1 + (a * bell(a) - b * bell(b)) / z - shift * shift), 1e-4,
              0);
  CHECK(cut.at(1e-15) >= 380);
  CHECK(cut.at(1 - 1e-15) <= 500);
}

TEST_CASE("far in the tail a cut normal distribution keeps its digits") {
  // P(Z > 5.5 | Z > 5) = 0.0662469 (ratio of complementary error functions)
  const Distribution tail = read("{normal: 100, sd: 10, from: 150, to: 300}");
  CHECK_CLOSE(tail.at(1 - std::erfc(5.5 / std::sqrt(2.0)) / std::erfc(5 / std::sqrt(2.0))), 155,
              1e-9, 0);
}

TEST_CASE("a log-normal distribution has its median and its coefficient of variation") {
  const Distribution d = read("{lognormal: 250, sd: 20 %}");
  CHECK_CLOSE(d.at(0.5), 250, 1e-12, 0);
  const double s2 = std::log1p(0.04);  // (sd / mean)^2 = exp(s^2) - 1
  CHECK_CLOSE(mean_of(d), 250 * std::exp(0.5 * s2), 1e-5, 0);
  CHECK_CLOSE(std::sqrt(variance_of(d)) / mean_of(d), 0.2, 1e-3, 0);
}

TEST_CASE("of a list every value is drawn alike") {
  const Distribution d = read("[100 kg, 200 kg, 0.6 t]");
  CHECK_CLOSE(mean_of(d), 300, 1e-4, 0);
  CHECK(d.at(0.999999) == 600);
  CHECK(d.description("kg") == "one of 100, 200, 600 kg");
}

TEST_CASE("a distribution that makes no sense is refused with file, line and what would be right") {
  const std::pair<std::string, std::string> cases[] = {
      {"{uniform: [500 kg, 300 kg]}",
       "test.yaml:1: the range of sprung_mass is empty: 500 kg to 300 kg"},
      {"{uniform: [300 kg]}", "has 1 ends; two: uniform: [from, to]"},
      {"{uniform: [-5 kg, 300 kg]}", "sprung_mass is -5 kg; between 1 and 1e+06 kg"},
      {"{normal: 400 kg}", "a distribution needs 'sd'"},
      {"{normal: 400 kg, sd: 0}", "the spread of sprung_mass is 0 kg; above 0"},
      {"{normal: 400 kg, sd: 40 kg, from: 900 kg}",
       "is cut off where the distribution has no values"},
      {"{normal: 400 kg, sd: 40 N}", "'N' is not a unit of it; it is counted in kg"},
      {"{gauss: 400 kg}", "unknown key 'gauss'"},
      {"{from: 300 kg, to: 500 kg}", "unknown key 'from'"},
      {"[]", "no sprung_mass to choose from"},
      {"400 kg", "does not say how sprung_mass varies"}};
  for (const auto& [yaml, part] : cases) {
    const std::string message = message_of([&] { read(yaml); });
    CAPTURE(message);
    CHECK_MESSAGE(message.find(part) != std::string::npos, part);
  }
  CHECK(message_of([] {
          read("{uniform: [10, 100]}", kCount);
        }).find("waves is a whole number; a list") != std::string::npos);
}
