#include "dashpot/report/residual_section.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/rank/information.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// One row per record that was long enough for the tests.
DocumentTable residual_table(const std::vector<ResidualTest>& tests) {
  DocumentTable table{.title = {},
                      .columns = {{"Record"}, {"White"}, {"Q / limit", true}, {"Memory ms", true}},
                      .rows = {}};
  for (const std::string input : {"displacement", "velocity", "drive"})
    table.columns.push_back({"With " + input, true});

  for (const ResidualTest& test : tests) {
    if (!test.is_tested()) continue;
    std::vector<std::string> row{test.record, test.is_white() ? "yes" : "no",
                                 format_number(test.portmanteau / test.limit, 3),
                                 format_number(1000 * test.memory, 3)};
    for (const std::string input : {"displacement", "velocity", "drive"}) {
      const auto with = std::ranges::find(test.inputs, input, &InputCorrelation::input);
      row.push_back(with == test.inputs.end() ? "-"
                                              : fmt::format("{:+.2f}{}", with->largest,
                                                            with->is_independent() ? "" : " *"));
    }
    table.rows.push_back(std::move(row));
  }

  table.note =
      "White: the Ljung-Box test over 20 samples. Memory: until the autocorrelation falls below "
      "0.5. With an input: the largest correlation up to a hundredth of the record later; * where "
      "the means of ten blocks tell it from 0.";
  return table;
}

/// Akaike's and Schwarz's criteria of the laws, relative to the least; without rows where there are
/// not two laws to compare.
DocumentTable information_table(const Ranking& ranking) {
  DocumentTable table{.title = "Is the better fit worth its parameters? The laws' final fits",
                      .columns = {{"Model"},
                                  {"Parameters", true},
                                  {"ln L", true},
                                  {"AIC", true},
                                  {"BIC", true},
                                  {"AIC behind", true},
                                  {"BIC behind", true}},
                      .rows = {}};
  const std::vector<std::optional<InformationCriteria>> all = information_criteria(ranking);
  if (std::ranges::count_if(all, [](const auto& one) { return one.has_value(); }) < 2) return table;

  // Only differences mean something.
  double least_aic = INFINITY, least_bic = INFINITY, independent = 0;
  for (const auto& one : all)
    if (one) {
      least_aic = std::min(least_aic, one->aic);
      least_bic = std::min(least_bic, one->bic);
      independent = one->independent;
    }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k]) continue;
    const auto cell = [](double value) {
      return DocumentCell{fmt::format("{:.1f}", value), value};
    };
    add_row(table, {{display_name(ranking.models[k])},
                    {std::to_string(ranking.models[k].likelihood->parameters)},
                    cell(all[k]->log_likelihood),
                    cell(all[k]->aic),
                    cell(all[k]->bic),
                    cell(all[k]->aic - least_aic),
                    cell(all[k]->bic - least_bic)});
  }
  table.note = fmt::format(
      "Of a Gaussian likelihood of the residuals of all training records, one variance, {} of "
      "their {} samples taken as independent: all over the correlation length of the law that fits "
      "best. Parameters: free numbers, the force zero of each record and the variance. Networks "
      "have no entry: weight decay and early stopping hold their numbers back, so that these do "
      "not count as parameters.",
      number_text(independent), std::ranges::find_if(ranking.models, [](const RankedModel& m) {
                                  return m.likelihood.has_value();
                                })->likelihood->samples);
  return table;
}

}  // namespace

std::vector<std::vector<ResidualTest>> residual_tests(const Ranking& ranking) {
  std::vector<std::vector<ResidualTest>> tests(ranking.models.size());
  parallel_for(tests.size(), 0, [&](std::size_t k) {
    for (const RecordResult& r : ranking.models[k].left_out.records)
      tests[k].push_back(test_residual(r));
  });
  return tests;
}

DocumentSection residual_section(const Ranking& ranking) {
  DocumentSection section{.name = "residual-tests",
                          .title = "What the model leaves over",
                          .paragraphs = {},
                          .audience = Audience::Page};
  const std::vector<std::vector<ResidualTest>> tests = residual_tests(ranking);
  for (std::size_t m = 0; m < tests.size(); ++m) {
    const std::string verdict = residual_verdict(tests[m]);
    if (verdict.empty()) continue;
    section.tables.push_back(residual_table(tests[m]));
    section.tables.back().title = records_title(ranking) + ", " + display_name(ranking.models[m]);
    section.tables.back().when = {{"model", {m}}};
    section.lists.push_back({.title = {}, .lines = {verdict}, .when = {{"model", {m}}}});
  }
  if (DocumentTable criteria = information_table(ranking); !criteria.rows.empty())
    section.tables.push_back(std::move(criteria));
  return section;
}

}  // namespace dashpot
