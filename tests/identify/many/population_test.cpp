#include "dashpot/identify/many/population.h"

#include <numeric>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<double> serials_up_to(std::size_t count) {
  std::vector<double> serials(count);
  std::iota(serials.begin(), serials.end(), 1.0);
  return serials;
}

std::vector<std::vector<double>> normal_population(std::size_t quantities, std::size_t dampers,
                                                   Random& random) {
  std::vector<std::vector<double>> columns(quantities, std::vector<double>(dampers));
  for (std::vector<double>& column : columns)
    for (double& value : column) value = 100 + 3 * random.normal();
  return columns;
}

/// The share of sound dampers that are flagged.
double false_alarm_share(std::size_t dampers, double asked) {
  constexpr std::size_t kPopulations = 300, kQuantities = 8;
  Random random(7);
  std::size_t flagged = 0;
  for (std::size_t k = 0; k < kPopulations; ++k) {
    std::vector<char> is_flagged(dampers);
    const auto columns = normal_population(kQuantities, dampers, random);
    for (const Outlier& found : judge_population(columns, serials_up_to(dampers), asked).outliers)
      is_flagged[found.damper] = 1;
    flagged += static_cast<std::size_t>(std::accumulate(is_flagged.begin(), is_flagged.end(), 0));
  }
  return static_cast<double>(flagged) / static_cast<double>(kPopulations * dampers);
}

}  // namespace

TEST_CASE("population: as many sound dampers are flagged as were asked for, or fewer" *
          doctest::test_suite("long")) {
  // Bonferroni and the larger of two spreads are on the safe side; where few dampers say what is
  // usual, their spread is uncertain, and Student's distribution allows for more than that.
  for (const std::size_t dampers : {std::size_t{20}, std::size_t{50}, std::size_t{400}}) {
    const double share = false_alarm_share(dampers, 0.01);
    CAPTURE(dampers);
    CAPTURE(share);
    CHECK(share < 0.012);
    CHECK(share > (dampers < 50 ? 0.0003 : 0.002));
  }
}

TEST_CASE(
    "population: a damper that is off is found, in its quantity, beside others that are off") {
  Random random(3);
  auto columns = normal_population(5, 200, random);
  columns[2][17] = 70;
  for (std::size_t k = 100; k < 110; ++k) columns[4][k] = 160;  // one in twenty
  const PopulationReport report = judge_population(columns, serials_up_to(200), 1e-3);
  REQUIRE(report.outliers.size() == 11);
  CHECK(report.outliers.front().damper == 17);
  CHECK(report.outliers.front().quantity == 2);
  CHECK(report.outliers.front().score < -7);
  CHECK(report.outliers.front().expected == doctest::Approx(100).epsilon(0.01));
  CHECK(report.usual[4].median == doctest::Approx(100).epsilon(0.01));
}

TEST_CASE("population: a drift is told from chance, and what follows it does not stand out") {
  Random random(5);
  auto columns = normal_population(2, 500, random);
  for (std::size_t k = 0; k < 500; ++k) columns[1][k] += 0.05 * static_cast<double>(k);
  columns[1][450] -= 25;  // an early one's value, late
  const PopulationReport report = judge_population(columns, serials_up_to(500), 1e-3);
  CHECK_FALSE(report.usual[0].drift.is_seen());
  REQUIRE(report.usual[1].drift.is_seen());
  CHECK(report.usual[1].drift.slope == doctest::Approx(0.05).epsilon(0.1));
  REQUIRE(report.outliers.size() == 1);
  CHECK(report.outliers.front().damper == 450);

  // Without a drift, one is seen in fewer than one population of a hundred.
  std::size_t seen = 0;
  for (int k = 0; k < 300; ++k)
    seen += judge_population(normal_population(1, 100, random), serials_up_to(100), 1e-3)
                .usual[0]
                .drift.is_seen();
  CHECK(seen <= 3);
}

TEST_CASE("population: few dampers, constants and missing numbers are not judged") {
  Random random(9);
  auto few = normal_population(1, 9, random);
  few[0][3] = 1e6;
  CHECK(judge_population(few, serials_up_to(9), 1e-3).outliers.empty());

  auto columns = normal_population(3, 50, random);
  columns[0].assign(50, 12.5);
  columns[0][7] = 13;
  columns[1][4] = kNaN;
  columns[2].assign(50, kNaN);
  const PopulationReport report = judge_population(columns, serials_up_to(50), 1e-6);
  CHECK(report.outliers.empty());
  CHECK(report.judged_columns == 1);
  CHECK(report.usual[1].count == 49);
  CHECK(report.usual[2].count == 0);
}
