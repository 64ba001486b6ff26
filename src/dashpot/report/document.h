#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/report/text_table.h"
#include "dashpot/value.h"

namespace dashpot {

// Pages of words, tables and figures, such as a study makes: data once, and from there HTML,
// Markdown, JSON and figures for print.

struct DocumentTable {
  std::string title;
  std::vector<TextColumn> columns;
  std::vector<std::vector<std::string>> rows;
  std::string note = {};  ///< below it
};

/// A curve or a cloud of points. Numbers that are not finite break a line.
struct FigureSeries {
  enum class Mark { Line, Dashes, Dots };
  std::string label;   ///< equal labels share one entry of the legend; empty: none
  std::string colour;  ///< of the page's palette: "measured", "modelled", "series-1" ... "series-8"
  std::vector<double> x, y;
  Mark mark = Mark::Line;
  double width = 1.5;  ///< of a line; of dots their size
};

struct FigurePanel {
  std::string title, x_label, y_label;
  std::vector<FigureSeries> series;
  std::vector<std::string> places = {};  ///< words at x = 0, 1, ... instead of numbers
};

struct DocumentFigure {
  std::string name;            ///< of its files: "figure-8"
  std::string title, caption;  ///< a few words; what is seen
  std::vector<FigurePanel> panels;
  std::size_t columns = 1;  ///< panels abreast
};

/// Words first, then tables, then figures, then remarks.
struct DocumentSection {
  std::string name, title;
  std::vector<std::string> paragraphs;
  std::vector<DocumentTable> tables = {};
  std::vector<DocumentFigure> figures = {};
  std::vector<std::string> remarks = {};
};

struct Document {
  std::string title, subtitle;
  std::string verdict;  ///< a few sentences: what came out
  std::vector<DocumentSection> sections;
  std::string command;  ///< that makes all of it again
  std::string version, date;
};

/// One self-contained page, its plots to be zoomed and read.
std::string html_document(const Document& document);
/// `figures`: the folder of the figures as a link has it; empty: without figures. Has no date, so
/// that it can be kept under version control.
std::string markdown_document(const Document& document, const std::string& figures);
/// Every figure as <name>.svg and <name>.pdf, drawn by gnuplot. Returns the paths. Throws Error
/// when gnuplot is missing.
std::vector<std::filesystem::path> write_document_figures(const Document& document,
                                                          const std::filesystem::path& folder);

/// The tables' cells as text, by section.
Value document_json(const Document& document);

}  // namespace dashpot
