#include "studies/family/family_document.h"

#include <algorithm>

#include "identify/family_example.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the family study's page: the paper's figures beside ours, in every form") {
  FamilyStudyOptions options;
  options.effort = 1e-9;  // one epoch
  options.models = {"family_gated"};
  const FamilyStudy study =
      study_family(family_samples(small_family()), family_experiments(2), options);
  Document document = family_document(study);
  document.command = "dashpot study family";
  const std::string markdown = markdown_document(document, "figures"),
                    page = html_document(document);
  for (const std::string& text : {markdown, page})
    for (const char* part : {"0.91155", "2.047", "0.9577", "0.714", "880 experiments", "h3x100",
                             "h2x9", "family_gated"}) {
      CAPTURE(std::string(part));
      CHECK(text.find(part) != std::string::npos);
    }
  for (const char* name :
       {"figure-8", "figure-9", "figure-11", "figure-12", "figure-13", "figure-16"})
    CHECK(markdown.find("](figures/" + std::string(name) + ".svg)") != std::string::npos);
  CHECK(markdown.find("gave 13 333.") != std::string::npos);  // not the same number here
  const Value json = family_json(study);
  CHECK(json.find("samples")->as_number() == 384);
  const auto& experiments = json.find("experiments")->items();
  const auto left_out = std::ranges::find_if(experiments, [](const Value& experiment) {
    return experiment.find("protocol")->as_string() == "each geometry left out in turn";
  });
  REQUIRE(left_out != experiments.end());
  CHECK(left_out->find("divisions")->items().size() == 4);
}

TEST_CASE(
    "of other recordings the family study says what its models are worth, and nothing of the "
    "paper") {
  FamilyStudyOptions options;
  options.effort = 1e-9;
  options.models = {"family_gated", "family_line", "tanh_kwok"};
  const FamilyStudy study =
      study_family(family_samples(small_family()), family_experiments(2), options);
  const std::string text = markdown_document(family_document(study, false), "figures");
  for (const char* figure : {"0.5115", "0.714", "0.9577", "37 ms", "880 experiments"})
    CHECK_FALSE(contains(text, figure));
  CHECK(contains(text, "With each geometry left out family_gated leaves"));
  CHECK(contains(text, "Skill"));
}
