#include "dashpot/report/sweep_report.h"

#include <algorithm>
#include <set>

#include "dashpot/suspension/sweep/request_file.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Made up: the heavier, the calmer; skyhook has half the acceleration and twice the tyre load of
/// passive.
Sweep example_sweep() {
  Sweep sweep;
  sweep.request = parse_sweep(
      "name: made up\nplant: savaresi_spelta\nroad: iso8608_fft\n"
      "controllers: {passive: {dampers: viscous}, skyhook: {controller: skyhook}}\nsamples: 101\n"
      "vary:\n  sprung_mass: {uniform: [300, 500]}\ngrid:\n  road.class: [A, B]\n",
      "test.yaml");
  sweep.rides.resize(2);
  for (std::size_t v = 0; v < sweep.request.vehicles(); ++v) {
    const double mass = 300 + static_cast<double>(v), place = static_cast<double>(v % 2);
    sweep.vehicles.push_back({v, {mass, place}, 7});
    for (const double factor : {1.0, 0.5})
      sweep.rides[factor == 1 ? 0 : 1].push_back({.body_acceleration = factor * (600 - mass),
                                                  .weighted_acceleration = factor * (500.5 - mass),
                                                  .vibration_dose = 1,
                                                  .tyre_load_index = 0.1 / factor,
                                                  .contact_lost = 0,
                                                  .travel = 0.01,
                                                  .greatest_travel = 0.03,
                                                  .stops_met = 0,
                                                  .energy = 100,
                                                  .current = 0,
                                                  .outside_data = factor == 1 ? 0 : 0.5});
  }
  sweep.rides[1][3] = {.diverged_at = 2.5};
  return sweep;
}

const DocumentTable& table_of(const Document& document, const std::string& section,
                              std::size_t k = 0) {
  for (const DocumentSection& one : document.sections)
    if (one.name == section) return one.tables.at(k);
  FAIL("no section " << section);
  return document.sections.front().tables.front();
}

}  // namespace

TEST_CASE("a sweep's page names what its vehicles stand on") {
  Sweep sweep = example_sweep();
  sweep.foot = "seat";
  sweep.rides[0][5].contact_lost = 0.1;
  const Document document = sweep_document(sweep);
  for (const char* part :
       {"seat load index 2 (less on 0 %", "passive: a seat loses contact on 1 of 202 rides"})
    CHECK_MESSAGE(document.verdict.find(part) != std::string::npos, document.verdict);
  CHECK(html_document(document).find("yre") == std::string::npos);
  CHECK(table_of(document, "ratios").rows[3][0] == "Seat load index");
}

TEST_CASE("a sweep's page tells ratios, quantiles, places, what matters and what not to trust") {
  const Document document = sweep_document(example_sweep());
  for (const char* part : {"202 vehicles, 2 controllers",
                           "skyhook: weighted acceleration 0.5 (less on 100 % of the vehicles), "
                           "tyre load index 2 (less on 0 %",
                           "skyhook: 1 of 202 rides diverged",
                           "skyhook: 201 of 202 rides ask a damper beyond its data"})
    CHECK_MESSAGE(document.verdict.find(part) != std::string::npos, document.verdict);
  const DocumentTable& ratios = table_of(document, "ratios");
  CHECK(ratios.rows[0][0] == "Body acceleration");
  CHECK(ratios.rows[0][4] == "0.5");
  CHECK(ratios.rows[0].back() == "100 % of 201");  // one has diverged
  const DocumentTable& quantiles = table_of(document, "quantiles");
  // Median of 500.5 - 300 ... 500.5 - 501 is 100; stops, which nobody meets, are left out
  CHECK(quantiles.rows[2][0] == "Weighted acceleration (m/s^2)");
  CHECK(quantiles.rows[2][4] == "100");
  for (const auto& row : quantiles.rows) CHECK(row[0].find("Stops") == std::string::npos);
  const DocumentTable& grid = table_of(document, "grid");
  CHECK(grid.rows.size() == 4);
  CHECK(grid.rows[0][0] == "road.class A");
  const DocumentTable& correlation = table_of(document, "sensitivity");
  CHECK(correlation.rows[0][0] == "sprung_mass");
  CHECK(correlation.rows[0][1] == "-1.00");
  CHECK(!html_document(document).empty());
}

