#include "dashpot/report/search_report.h"

#include "dashpot/base/text.h"
#include "report/example_search.h"
#include "support.h"

using namespace dashpot;

namespace {}  // namespace

TEST_CASE(
    "a search's verdict names the best, the smallest that is as good, and the price of choosing") {
  SearchReport search = example_search();
  const std::string verdict = search_verdict(search);
  CHECK(verdict.starts_with(
      "hidden=10, activation=tanh, l2=1e-06 with 41 parameters: on recordings"));
  CHECK(contains(verdict, "within one standard error of it (0.70 %) is hidden=3, activation=relu"));
  CHECK(contains(verdict, "with 13 parameters: 2.5 %"));
  CHECK(contains(verdict, "expect a little more on new records"));
  search.trials[0].standard_error = 0.1;
  CHECK(contains(search_verdict(search), "No smaller network comes within one standard error"));
}

TEST_CASE("the rounds of a search in words") {
  CHECK(search_plan({{27, 1.0 / 9}, {9, 1.0 / 3}, {3, 1}}, SearchEffort::Samples) ==
        "27 trials with 1/9 of the data, 9 with 1/3, 3 with all");
  CHECK(search_plan({{9, 1.0 / 3}, {3, 1}}, SearchEffort::Epochs) ==
        "9 trials with 1/3 of the epochs, 3 with all");
  CHECK(search_plan({{12, 1}}, SearchEffort::Samples) == "12 trials");
}

TEST_CASE("tables of trials: a row each, with what was searched, and what became of it") {
  const SearchReport search = example_search();
  const DocumentTable best = trial_table(search.trials, search, 3);
  const std::string table = text_table(best.columns, best.rows, 200);
  CHECK(split(table, '\n').size() ==
        6);  // titles, a rule, three rows, and what follows the last line end
  CHECK(contains(table, "best, front"));
  CHECK(contains(table, "smallest, front"));
  const std::string csv = csv_search(search);
  const std::vector<std::string> lines = split(csv, '\n');
  REQUIRE(lines.size() == 11);
  CHECK(lines[0].starts_with("rank,hidden,activation,l2,parameters,esr_percent,"));
  CHECK(lines[1].starts_with("1,10,tanh,1e-06,41,2,0.7,9,"));
  CHECK(contains(lines[9], "<script>"));
  CHECK(!contains(csv, "seconds"));
}

TEST_CASE("the page of a search holds its trials as data, and no text becomes markup") {
  const SearchReport search = example_search();
  Dataset dataset;
  dataset.name = "example";
  const SearchInput input{dataset, search, "dashpot search demo", "0.1.0", "2026-11-21"};
  const Document document = search_document(input);
  const std::string page = html_document(document);
  CHECK(!contains(page, "<script>alert"));
  CHECK(contains(page, "\"kind\":\"search\""));
  const std::string text = markdown_document(document);
  CHECK(text.starts_with("# example, search of mlp\\_one\\_sensor"));
  CHECK(!contains(text, "\n<script>"));
}
