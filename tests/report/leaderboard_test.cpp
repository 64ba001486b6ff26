#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/report/ranking_tables.h"
#include "report/example_ranking.h"
#include "support.h"

using namespace dashpot;

namespace {

std::string leaderboard_text(const ExampleRanking& example, int width) {
  const DocumentTable table = in_units(leaderboard_document(example.input())).sections[0].tables[0];
  return text_table(table.columns, table.rows, width);
}

std::string breakdown_text(const ExampleRanking& example, int width) {
  Document document;
  document.sections.push_back({.name = "breakdown",
                               .title = {},
                               .paragraphs = {},
                               .tables = {breakdown_table(example.ranking, DriveUnit::Ampere)}});
  const DocumentTable table = in_units(document).sections[0].tables[0];
  return text_table(table.columns, table.rows, width);
}

}  // namespace

TEST_CASE("leaderboard: thirty models within 100 columns, each with its figures") {
  const ExampleRanking example = crowded_ranking(30);
  const std::string table = leaderboard_text(example, 100);
  CAPTURE(table);
  const auto lines = split(table, '\n');
  REQUIRE(lines.size() == 33);
  for (const std::string& line : lines) CHECK(line.size() <= 100);
  for (const char* title : {"ESR", "Train", "Slow", "Fit", "Par.", "ns/step", "Bounded"})
    CHECK(contains(lines[0], title));
  CHECK(contains(lines[2], "modified_bouc_wen"));
  CHECK(contains(lines[31], "1 diverged"));
  CHECK(contains(breakdown_text(example, 100), "0.8 A"));
}

TEST_CASE("leaderboard: a fit that failed stands in the table without figures") {
  ExampleRanking example = example_ranking(300);
  example.ranking.models[2].fit.model.reset();
  example.ranking.models[2].stress = {};
  const auto lines = split(leaderboard_text(example, 160), '\n');
  CHECK(contains(lines[4], "bingham"));
  CHECK(contains(lines[4], "fit failed"));
  CHECK(!contains(lines[4], "yes"));
  CHECK(!contains(breakdown_text(example, 160), "bingham"));
}

TEST_CASE("what a model does beyond its data, in a word") {
  CHECK(stress_text({}) == "-");
  CHECK(stress_text({.seconds = 5, .finite = false, .largest_share = 2}) == "diverged");
  CHECK(stress_text({.seconds = 5, .finite = true, .largest_share = 2}) == "yes");
  CHECK(stress_text({.seconds = 5, .finite = true, .largest_share = 12}) == "12 spans");
}

TEST_CASE("whether a model takes energy out of all motions, in a word") {
  CHECK(dissipation_text({}) == "-");
  CHECK(dissipation_text({.is_tested = true, .share = 0.3}) == "yes");
  Dissipation active{.is_tested = true, .share = -0.3, .active_from = 40, .active_to = 200};
  CHECK(dissipation_text(active) == "no, 40 to 200 Hz");
  active.active_to = 40;
  CHECK(dissipation_text(active) == "no, 40 Hz");
}

TEST_CASE("whether a model forgets, and how far it is behind, in a word") {
  CHECK(forgetting_text({}) == "-");
  CHECK(forgetting_text({.is_tested = true, .seconds = 0.84, .share_left = 0.002}) == "0.84 s");
  CHECK(forgetting_text({.is_tested = true, .seconds = 9, .share_left = 0.031}) == "no, 3.1 %");
  CHECK(forgetting_text({.is_tested = true, .seconds = 9, .share_left = INFINITY}) == "diverges");
  RankedModel model;
  CHECK(over_first_text(model) == "-");
  model.over_first = PairedRatio{.times = 1.2, .low = 0.961, .high = 1.49, .units = 5};
  CHECK(over_first_text(model) == "0.961 ... 1.49");
}

TEST_CASE("leaderboard as Markdown and CSV: no date, every figure") {
  const ExampleRanking example = example_ranking(300);
  const std::string page = markdown_document(leaderboard_document(example.input()), "", 3);
  CHECK(page.starts_with("### Demonstration damper\n"));
  CHECK(!contains(page, example.input().date));
  CHECK(contains(page, "| modified\\_bouc\\_wen |"));
  CHECK(contains(page, "| 1.6 A |"));

  const auto lines = split(csv_leaderboard(example.input()), '\n');
  REQUIRE(lines.size() == 5);
  CHECK(lines[0].starts_with("rank,model,usable,esr_percent,training_esr_percent"));
  const auto first = split(lines[1], ',');
  CHECK(first.size() == split(lines[0], ',').size());
  CHECK(first[1] == "modified_bouc_wen");
  CHECK(parse_number(first[3]) == example.ranking.models[0].left_out.pooled.esr);
  CHECK(split(lines[3], ',')[2] == "no");  // diverged on a record
}
