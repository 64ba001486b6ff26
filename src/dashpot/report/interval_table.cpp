#include "dashpot/report/interval_table.h"

#include <fmt/format.h>

#include "dashpot/identify/judge/conformal.h"
#include "dashpot/rank.h"
#include "dashpot/report/text_table.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

const std::vector<TextColumn> kColumns = {
    {"Model", false, 0, true},        {"Covered %", true}, {"Worst %", true},
    {"Worst record", false, 2, true}, {"Width N", true},   {"of span %", true, 1}};

std::vector<std::vector<std::string>> rows_of(const Ranking& ranking) {
  std::vector<std::vector<std::string>> rows;
  for (const RankedModel& model : ranking.models) {
    const Coverage& all = model.left_out.coverage;
    if (const RecordResult* worst = model.left_out.worst_covered())
      rows.push_back({model.name, percent_text(all.percent()),
                      percent_text(worst->coverage.percent()), worst->record,
                      number_text(all.mean_width()), percent_text(all.mean_width_percent())});
  }
  return rows;
}

}  // namespace

std::string interval_table(const Ranking& ranking, int width) {
  const auto rows = rows_of(ranking);
  return rows.empty() ? "" : text_table(kColumns, rows, width);
}

std::string markdown_intervals(const Ranking& ranking) {
  const auto rows = rows_of(ranking);
  if (rows.empty()) return "";
  return fmt::format(
             "\n{:.0f} % intervals of the force, each made without the records that it is judged "
             "on: samples "
             "covered, and mean width.\n\n",
             100 * kCoverage) +
         markdown_table(kColumns, rows);
}

std::string interval_sentence(const Evaluation& evaluation) {
  const RecordResult* worst = evaluation.worst_covered();
  if (!worst) return "";
  const Coverage& all = evaluation.coverage;
  return fmt::format(
      "The {:.0f} % interval of the model covers {} % of the samples, {} % of the worst record "
      "({}); "
      "its mean width is {} N, {} % of the force span.",
      100 * worst->band->level, percent_text(all.percent()),
      percent_text(worst->coverage.percent()), worst->record, number_text(all.mean_width()),
      percent_text(all.mean_width_percent()));
}

}  // namespace dashpot
