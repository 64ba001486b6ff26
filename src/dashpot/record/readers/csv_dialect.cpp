#include "dashpot/record/readers/csv_dialect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {
namespace {

using Cells = std::vector<std::string_view>;

/// A line without the marks of a comment. A tab that separates opens with an empty cell.
std::string_view strip_comment(std::string_view line, char separator) {
  if (separator != '\t' || !line.starts_with('\t')) line = trim(line);
  while (!line.empty() && (line.front() == '#' || line.front() == '%' || line.front() == '!'))
    line = trim(line.substr(1));
  return line;
}

void drop_trailing_empty(Cells& cells) {
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

/// "-12.093,60" without its marks between thousands; nothing where the groups are not of three
/// digits, or where there is no mark.
std::optional<std::string> without_thousands(std::string_view cell, char decimal, char thousands) {
  const std::size_t end = std::min(cell.find(decimal), cell.size());
  if (cell.find(thousands) >= end) return std::nullopt;
  std::string plain;
  std::size_t group = 0;
  bool first = true;
  for (std::size_t k = 0; k < end; ++k) {
    if (cell[k] == thousands) {
      if (group == 0 || group > 3 || (!first && group != 3)) return std::nullopt;
      group = 0;
      first = false;
      continue;
    }
    group += cell[k] >= '0' && cell[k] <= '9';
    plain += cell[k];
  }
  if (group != 3) return std::nullopt;
  return plain + std::string(cell.substr(end));
}

/// The first mark in the cell that stands between thousands and nowhere else in a number: an
/// apostrophe, straight or not, or a blank at which no line breaks, in UTF-8 or as Windows writes
/// them. Empty where there is none.
std::string_view thousands_mark(std::string_view cell) {
  for (const std::string_view mark : {"'", "\u2019", "\u202F", "\u00A0", "\x92", "\xA0"})
    if (cell.find(mark) != std::string_view::npos) return mark;
  return {};
}

char other_sign(char decimal) { return decimal == '.' ? ',' : '.'; }

/// At least half of the cells that hold something are numbers: dates and events may stand beside
/// them.
bool holds_numbers(const Cells& cells, char decimal) {
  std::size_t numbers = 0, filled = 0;
  for (const std::string_view cell : cells) {
    filled += !cell.empty();
    numbers += number_of_cell(cell, decimal, 0).has_value();
  }
  return numbers > 0 && 2 * numbers >= filled;
}

/// Text that is no UTF-8 is Latin-1.
std::string utf8_of(std::string_view text) {
  if (valid_utf8(text) == text) return std::string(text);
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | byte >> 6);
      out += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

std::string_view trim_right(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

/// Where the quote at `open` is closed; a doubled one is a part of what is quoted. npos where it is
/// not.
std::size_t closing_quote(std::string_view line, std::size_t open) {
  std::size_t close = line.find('"', open + 1);
  while (close != std::string_view::npos && close + 1 < line.size() && line[close + 1] == '"')
    close = line.find('"', close + 2);
  return close;
}

/// A separator and a decimal sign, and how well they explain the lines.
struct Guess {
  CsvDialect dialect;
  std::size_t data_lines = 0, columns = 0, numbers = 0, filled = 0;

  /// Lines that fit, times the share of their cells that are numbers; then the number of numbers.
  std::pair<double, std::size_t> rank() const {
    const double share =
        static_cast<double>(numbers) / static_cast<double>(std::max<std::size_t>(filled, 1));
    return {static_cast<double>(data_lines) * share, numbers};
  }
};

/// Measures how well a separator and a decimal sign explain the lines: as data lines with one
/// common cell count.
Guess try_dialect(const std::vector<std::string>& lines, char separator, char decimal) {
  Guess guess;
  guess.dialect.separator = separator;
  guess.dialect.decimal = decimal;

  // Count the cells of each line that holds numbers; the commonest count is the table's width.
  std::vector<std::size_t> counts(lines.size(), 0);
  std::map<std::size_t, std::size_t> tally;
  Cells cells;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (is_comment(lines[k])) continue;
    split_cells(lines[k], separator, cells);
    if (!holds_numbers(cells, decimal)) continue;
    for (const std::string_view cell : cells) {
      guess.numbers += number_of_cell(cell, decimal, 0).has_value();
      guess.filled += !cell.empty();
    }
    ++tally[counts[k] = cells.size()];
  }

  for (const auto& [count, times] : tally)
    if (times >= guess.data_lines) guess.data_lines = times, guess.columns = count;

  // The table starts with the first line of that width, or before it with those that have a note
  // beside them.
  auto start = static_cast<std::size_t>(std::find(counts.begin(), counts.end(), guess.columns) -
                                        counts.begin());
  while (start > 0 && counts[start - 1] > guess.columns) {
    split_cells(lines[start - 1], separator, cells);
    if (!are_beside(std::span(cells).subspan(guess.columns), guess.dialect)) break;
    cells.resize(guess.columns);
    if (!holds_numbers(cells, decimal)) break;
    --start;
  }
  guess.dialect.first_data_line = start;
  return guess;
}

/// "mm" of "[mm]", and of the "units: mm" that may begin a line of them.
std::string bare_unit(std::string_view cell) {
  cell = trim(cell);
  if (const std::size_t colon = cell.find(':');
      colon != std::string_view::npos && lower(cell).starts_with("unit"))
    cell = trim(cell.substr(colon + 1));
  if (cell.size() > 1 && (cell.front() == '[' || cell.front() == '('))
    cell = cell.substr(1, cell.size() - 2);
  return std::string(trim(cell));
}

bool is_units_row(const Cells& cells) {
  bool any = false;
  for (const std::string_view cell : cells) {
    const std::string unit = text_of_cell(bare_unit(cell));
    if (unit.empty()) continue;
    if (!parse_unit(unit)) return false;
    any = true;
  }
  return any;
}

/// A row of units of which one or some are unknown: most are known, and the line above names them.
bool is_doubtful_units_row(const Cells& cells, const Cells& above) {
  std::size_t known = 0, filled = 0;
  for (const std::string_view cell : cells) {
    const std::string unit = text_of_cell(bare_unit(cell));
    filled += !unit.empty();
    known += !unit.empty() && parse_unit(unit);
  }
  return known >= 1 && 2 * known >= filled && count_channel_names(above) >= 2;
}

/// A line that only parts the names from the numbers: "-----,-----".
bool is_rule(std::string_view line) {
  const auto has = [&](std::string_view text) { return line.find(text) != std::string_view::npos; };
  return line.find_first_not_of("-=_+*|,; \t") == std::string_view::npos &&
         (has("--") || has("==") || has("__"));
}

/// "x [mm]" is one name where blanks separate.
void join_brackets(Cells& cells) {
  Cells joined;
  for (const std::string_view cell : cells) {
    const bool opens = !cell.empty() && (cell.front() == '[' || cell.front() == '(');
    if (opens && !joined.empty())
      joined.back() = {joined.back().data(), cell.data() + cell.size()};
    else
      joined.push_back(cell);
  }
  cells = std::move(joined);
}

/// The cells of the last line before `before` that can head `columns` columns; its index or npos.
std::size_t find_header(const std::vector<std::string>& lines, const CsvDialect& dialect,
                        std::size_t before, std::size_t columns, Cells& cells) {
  // Only the nearest line that holds something is a header: junk stands further up.
  for (std::size_t k = before; k-- > 0;) {
    const std::string_view line = strip_comment(lines[k], dialect.separator);
    if (trim(line).empty() || is_rule(line)) continue;
    split_cells(line, dialect.separator, cells);
    if (dialect.separator == ' ' && cells.size() > columns) join_brackets(cells);
    if (cells.size() > columns && cells[columns].empty()) cells.resize(columns);
    if (cells.size() > columns && cells.front().empty()) cells.erase(cells.begin());
    Cells filled = cells;
    drop_trailing_empty(filled);
    if (filled.empty()) continue;
    const bool is_short = filled.size() + 1 < columns;
    const bool heads = !is_short || (dialect.separator != ' ' &&
                                     (count_channel_names(filled) >= 2 || is_units_row(filled)));
    const bool fits = filled.size() <= columns && heads && !holds_numbers(cells, dialect.decimal);
    return fits && (columns > 1 || cells.size() == 1) ? k : std::string::npos;
  }
  return std::string::npos;
}

/// Whether the first column counts the lines, 0, 1, 2 ... or 1, 2, 3 ..., three at least, which no
/// separator ends; or 4000, 4001, 4002 ... where the second column goes up evenly as well, as a
/// time does.
bool counts_lines(const std::vector<std::string>& lines, const CsvDialect& dialect) {
  constexpr std::size_t kFewest = 3;
  constexpr double kEven = 1e-6;
  std::vector<double> counts, next;
  Cells cells;
  for (std::size_t k = dialect.first_data_line; k < lines.size() && counts.size() < kFewest; ++k) {
    if (is_comment(lines[k])) continue;
    split_cells(lines[k], dialect.separator, cells);
    if (cells.back().empty() || cells.size() < 2) return false;
    counts.push_back(number_of_cell(cells[0], dialect.decimal, 0).value_or(-1));
    next.push_back(number_of_cell(cells[1], dialect.decimal, 0).value_or(0));
  }
  if (counts.size() < kFewest || counts[0] < 0 || counts[1] != counts[0] + 1 ||
      counts[2] != counts[1] + 1)
    return false;

  const double step = next[1] - next[0];
  const bool is_time = step > 0 && std::abs(next[2] - next[1] - step) <= kEven * step;
  return counts[0] == 0 || counts[0] == 1 || (counts[0] == std::floor(counts[0]) && is_time);
}

/// Whether a line that stands above the names holds their units: two at least, one for each name,
/// none of which has a unit itself.
bool heads_with_units(const Cells& units, const Cells& names) {
  constexpr std::size_t kFewest = 2;
  std::size_t measured = 0;
  for (const std::string_view cell : units) {
    const auto unit = parse_unit(text_of_cell(bare_unit(cell)));
    measured += unit && unit->dimension != Dimension{};
  }
  return measured >= kFewest && units.size() == names.size() && is_units_row(units) &&
         count_channel_names(names) >= 2 && std::ranges::all_of(names, [](std::string_view name) {
           return recognise_channel(name, "").unit.empty();
         });
}

/// Fills in names and units from the lines above the data: a line of names, with or without a line
/// of units below or above it. Both stay empty where there is none.
void read_header(const std::vector<std::string>& lines, std::size_t columns, CsvDialect& dialect) {
  dialect.names.assign(columns, "");
  dialect.units.assign(columns, "");
  Cells cells;
  std::size_t at = find_header(lines, dialect, dialect.first_data_line, columns, cells);
  if (at == std::string::npos) return;

  const bool units = is_units_row(cells);
  Cells above;
  const std::size_t line_above = find_header(lines, dialect, at, columns, above);
  const bool has_above = line_above != std::string::npos;
  const bool units_above = has_above && !units && heads_with_units(above, cells);
  if (units_above) std::swap(cells, above);
  if (units_above || (has_above && (units || is_doubtful_units_row(cells, above)))) {
    for (std::size_t k = 0; k < std::min(columns, cells.size()); ++k)
      dialect.units[k] = text_of_cell(bare_unit(cells[k]));
    cells = above;
  }

  // Names that are one too few leave out the first column where that counts the lines.
  if (cells.size() + 1 == columns && counts_lines(lines, dialect)) {
    dialect.counts_rows = true;
    cells.insert(cells.begin(), "");
    std::ranges::rotate(dialect.units, dialect.units.end() - 1);
  }
  for (std::size_t k = 0; k < std::min(columns, cells.size()); ++k)
    dialect.names[k] = text_of_cell(cells[k]);
}

/// Whether that sign stands between thousands: no number has it for a decimal one, and a column
/// that has groups has numbers of three digits without one too. Nothing where no number tells.
std::optional<bool> separates_thousands(const std::vector<std::string>& lines,
                                        const CsvDialect& dialect) {
  std::vector<std::pair<bool, bool>> columns;  // whether each has groups, and numbers without
  Cells cells;
  for (std::size_t line = dialect.first_data_line; line < lines.size(); ++line) {
    if (is_comment(lines[line])) continue;
    split_cells(lines[line], dialect.separator, cells);
    columns.resize(std::max(columns.size(), cells.size()));

    // One decimal is enough to know.
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Grouping grouping = grouping_of(cells[k], dialect.decimal);
      if (grouping == Grouping::Decimal) return false;
      columns[k].first |= grouping == Grouping::Group;
      columns[k].second |= grouping == Grouping::Without;
    }
  }
  if (std::ranges::find(columns, std::pair{true, true}) != columns.end()) return true;
  return std::nullopt;
}

/// "#N/A" at the start of a row of a sheet, which is no comment; English and German.
bool is_sheet_error(std::string_view line) {
  for (const std::string_view error : {"#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!",
                                       "#NULL!", "#NV", "#WERT!", "#BEZUG!", "#ZAHL!"})
    if (line.starts_with(error))
      return line.size() == error.size() ||
             std::string_view(" \t;,").find(line[error.size()]) != std::string_view::npos;
  return false;
}

}  // namespace

