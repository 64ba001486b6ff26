#include "dashpot/report/slider_section.h"

#include <algorithm>

#include "dashpot/error.h"
#include "report/example_ranking.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Programs of so many bytes; none of the second model.
ReportInput input_with_programs(const ExampleRanking& example, std::size_t bytes) {
  ReportInput input = example.input();
  input.program = [bytes, count = 0](const ModelFile&) mutable {
    if (++count == 2) throw Error("", "it has no C");
    return JsText::own(std::string(bytes, '1'));
  };
  return input;
}

}  // namespace

TEST_CASE("sliders: a page without programs has none") {
  const ExampleRanking example = example_ranking(200);
  CHECK(!slider_section(example.input()));
  for (const DocumentSection& section : ranking_document(example.input()).sections)
    CHECK(!section.sliders);
}

TEST_CASE(
    "sliders: usable models come in their order, what is too large or has no program is named") {
  const ExampleRanking many = crowded_ranking(9);
  const auto section = slider_section(input_with_programs(many, 150'000));
  REQUIRE(section);
  CHECK(section->audience == Audience::Page);
  REQUIRE(section->sliders->models.size() == 6);  // one more would pass 1 MB
  CHECK(section->sliders->models[0].name == "Modified Bouc-Wen (Spencer)");
  CHECK(section->sliders->models[1].name != many.ranking.models[1].title);
  REQUIRE(section->remarks.size() == 1);
  CHECK(contains(section->remarks[0], many.ranking.models[1].title + " (it has no C)"));
  CHECK(contains(section->remarks[0], "(too large; 'dashpot export MODEL --to js' writes it)"));
  CHECK(!slider_section(input_with_programs(many, 300'000)));

  // Its records stand under the loops: each at constant drive, once, from the page's samples.
  const Document document = ranking_document(input_with_programs(many, 1000));
  const auto at =
      std::ranges::find(document.sections, std::string("sliders"), &DocumentSection::name);
  REQUIRE(at != document.sections.end());
  const std::vector<DocumentSliders::Loop>& loops = at->sliders->loops;
  CHECK(loops.size() == many.dataset.records.size());
  for (const DocumentSliders::Loop& loop : loops)
    for (const std::size_t place : {loop.displacement, loop.velocity, loop.force}) {
      REQUIRE(place < document.samples.size());
      CHECK(document.samples[place].values.size() > loop.first);
    }

  // The page holds what the section does, once.
  const std::string page = html_document(ranking_document(input_with_programs(many, 1000)));
  const std::size_t first = page.find("() => " + std::string(1000, '1') + ",\n");
  CHECK(first != std::string::npos);
}
