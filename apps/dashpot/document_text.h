#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "console.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// The verdict of a document and its tables, on the terminal; figures are left to the page.
void print_document(const Document& document, Console& console);

/// What speaks against a result, before all else in its files; the terminal has it as warnings.
void add_doubts(std::vector<std::string> doubts, Document& document);

/// Throws Error where a file cannot be written to `path`, before long work. Empty: none is asked
/// for.
void require_output(const std::string& path);
/// The same of a page: also where it is a PDF and no browser is there that prints it.
void require_page(const std::string& path);
/// The document as a page, or as that page printed where the path ends in .pdf.
void write_page(const Document& document, const std::string& path);

/// Writes the document into the folder as <name>.html, <name>.json and <name>.md; with `figures`,
/// its figures for print too, into the folder's figures/; `csv`: the text of <name>.csv, where
/// there is one. Returns the lines that say where all of it is.
std::string write_document(const Document& document, const std::filesystem::path& folder,
                           const std::string& name, bool figures = false,
                           const std::string& csv = "");

}  // namespace dashpot::cli
