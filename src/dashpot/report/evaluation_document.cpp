#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_tables.h"
#include "dashpot/report/report.h"
#include "dashpot/report/residual_section.h"

namespace dashpot {
namespace {

constexpr int kDigits = 4;  // of errors

std::string percent(double value) { return fmt::format("{:.2f}", value); }

std::vector<std::string> record_row(const RecordResult& r, const std::string& drive_unit) {
  const std::string level = drive_unit.empty() ? "constant"
                            : r.drive_level    ? format_number(*r.drive_level)
                                               : "varies";
  if (r.diverged_at)
    return {r.record, level, "", "",
            "",       "",    "", "diverged at " + format_number(*r.diverged_at) + " s"};
  const Metrics& m = r.metrics;
  return {r.record,       level,          quantity(m.rmse, "N", kDigits), percent(m.rms_half_span),
          percent(m.esr), percent(m.fit), percent(r.energy_error),        quantity(r.offset, "N")};
}

std::vector<std::string> pooled_row(const std::string& name, const Metrics& m) {
  return {name,
          "",
          quantity(m.rmse, "N", kDigits),
          percent(m.rms_half_span),
          percent(m.esr),
          percent(m.fit),
          "",
          ""};
}

DocumentTable error_table(const Evaluation& evaluation, const std::string& drive_unit) {
  DocumentTable table{.title = {},
                      .columns = {{"record", false, 0, true},
                                  {drive_unit.empty() ? "drive" : drive_unit, true},
                                  {"RMSE " + unit_name("N"), true},
                                  {"rms/half-span %", true, 3},
                                  {"ESR %", true},
                                  {"fit %", true},
                                  {"energy error %", true, 2},
                                  {"offset " + unit_name("N"), true, 1}},
                      .rows = {}};

  // Records, then all samples together.
  for (const RecordResult& r : evaluation.records) table.rows.push_back(record_row(r, drive_unit));
  if (evaluation.pooled.samples > 0) {
    table.rows.push_back(pooled_row("all", evaluation.pooled));
    table.rows.push_back(pooled_row("all, without offsets", evaluation.pooled_without_offset));
  }
  return table;
}

DocumentTable band_table(const Evaluation& evaluation) {
  DocumentTable table{.title = {},
                      .columns = {{"velocity band", false, 0, true},
                                  {"|v| " + unit_name("m/s"), true},
                                  {"samples", true, 2},
                                  {"RMSE " + unit_name("N"), true},
                                  {"MAE " + unit_name("N"), true, 1},
                                  {"max |e| " + unit_name("N"), true}},
                      .rows = {}};

  // From the pre-yield region to the top speed.
  for (const BandResult& band : evaluation.bands)
    table.rows.push_back(
        {band.name, quantity(band.low, "m/s") + " ... " + quantity(band.high, "m/s"),
         std::to_string(band.metrics.samples), quantity(band.metrics.rmse, "N", kDigits),
         quantity(band.metrics.mae, "N", kDigits), quantity(band.metrics.max_error, "N", kDigits)});
  return table;
}

}  // namespace

Document evaluation_document(const ReportInput& input) {
  const RankedModel& model = input.ranking.models.front();
  const Evaluation& evaluation = model.left_out;

  // On a page, a ranking of one model; its tables are too wide for what is asked here as text. It
  // has no sliders: how far the model's own data reach is not known here.
  ReportInput still = input;
  still.program = nullptr;
  Document document = ranking_document(still);
  for (DocumentSection& section : document.sections)
    section.audience =
        reaches(section.audience, Audience::Page) ? Audience::Page : Audience::Markdown;

  // As text, every record with its errors, and the bands of speed.
  const bool has_offsets = std::ranges::any_of(
      evaluation.records, [](const RecordResult& record) { return record.offset != 0; });
  DocumentSection errors{.name = "errors",
                         .title = model.name + " in free run, nothing fitted" +
                                  (has_offsets ? " but the force zero of each record" : ""),
                         .paragraphs = {},
                         .tables = {error_table(evaluation, to_string(input.dataset.drive_unit))},
                         .audience = Audience::Text};
  if (evaluation.pooled.samples > 0) errors.tables.push_back(band_table(evaluation));
  if (evaluation.one_step)
    errors.remarks.push_back(
        "One step ahead, with the measured force fed back (flatters; no measure of the model): "
        "RMSE " +
        quantity(evaluation.one_step->rmse, "N", kDigits) + " " + unit_name("N") + ", ESR " +
        percent(evaluation.one_step->esr) + " %.");
  if (const std::string sentence = interval_sentence(evaluation); !sentence.empty())
    errors.remarks.push_back(sentence);
  if (const std::string words = residual_verdict(residual_tests(input.ranking).front());
      !words.empty())
    errors.remarks.push_back(words);
  document.sections.insert(document.sections.begin(), std::move(errors));
  return document;
}

}  // namespace dashpot
