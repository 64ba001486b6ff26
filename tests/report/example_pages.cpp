// Writes the example report and the example inspection into a folder, for the test that clicks
// through them.
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/report/inspection.h"
#include "report/example_ranking.h"
#include "report/example_search.h"

int main(int count, char** arguments) {
  if (count < 2) return 2;
  const std::filesystem::path folder = arguments[1];
  ExampleRanking example = example_ranking(count > 2 ? std::stoul(arguments[2]) : 1500);
  example.dataset.records[1].notes = {"<script>alert('a note')</script>"};
  dashpot::write_file(folder / "report.html",
                      dashpot::html_document(dashpot::ranking_document(example.input())));
  const ExampleRanking crowded = crowded_ranking(30);
  dashpot::write_file(folder / "crowded.html",
                      dashpot::html_document(dashpot::ranking_document(crowded.input())));
  dashpot::write_file(folder / "inspect.html",
                      dashpot::html_document(dashpot::inspection_document(
                          {example.dataset, {}, "dashpot inspect demo", "0.1.0", "2026-11-21"})));
  const dashpot::SearchReport search = example_search();
  dashpot::write_file(
      folder / "search.html",
      dashpot::html_document(dashpot::search_document(
          {example.dataset, search, "dashpot search demo", "0.1.0", "2026-11-21"})));
}
