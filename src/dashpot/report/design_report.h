#pragma once
#include <string>

#include "dashpot/design/design.h"
#include "dashpot/report/document.h"

namespace dashpot {

/// Input of the report of a design run.
struct DesignInput {
  const DesignReport& design;
  std::string command;  ///< the command line that prints all its figures again
  std::string version;
  std::string date;  ///< ISO 8601
};

/// The front, all designs, their constraints and tolerances. Its data are json_design().
Document design_document(const DesignInput& input);

/// Variables and goals of every design; a terminal gets those that stand out, and others between
/// them.
DocumentTable design_table(const DesignReport& report);
/// Every constraint of one design: asked, reached, left over.
DocumentTable constraint_table(const DesignReport& report, const Design& design);
/// The effect of each tolerance on each figure of a design whose sensitivity was assessed.
DocumentTable sensitivity_table(const DesignReport& report, const Design& design);
/// A few sentences: the designs that were found, or the constraints that conflict.
std::string design_verdict(const DesignReport& report);

/// Everything for programs; and one line per design, in SI and without times.
Value json_design(const DesignInput& input);
std::string csv_design(const DesignReport& report);

}  // namespace dashpot
