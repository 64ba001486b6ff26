#pragma once
#include <string>
#include <vector>

#include "dashpot/design/design.h"
#include "dashpot/value.h"

namespace dashpot {

/// What the report of a design run is made from.
struct DesignInput {
  const DesignReport& design;
  std::string command;  ///< the command line that prints all its figures again
  std::string version;
  std::string date;  ///< ISO 8601
};

/// The designs that stand out, then others up to `most`, as a table for a terminal: variables and
/// goals.
std::string design_table(const DesignReport& report, int width, std::size_t most);
/// Every constraint of one design: asked, reached, left over.
std::string constraint_table(const DesignReport& report, const Design& design, int width);
/// What each tolerance does to each figure; empty where the design has no sensitivity.
std::string sensitivity_table(const DesignReport& report, const Design& design, int width);
/// A few sentences: what was found, or which constraints conflict.
std::string design_verdict(const DesignReport& report);

/// As a page, for programs, as Markdown, and one line per design in SI. The last holds no times.
std::string html_design(const DesignInput& input);
Value json_design(const DesignInput& input);
std::string markdown_design(const DesignInput& input);
std::string csv_design(const DesignReport& report);

}  // namespace dashpot