Grouping grouping_of(std::string_view cell, char decimal) {
  if (!parse_number(cell, decimal)) return Grouping::Nothing;
  const std::string_view digits = cell.substr(cell.find_first_not_of("+-"));
  const bool has_zero = digits.front() == '0';
  if (digits.find(decimal) == std::string_view::npos) {
    const bool is_whole = digits.find_first_not_of("0123456789") == std::string_view::npos;
    return is_whole && digits.size() == 3 && !has_zero ? Grouping::Without : Grouping::Nothing;
  }
  const bool is_group = without_thousands(digits, other_sign(decimal), decimal).has_value();
  return is_group && !has_zero ? Grouping::Group : Grouping::Decimal;
}

std::size_t count_channel_names(std::span<const std::string_view> cells) {
  return static_cast<std::size_t>(std::ranges::count_if(cells, [](std::string_view cell) {
    return !recognise_channel(text_of_cell(cell), "").channel.empty();
  }));
}

bool is_comment(std::string_view line) {
  if (!line.empty() && line.front() >= '0' && line.front() <= '9') return false;
  line = trim(line);
  if (line.starts_with('#') && is_sheet_error(line)) return false;
  return line.empty() || line.front() == '#' || line.front() == '%' || line.front() == '!' ||
         line.substr(0, 2) == "//";
}

