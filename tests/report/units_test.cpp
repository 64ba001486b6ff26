#include <cmath>
#include <regex>

#include "dashpot/base/text.h"
#include "dashpot/report/document.h"
#include "dashpot/report/quantity.h"
#include "report/example_ranking.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kPound = 4.4482216152605, kInch = 0.0254;

Document example_document(const PrintUnits& units) {
  static const ExampleRanking kExample = example_ranking();
  ReportInput input = kExample.input();
  input.units = units;
  return ranking_document(input);
}

/// Whether a text names metric units elsewhere than in the names of recordings ("5 mm 3 Hz").
bool names_metric(const std::string& text) {
  static const std::regex kMetric(R"((^|[\s(])(N|mm|mm/s|m/s|m|J)($|[\s).,;:]))");
  static const std::regex kRecord(R"(\d+ mm \d+ Hz)");
  return std::regex_search(std::regex_replace(text, kRecord, "record"), kMetric);
}

}  // namespace

TEST_CASE("a quantity is shown in any units, with the resolution that it has in SI") {
  const PrintUnits pounds = PrintUnits::parse("lbf,in/s", "test");
  CHECK(in_units("a force of " + quantity(444.82216152605, "N") + ' ' + unit_name("N") + '!', {}) ==
        "a force of 445 N!");
  CHECK(in_units("a force of " + quantity(444.82216152605, "N") + ' ' + unit_name("N"), pounds) ==
        "a force of 100 lbf");
  CHECK(in_units(plain_quantity(123456, "N"), {}) == "123456");
  CHECK(in_units(plain_quantity(999.7, "N"), {}) == "1000");
  CHECK(in_units(plain_quantity(164, "N", 2), {}) == "164");
  CHECK(in_units(fixed_quantity(12.34, "N", 0), {}) == "12");
  CHECK(in_units(fixed_quantity(12.34, "N", 0), PrintUnits::parse("kN,m/s", "test")) == "0.012");
  CHECK(in_units(signed_quantity(4.4482, "N", 1), pounds) == "+1.00");
  CHECK(in_units(quantity_range(0.1, 0.1, "m/s"), {}) == "100");
  CHECK(in_units(quantity_range(0.1, 0.2, "m/s"), {}) == "100 ... 200");
  CHECK(quantity(NAN, "N") == "-");

  // What only looks like a quantity stands as it is.
  for (const std::string text : {"\x1d",
                                 "a\x1d"
                                 "b",
                                 "\x1d\x1d",
                                 "\x1d"
                                 "d\x1fN\x1f"
                                 "99\x1f"
                                 "1\x1d",
                                 "\x1d"
                                 "d\x1fN\x1f"
                                 "3\x1d",
                                 "\x1d"
                                 "q\x1fN\x1f"
                                 "3\x1f"
                                 "1\x1d"})
    CHECK(in_units(text, {}) == text);
}

