#include "dashpot/report/provenance.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

std::string drive_levels(const Dataset& dataset) {
  if (dataset.drive_unit == DriveUnit::None) return "one constant, unknown drive";
  std::set<double> levels;
  for (const Record& record : dataset.records)
    if (record.drive_level) levels.insert(*record.drive_level);
  const std::string noun = drive_channel(dataset.drive_unit);
  const bool recorded = std::any_of(dataset.records.begin(), dataset.records.end(),
                                    [&](const Record& record) { return record.find(noun); });
  if (levels.empty())
    return recorded ? "the drive varies within the records" : "the drive is not known";
  if (levels.size() == 1)
    return fmt::format("1 {}, {} {}", noun, format_number(*levels.begin()),
                       to_string(dataset.drive_unit));
  return fmt::format("{} {} ... {} {}", counted(levels.size(), noun),
                     format_number(*levels.begin()), format_number(*levels.rbegin()),
                     to_string(dataset.drive_unit));
}

}  // namespace

std::string summary(const Dataset& dataset) {
  std::set<std::string> conditions;
  double seconds = 0;
  for (const Record& record : dataset.records) {
    conditions.insert(record.condition);
    if (!record.time.empty()) seconds += record.time.back() - record.time.front();
  }
  return fmt::format(
      "{}: {}, {}, {}, {} s", dataset.name, counted(dataset.records.size(), "record"),
      counted(conditions.size(), "condition"), drive_levels(dataset), format_number(seconds, 3));
}

Terms judged_terms() {
  return {
      {"Free run",
       "the model sees the motion and the drive from the first sample on, and never the measured "
       "force. Warm-up samples are simulated but not scored."},
      {"Left out", "whole records, or whole parts of them, that the fit has not seen."},
      {"Offset",
       "one constant force per record, a declared nuisance: it takes up the zero of the load cell "
       "and the gas force. Figures without offset judge the model as it stands in its file."},
      {"ESR",
       "100 Σe² / Σ(F − mean F)², the share of the force's power that is left unexplained. R² = 1 "
       "− ESR. Fit = 100 (1 − √ESR)."},
      {"RMSE", "√(mean e²), in newtons. RMS / half-span = 200 RMSE / (Fmax − Fmin)."},
      {"Energy error",
       "difference of the dissipated energy ∫F v dt, as a share of the measured one."},
      {"Covered",
       "share of the samples inside the model's 90 % interval of the force. Its width follows "
       "speed and drive and comes from errors on other records, each made by a fit that had not "
       "seen them. On average over many new records of the same kind it covers about 90 %; a "
       "single unlike record can be far from that."},
      {"95 % interval",
       "of a parameter: from the curvature of the fit; it knows nothing of what the model cannot "
       "express."}};
}

DocumentSection judged_section(std::string protocol, const std::vector<std::string>& folds,
                               Terms terms) {
  DocumentSection section{.name = "judged",
                          .title = "How it was judged",
                          .paragraphs = {std::move(protocol)},
                          .facts = std::move(terms),
                          .audience = Audience::Files};
  if (!folds.empty())
    section.lists.push_back({.title = counted(folds.size(), "division"),
                             .lines = folds,
                             .audience = Audience::Page,
                             .folded = true});
  return section;
}

DocumentSection provenance_section(const Dataset& dataset, const std::string& display) {
  DocumentSection section{.name = "provenance", .title = "Provenance", .paragraphs = {}};
  section.facts = {{"Dataset", dataset.name}, {"Citation", dataset.citation}, {"Display", display}};

  // Files and notes open when asked to.
  if (!dataset.files.empty()) {
    DocumentTable files{.title = counted(dataset.files.size(), "file"),
                        .columns = {{"File"}, {"SHA-256"}},
                        .rows = {},
                        .folded = true};
    for (const SourceFile& file : dataset.files) files.rows.push_back({file.path, file.sha256});
    section.tables.push_back(std::move(files));
  }
  if (!dataset.notes.empty())
    section.lists.push_back({.title = counted(dataset.notes.size(), "note") + " on the recordings",
                             .lines = dataset.notes,
                             .folded = true});
  return section;
}

}  // namespace dashpot
