#pragma once
#include <string>
#include <vector>

#include "dashpot/report/document.h"
#include "dashpot/report/report.h"

// Tables of models, of a model's parameters and of its records, for every report that has them.
namespace dashpot {

/// A column of the ranking: its name in ModelColumn's list, and who sees it.
struct ColumnChoice {
  const char* name;
  int priority = 0;  ///< as in TextColumn
  Audience audience = Audience::Everyone;
};

/// A record whose curves a page has: an option of its choice.
struct ShownRecord {
  enum class Part { LeftOut, Validation, Training };
  std::string name;
  Part part = Part::LeftOut;
  std::string label() const;  ///< "5 mm 2 Hz", "5 mm 3 Hz (training)"
  /// A model's result on it; null where it was not run there.
  const RecordResult* of(const RankedModel& model) const;
};

/// Every record that a page can show, once: those that models were judged on, further ones, and of
/// the training records those that no division leaves out.
std::vector<ShownRecord> shown_records(const Ranking& ranking);

/// One row per model, best first; a click on it looks closer at the model and its worst record.
DocumentTable model_table(const Ranking& ranking, const std::vector<ColumnChoice>& columns);
/// RMS error by speed and ESR by drive, one row per model that was judged.
DocumentTable breakdown_table(const Ranking& ranking, DriveUnit drive_unit);
/// The models' intervals of the force and what they covered; without rows where none has one.
DocumentTable interval_table(const Ranking& ranking);
/// Value, 95 % interval and remarks of each fitted parameter.
DocumentTable parameter_table(const FitReport& fit);
/// A model's errors on each record; `title`: of the records.
DocumentTable record_table(const Evaluation& evaluation, const std::string& title);

/// "The 90 % interval of the model covers 88.1 % of the samples, ..."; empty without intervals.
std::string interval_sentence(const Evaluation& evaluation);
/// "0.883 ... 1.42": how many times the first model's ESR its own is; "-" where there is none.
std::string over_first_text(const RankedModel& model);
/// "0.8 s", "no, 3.1 %"; "-" when the model has no memory or was not tested.
std::string forgetting_text(const Forgetting& result);
std::string dissipation_text(const Dissipation& result);
/// "yes", "12 spans", "diverged"; "-" when the model was not driven beyond its data.
std::string stress_text(const StressRun& run);

}  // namespace dashpot