TEST_CASE("what speaks against a sweep's rides is told on a terminal, too") {
  Sweep sweep = example_sweep();
  sweep.notes = {"the road ends after 1 s of 30 s"};
  const Document document = sweep_document(sweep);
  CHECK(document_text(document, 80).find("the road ends after 1 s") != std::string::npos);
  CHECK(document_text(document, 80).find("No room for the columns: ") != std::string::npos);
  CHECK(document_text(document, 300).find("No room") == std::string::npos);
}

TEST_CASE("a correlation that is printed as 0 has no sign") {
  Sweep sweep = example_sweep();
  for (std::size_t v = 0; v < sweep.vehicles.size(); ++v)
    sweep.rides[0][v].body_acceleration = static_cast<double>(v * 10 % 211);  // -0.0041
  const Document document = sweep_document(sweep);
  CHECK(table_of(document, "sensitivity").rows[0][1] == "0.00");
}

TEST_CASE("a sweep's drive is a current, a voltage or a place from 0 to 1, and its heads say so") {
  Sweep sweep = example_sweep();
  sweep.rides[1][0].current = 0.5;
  for (const auto& [drive, title, column] :
       {std::tuple{std::optional(DriveUnit::None), "Drive, 0 ... 1", "current,"},
        {std::optional(DriveUnit::Ampere), "Current (A)", "current[A],"},
        {std::optional(DriveUnit::Volt), "Voltage (V)", "current[V],"},
        {std::optional<DriveUnit>(), "Drive (A|V|1)", "current[A|V|1],"}}) {
    CAPTURE(title);
    sweep.drive = drive;
    const DocumentTable quantiles = table_of(sweep_document(sweep), "quantiles");
    CHECK(std::ranges::count_if(quantiles.rows, [&](const auto& r) { return r[0] == title; }) == 2);
    CHECK(csv_table(sweep_tables(sweep)[0]).find(column) != std::string::npos);
  }
}

TEST_CASE("the curves of a sweep are told apart beyond the colours that there are") {
  Sweep sweep = example_sweep();
  while (sweep.rides.size() < 14) {
    sweep.request.controllers.push_back(sweep.request.controllers.back());
    sweep.request.controllers.back().name += "+";
    sweep.rides.push_back(sweep.rides[1]);
  }
  const Document document = sweep_document(sweep);
  std::size_t figures = 0;
  for (const DocumentSection& section : document.sections)
    for (const DocumentFigure& figure : section.figures) {
      CAPTURE(figure.title);
      ++figures;
      for (const FigurePanel& panel : figure.panels) {
        std::set<std::pair<std::string, FigureSeries::Mark>> looks;
        std::size_t labels = 0;
        for (const FigureSeries& series : panel.series)
          if (!series.label.empty()) {
            looks.emplace(series.colour, series.mark);
            ++labels;
          }
        CHECK(labels >= 13);
        CHECK(looks.size() == labels);
      }
    }
  CHECK(figures == 3);
}

TEST_CASE("a sweep's tables: a row per ride, inputs and measures with units") {
  const std::vector<ColumnTable> tables = sweep_tables(example_sweep());
  REQUIRE(tables.size() == 4);
  CHECK(tables[0].rows() == 404);
  const std::string csv = csv_table(tables[0]);
  CHECK(csv.starts_with(
      "controller,road.class,vehicle,road_seed,sprung_mass[kg],body_acceleration[m/s^2]"));
  CHECK(csv.find("\nskyhook,B,3,7,303,,,,,,,,,,,,2.5\n") != std::string::npos);
  CHECK(tables[1].rows() == 22);  // two controllers, eleven measures
  CHECK(tables[2].name == "ratios");
  const Value json = sweep_json(example_sweep());
  CHECK(json.find("vehicles")->as_number() == 202);
  CHECK(json.find("controllers")->items()[1].find("diverged")->as_number() == 1);
}
