#include "dashpot/report/design_report.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "support.h"

using namespace dashpot;

namespace {

DesignReport small_front() {
  return design(parse_request(R"(
name: "a <b> damper"
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary: {gap: {from: 0.6 mm, to: 2 mm}, fluid: [122EG, 132DG], pole_length: {from: 8 mm, to: 40 mm}}
tolerances: {gap: 0.05 mm}
constraints: [{quantity: force, min: 1000 N}]
goals: [{maximise: dynamic_range}, {minimise: mass}]
)",
                              "request.yaml"),
                {.threads = 1, .points = 8, .generations = 4, .second = "physics:moving_wall"});
}

}  // namespace

TEST_CASE("design report: a line per design, the same in JSON, and a page that no name breaks") {
  const DesignReport report = small_front();
  REQUIRE(report.designs.size() > 1);
  const std::string csv = csv_design(report);
  CHECK(static_cast<std::size_t>(std::ranges::count(csv, '\n')) == report.designs.size() + 1);
  CHECK(csv.starts_with("design,gap[m],fluid,"));
  const DesignInput input{report, "dashpot design", "1", "2026-01-01"};
  const Value json = json_design(input);
  CHECK(json.find("designs")->items()[0].find("variables")->items()[0].as_number() ==
        report.designs[0].damper.gap);
  CHECK(json.find("goals")->items()[1].find("text")->as_string() == "smallest mass");
  const Document document = design_document(input);
  CHECK(html_document(document).find("a <b> damper") == std::string::npos);
  CHECK(contains(html_document(document), "what the models differ by is of the middles"));
  CHECK(markdown_document(document).find("_001 |") != std::string::npos);
  const std::string text = document_text(document, 100);
  for (const char* part : {"knee", "force at least 1000 N", "gap mm ±0.05"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, text);
}

TEST_CASE("design report: a quantity at several places is told with its place, and once") {
  const DesignReport report = design(parse_request(R"(
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary: {gap: {from: 0.6 mm, to: 2 mm}, pole_length: {from: 8 mm, to: 40 mm}}
tolerances: {gap: 0.05 mm}
constraints:
  - {quantity: force, min: 1000 N}
  - {quantity: force, max: 3000 N}
  - {quantity: force, velocity: 1 m/s, max: 5000 N}
goals: [{maximise: dynamic_range}, {maximise: dynamic_range, velocity: 1 m/s}]
)",
                                                   "request.yaml"),
                                     {.threads = 1, .points = 8, .generations = 4});
  REQUIRE(!report.designs.empty());
  std::vector<std::string> figures;
  for (const auto& row : sensitivity_table(report, report.designs.front()).rows)
    figures.push_back(row.front());
  CHECK(figures == std::vector<std::string>{"dynamic_range at 2 A, 0.3 m/s",
                                            "dynamic_range at 2 A, 1 m/s",
                                            "force N at 2 A, 0.3 m/s", "force N at 2 A, 1 m/s"});
  const DocumentTable designs = design_table(report);
  CHECK(std::ranges::count(designs.columns, "dynamic_range at 2 A, 1 m/s", &TextColumn::title) ==
        1);
}

TEST_CASE("design report: figures in units that people read") {
  CHECK(shown_figure(0.0012, "m") == "1.2 mm");
  CHECK(shown_figure(10e6, "A/m^2") == "10 A/mm^2");
  CHECK(shown_figure(3.5, "1") == "3.5");
  CHECK(shown_figure(1800, "N") == "1800 N");
}