TEST_CASE("every axis, column and sample of a report has the units that were asked for, exactly") {
  const Document metric = example_document({}),
                 pounds = example_document(PrintUnits::parse("lbf,in/s", "test"));
  const Document a = in_units(metric), b = in_units(pounds);
  const std::map<std::string, double> ratios{
      {"N", 1 / kPound}, {"mm", 1e-3 / kInch}, {"mm/s", 1e-3 / kInch}};
  const std::map<std::string, std::string> names{{"N", "lbf"}, {"mm", "in"}, {"mm/s", "in/s"}};

  // The unit stands in brackets behind an axis' words; both documents have the same axes.
  const auto unit_of = [](const std::string& label) {
    const std::size_t open = label.rfind(" (");
    return open == std::string::npos ? "" : label.substr(open + 2, label.size() - open - 3);
  };
  std::size_t compared = 0;
  REQUIRE(a.sections.size() == b.sections.size());
  for (std::size_t s = 0; s < a.sections.size(); ++s)
    for (std::size_t f = 0; f < a.sections[s].figures.size(); ++f)
      for (std::size_t p = 0; p < a.sections[s].figures[f].panels.size(); ++p) {
        const FigurePanel &x = a.sections[s].figures[f].panels[p],
                          &y = b.sections[s].figures[f].panels[p];
        for (const auto& [label, other] :
             {std::pair{x.x_label, y.x_label}, {x.y_label, y.y_label}}) {
          CAPTURE(label);
          const auto name = names.find(unit_of(label));
          CHECK(unit_of(other) == (name == names.end() ? unit_of(label) : name->second));
        }
        if (!x.places.empty()) continue;
        for (std::size_t k = 0; k < x.series.size(); ++k)
          for (std::size_t i = 0; i < x.series[k].x.size(); ++i) {
            const auto ratio = ratios.find(unit_of(x.x_label));
            if (ratio == ratios.end() || !std::isfinite(x.series[k].x[i])) continue;
            CHECK(y.series[k].x[i] ==
                  doctest::Approx(ratio->second * x.series[k].x[i]).epsilon(1e-14));
            ++compared;
          }
      }
  CHECK(compared > 0);

  // Samples, each kind by its own unit.
  REQUIRE(a.samples.size() == b.samples.size());
  for (std::size_t k = 0; k < a.samples.size(); ++k) {
    const std::string si_unit = metric.samples[k].unit;
    const double ratio =
        PrintUnits::parse("lbf,in/s", "test").of(si_unit).factor / PrintUnits().of(si_unit).factor;
    for (std::size_t i = 0; i < a.samples[k].values.size(); ++i)
      if (std::isfinite(a.samples[k].values[i]))
        CHECK(b.samples[k].values[i] ==
              doctest::Approx(ratio * a.samples[k].values[i]).epsilon(1e-14));
  }
}

TEST_CASE("no part of a report in pounds and inches names newtons or millimetres") {
  const Document document = in_units(example_document(PrintUnits::parse("lbf,in/s", "test")));
  for (const DocumentSection& section : document.sections) {
    CAPTURE(section.title);
    for (const DocumentTable& table : section.tables) {
      CAPTURE(table.title);
      CHECK_FALSE(names_metric(table.title));
      for (const TextColumn& column : table.columns) {
        CAPTURE(column.title);
        CHECK_FALSE(names_metric(column.title));
      }
    }
    for (const DocumentList& list : section.lists)
      for (const std::string& line : list.lines) {
        CAPTURE(line);
        CHECK_FALSE(names_metric(line));
      }
    for (const auto* lines : {&section.paragraphs, &section.remarks})
      for (const std::string& line : *lines) {
        CAPTURE(line);
        CHECK_FALSE(names_metric(line));
      }
  }
  for (const KeyFigure& figure : document.key_figures) CHECK_FALSE(names_metric(figure.unit));
  CHECK_FALSE(names_metric(document.verdict));
}

TEST_CASE("no renderer lets out what carries a quantity, and JSON stays in SI") {
  const Document document = example_document(PrintUnits::parse("lbf,in/s", "test"));
  for (const std::string& text : {document_text(document, 80), markdown_document(document),
                                  html_document(document), format_json(document_json(document))}) {
    CHECK(text.find('\x1d') == std::string::npos);
    CHECK(text.find("\\u001d") == std::string::npos);
  }
  CHECK(format_json(document_json(document)) == format_json(document_json(example_document({}))));
}

TEST_CASE("lines for programs have the stated units in their titles and numbers") {
  const ExampleRanking example = example_ranking();
  ReportInput input = example.input();
  const auto first_rmse = [](const std::string& csv, const std::string& title) {
    const std::vector<std::string> lines = split(csv, '\n'), titles = split(lines[0], ',');
    const auto place = std::ranges::find(titles, title);
    REQUIRE(place != titles.end());
    return *parse_number(split(lines[1], ',')[static_cast<std::size_t>(place - titles.begin())]);
  };
  const double newtons = first_rmse(csv_report(input), "rmse_N");
  input.file_units = PrintUnits::parse("lbf,in/s", "test");
  CHECK(first_rmse(csv_report(input), "rmse_lbf") ==
        doctest::Approx(newtons / kPound).epsilon(1e-14));
  CHECK(csv_leaderboard(input).find("pre_yield_rmse_lbf") != std::string::npos);
}
