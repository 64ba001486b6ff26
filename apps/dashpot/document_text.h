#pragma once
#include <filesystem>
#include <string>

#include "console.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// The verdict of a document and its tables, on the terminal; figures are left to the page.
void print_document(const Document& document, Console& console);

/// Writes the document into the folder as <name>.html, <name>.json and <name>.md; with `figures`,
/// its figures for print too, into the folder's figures/; `csv`: the text of <name>.csv, where
/// there is one. Returns the lines that say where all of it is.
std::string write_document(const Document& document, const std::filesystem::path& folder,
                           const std::string& name, bool figures = false,
                           const std::string& csv = "");

}  // namespace dashpot::cli
