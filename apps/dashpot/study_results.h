#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// The folder of a study: its page, and finished work that an interrupted one goes on from.
struct StudyResults {
  std::string folder;
  bool figures = false;
  bool fresh = false;  ///< neither use nor keep what was finished
};

/// kept: what the folder keeps, "fits".
std::vector<Option> study_result_options(StudyResults& results, const std::string& kept);

/// Throws UsageError or Error where the folder cannot be made.
void prepare_study(const StudyResults& results);

/// Prints the document and writes it with its data as a page, Markdown and JSON.
void write_study(Document document, Value data, const StudyResults& results, Console& console);

}  // namespace dashpot::cli