bool are_beside(std::span<const std::string_view> beyond, const CsvDialect& dialect) {
  if (dialect.separator == ' ') return false;
  if (dialect.separator == '\t' && !beyond.empty() && beyond.front().empty()) return true;
  return std::ranges::none_of(beyond, [&](std::string_view cell) {
    return number_of_cell(cell, dialect.decimal, dialect.thousands).has_value();
  });
}

std::optional<double> number_of_cell(std::string_view cell, char decimal, char thousands) {
  if (const auto plain = parse_number(cell, decimal)) return plain;
  if (const std::string_view mark = thousands_mark(cell); !mark.empty()) {
    std::string marked(trim(cell));
    for (std::size_t at = 0; (at = marked.find(mark, at)) != std::string::npos; ++at)
      marked.replace(at, mark.size(), "'");
    const auto joined = without_thousands(marked, decimal, '\'');
    return joined ? parse_number(*joined, decimal) : std::nullopt;
  }
  const bool both = cell.find(decimal) != std::string_view::npos;
  if (!both && thousands == 0) return std::nullopt;
  const auto joined = without_thousands(trim(cell), decimal, other_sign(decimal));
  return joined ? parse_number(*joined, decimal) : std::nullopt;
}

bool leaves_quote_open(std::string_view line) {
  bool cell_begins = true;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (cell_begins && line[k] == '"') {
      k = closing_quote(line, k);
      if (k == std::string_view::npos) return true;
      cell_begins = false;
      continue;
    }
    const bool separates = std::string_view(",;\t").find(line[k]) != std::string_view::npos;
    cell_begins = separates || (cell_begins && line[k] == ' ');
  }
  return false;
}

