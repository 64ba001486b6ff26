#pragma once
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/report/document.h"
#include "dashpot/report/velocity_check.h"

namespace dashpot {

/// Input of the report on recordings.
struct InspectionInput {
  const Dataset& dataset;
  const std::vector<VelocityCheck>& checks;
  std::string command;
  std::string version;
  std::string date;  ///< ISO 8601
  PrintUnits units = {};
  bool has_curves = true;  ///< what a page draws: all samples are looked at for it
};

/// How recordings were understood: every column and record, the channels of each record in time and
/// against each other, and a measured velocity beside the one derived from displacement. Its data
/// hold columns, records, velocity checks and notes.
Document inspection_document(const InspectionInput& input);

}  // namespace dashpot
