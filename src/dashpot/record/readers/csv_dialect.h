#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot {

/// The conventions of one text table.
struct CsvDialect {
  char separator = ',';  ///< ' ' stands for any run of blanks
  char decimal = '.';
  char thousands = 0;               ///< the other of '.' and ',' where numbers are grouped by it
  std::string thousands_mark;       ///< one that no decimal sign can be, as in 1'093.60; or empty
  std::size_t first_data_line = 0;  ///< index into the sample of lines
  std::vector<std::string> names;   ///< one per column; all "" when no line names them
  std::vector<std::string> units;   ///< from a row of units; "" where there is none
  bool counts_rows = false;         ///< the first column does, and the line of names leaves it out
  bool is_open = false;  ///< no number tells whether `decimal` stands between thousands instead
};

/// What a number tells of the sign that was taken for the decimal one.
enum class Grouping { Nothing, Without, Group, Decimal };

/// "1,124" is a group, "0,5" and "1,09" are decimals; "987" would have none in either case.
Grouping grouping_of(std::string_view cell, char decimal);

/// Splits one line into cells, trimmed and without their quotes. Cells point into `line` and are
/// valid as long as it is; `cells` is cleared first, and reused to save allocations. A quoted cell
/// ends at its next quote that is not doubled; it keeps those that are, for text_of_cell().
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

/// The text of a cell: doubled quotes as single ones, Latin-1, which Windows programs write
/// ("[\xB5m]", "[m/s\xB2]"), as UTF-8.
std::string text_of_cell(std::string_view cell);

/// Whether a quoted cell of the line has no end in it, whatever separates: it goes on in the next
/// line.
bool leaves_quote_open(std::string_view line);

/// How many cells name channels. Two or more are a heading, though columns behind them have no
/// name.
std::size_t count_channel_names(std::span<const std::string_view> cells);

/// The number in a cell. "1.093,60" is one by itself, since it holds both signs, and so is
/// "1'093.60"; "1.093" is 1093 only where `thousands` says that such groups are used.
std::optional<double> number_of_cell(std::string_view cell, char decimal, char thousands);

/// Whether the cells of a row beyond the table's columns are notes beside it: texts, or whatever an
/// empty cell parts from the table where tabs separate, as in a sheet. Elsewhere a number too many
/// may be a decimal comma.
bool are_beside(std::span<const std::string_view> beyond, const CsvDialect& dialect);

/// A comment or an empty line holds no sample.
bool is_comment(std::string_view line);

/// Understands a table from its first lines: tries seven pairs of separator and decimal sign, and
/// keeps the one under which most lines hold numbers in equally many cells. `separator` leaves the
/// decimal sign alone open. Throws NoTable(file, ...) when no line holds numbers.
CsvDialect sniff_dialect(const std::vector<std::string>& lines, const std::string& file,
                         std::optional<char> separator = {});

}  // namespace dashpot