std::string text_of_cell(std::string_view cell) {
  std::string text = utf8_of(cell);
  for (std::size_t at = 0; (at = text.find("\"\"", at)) != std::string::npos; ++at)
    text.erase(at, 1);
  return text;
}

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  const bool blanks = separator == ' ';
  cells.clear();
  if (blanks) line = trim(line);

  for (std::size_t start = 0;; ++start) {
    // A cell starts behind blanks; a tab is one unless it separates.
    while (start < line.size() &&
           (line[start] == ' ' || (line[start] == '\t' && separator != '\t')))
      ++start;

    // Its end: the next separator, behind the closing quote when it is quoted.
    const bool quoted = start < line.size() && line[start] == '"';
    const std::size_t close = quoted ? closing_quote(line, start) : std::string_view::npos;
    const std::size_t from = close == std::string_view::npos ? start : close + 1;
    const std::size_t end = std::min(
        blanks ? line.find_first_of(" \t", from) : line.find(separator, from), line.size());

    cells.push_back(close == std::string_view::npos
                        ? trim_right(line.substr(start, end - start))
                        : trim(line.substr(start + 1, close - start - 1)));
    start = end;
    if (end == line.size()) return;
  }
}

CsvDialect sniff_dialect(const std::vector<std::string>& lines, const std::string& file,
                         std::optional<char> known_separator) {
  // A decimal comma between commas stands in quotes.
  constexpr std::array<std::pair<char, char>, 8> kCandidates{{{'\t', '.'},
                                                              {';', '.'},
                                                              {',', '.'},
                                                              {'\t', ','},
                                                              {';', ','},
                                                              {' ', '.'},
                                                              {' ', ','},
                                                              {',', ','}}};
  Guess best;
  for (const auto& [separator, decimal] : kCandidates) {
    if (known_separator && separator != *known_separator) continue;
    Guess guess = try_dialect(lines, separator, decimal);
    if (guess.rank() > best.rank()) best = std::move(guess);
  }
  if (best.data_lines == 0)
    throw NoTable(file, "no line holds numbers in columns",
                  "give a table: a line of names, then one line per sample");
  const std::optional<bool> groups = separates_thousands(lines, best.dialect);
  best.dialect.is_open = !groups;
  if (groups.value_or(false)) {
    best.dialect.thousands = best.dialect.decimal;
    best.dialect.decimal = other_sign(best.dialect.decimal);
  }

  // One number with both signs shows that groups are used, so that "1.093" is one too.
  Cells cells;
  for (std::size_t k = best.dialect.first_data_line; k < lines.size(); ++k) {
    split_cells(lines[k], best.dialect.separator, cells);
    for (const std::string_view cell : cells) {
      if (parse_number(cell, best.dialect.decimal) ||
          !number_of_cell(cell, best.dialect.decimal, 0))
        continue;
      best.dialect.is_open = false;
      if (const std::string_view mark = thousands_mark(cell); !mark.empty())
        best.dialect.thousands_mark = text_of_cell(mark);
      else
        best.dialect.thousands = other_sign(best.dialect.decimal);
    }
  }
  read_header(lines, best.columns, best.dialect);
  return best.dialect;
}

}  // namespace dashpot
