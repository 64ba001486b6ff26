#include "dashpot/record/readers/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv_dialect.h"
#include "dashpot/record/readers/line_source.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kSniffedLines = 300;

/// The common case (a plain number with a point) without the checks that parse_number adds.
double number_or_nan(std::string_view cell, char decimal) {
  if (decimal == '.') {
    double value;
    const char* end = cell.data() + cell.size();
    const auto result = std::from_chars(cell.data(), end, value);
    if (result.ec == std::errc{} && result.ptr == end) return value;
  }
  return parse_number(cell, decimal).value_or(std::numeric_limits<double>::quiet_NaN());
}

RawTable empty_table(const CsvDialect& dialect, const std::string& file) {
  RawTable table;
  table.file = file;
  for (std::size_t k = 0; k < dialect.names.size(); ++k)
    table.columns.push_back({dialect.names[k], dialect.units[k], {}, {}});
  return table;
}

/// Appends rows to a table, one line at a time.
class RowAppender {
 public:
  RowAppender(RawTable& table, const CsvDialect& dialect) : table_(table), dialect_(dialect) {}

  void append(std::string_view text, std::size_t line) {
    if (is_comment(text)) return;
    split_cells(text, dialect_.separator, cells_);
    require_cell_count(line);
    const std::size_t row = table_.rows();
    if (line != next_line_) table_.lines.emplace_back(row, line);
    next_line_ = line + 1;
    for (std::size_t k = 0; k < table_.columns.size(); ++k) append_cell(table_.columns[k], k, row);
  }

 private:
  void append_cell(RawColumn& column, std::size_t k, std::size_t row) {
    const std::string_view cell = k < cells_.size() ? cells_[k] : std::string_view();
    double value = number_or_nan(cell, dialect_.decimal);
    if (!std::isfinite(value)) {
      if (!column.bad) column.bad = BadCell{row, std::string(cell.substr(0, 40))};
      value = std::numeric_limits<double>::quiet_NaN();
    }
    column.values.push_back(value);
  }

  /// Empty cells at the end may be missing or too many (trailing separators); filled ones may not.
  void require_cell_count(std::size_t line) {
    while (cells_.size() > table_.columns.size() && cells_.back().empty()) cells_.pop_back();
    const std::size_t expected = table_.columns.size();
    if (cells_.size() <= expected) return;
    throw Error(table_.file + ":" + std::to_string(line),
                "has " + std::to_string(cells_.size()) + " cells, the table has " +
                    std::to_string(expected) + " columns",
                "write one sample per line with the same separator everywhere");
  }

  RawTable& table_;
  const CsvDialect& dialect_;
  std::vector<std::string_view> cells_;
  std::size_t next_line_ = 0;
};

/// Room for the rest of the file at once, so that growing does not hold every column twice.
void reserve_rows(RawTable& table, const LineSource& source) {
  const double rows = source.bytes_in_file() / std::max(source.bytes_per_line(), 1.0);
  if (rows > 1e5 && rows < 1e10)
    for (RawColumn& column : table.columns)
      column.values.reserve(static_cast<std::size_t>(1.1 * rows));
}

/// Columns at the end without a name and without a number come from trailing separators.
void drop_empty_columns(RawTable& table) {
  const auto empty = [](const RawColumn& column) {
    return column.name.empty() && std::all_of(column.values.begin(), column.values.end(),
                                              [](double v) { return std::isnan(v); });
  };
  while (table.columns.size() > 1 && empty(table.columns.back())) table.columns.pop_back();
}

bool is_utf16(std::string_view head) {
  return head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF");
}

}  // namespace

bool is_csv(const fs::path&, std::string_view extension, std::string_view head) {
  constexpr std::string_view kExtensions[] = {".csv", ".txt", ".tsv", ".dat", ".asc", ".log", ""};
  const bool text = head.find('\0') == std::string_view::npos || is_utf16(head);
  return text && std::find(std::begin(kExtensions), std::end(kExtensions), extension) !=
                     std::end(kExtensions);
}

std::vector<RawTable> read_csv(const fs::path& path) {
  if (is_utf16(read_head(path, 2)))
    throw Error(path.string(), "is UTF-16 text", "save it as UTF-8");
  LineSource source(path);

  // Understand the dialect from the first lines.
  std::vector<std::string> head;
  while (head.size() < kSniffedLines) {
    const auto line = source.next();
    if (!line) break;
    head.emplace_back(*line);
  }
  const CsvDialect dialect = sniff_dialect(head, path.string());

  // Then one line at a time: those already read, and the rest of the file.
  RawTable table = empty_table(dialect, path.string());
  reserve_rows(table, source);
  RowAppender appender(table, dialect);
  for (std::size_t k = dialect.first_data_line; k < head.size(); ++k)
    appender.append(head[k], k + 1);
  while (const auto line = source.next()) appender.append(*line, source.line());

  drop_empty_columns(table);
  std::vector<RawTable> tables;
  tables.push_back(std::move(table));
  return tables;
}

TextTable read_text_table(const fs::path& path) {
  LineSource source(path);
  TextTable table;
  std::vector<std::string_view> cells;
  char separator = ',';
  while (const auto line = source.next()) {
    if (is_comment(*line)) continue;

    // The first line names the columns and decides on the separator.
    if (table.names.empty())
      for (const char candidate : {';', '\t', ','})
        if (line->find(candidate) != std::string_view::npos) separator = candidate;
    split_cells(*line, separator, cells);
    if (table.names.empty()) {
      table.names.assign(cells.begin(), cells.end());
      continue;
    }

    if (cells.size() < table.names.size())
      throw Error(path.string() + ":" + std::to_string(source.line()),
                  "has " + std::to_string(cells.size()) + " cells, the first line names " +
                      std::to_string(table.names.size()));
    table.rows.emplace_back(cells.begin(), cells.end());
    table.lines.push_back(source.line());
  }
  return table;
}

}  // namespace dashpot
