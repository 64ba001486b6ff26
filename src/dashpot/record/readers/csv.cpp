#include "dashpot/record/readers/csv.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv_dialect.h"
#include "dashpot/record/readers/line_source.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kSniffedLines = 300;
constexpr std::size_t kMissingCells = 1'000'000;  // beyond as many as there are

/// The common case (a plain number with a point) without the checks that parse_number adds.
double number_or_nan(std::string_view cell, const CsvDialect& dialect) {
  if (dialect.decimal == '.') {
    double value;
    const char* end = cell.data() + cell.size();
    const auto result = std::from_chars(cell.data(), end, value);
    if (result.ec == std::errc{} && result.ptr == end) return value;
  }
  return number_of_cell(cell, dialect.decimal, dialect.thousands)
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

void add_empty_columns(RawTable& table, const CsvDialect& dialect) {
  for (std::size_t k = 0; k < dialect.names.size(); ++k)
    table.columns.push_back({dialect.names[k], dialect.units[k], {}, {}});
}

/// Takes a number of so many digits, at least `least`, off the front; nothing where they are not
/// there.
std::optional<int> take_digits(std::string_view& text, std::size_t least, std::size_t most) {
  int value = 0;
  std::size_t count = 0;
  while (count < most && count < text.size() && text[count] >= '0' && text[count] <= '9')
    value = 10 * value + (text[count++] - '0');
  if (count < least) return std::nullopt;
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

struct ClockTime {
  double seconds = 0;   ///< whole ones since midnight, or since 1970 with a date
  double fraction = 0;  ///< of a second: apart, since 1.8e9 s leave it seven digits
  bool dated = false;
};

/// Takes "2026-11-23T" or "23.11.2026 " off the front: the days since 1970. Nothing is taken of any
/// other text, and of a date that is none.
std::optional<double> take_date(std::string_view& text) {
  std::string_view rest = text;
  const auto first = take_digits(rest, 2, 4);
  if (!first) return std::nullopt;
  const bool iso = text.size() - rest.size() == 4 && take(rest, "-/");
  const bool german = !iso && text.size() - rest.size() == 2 && take(rest, ".");
  if (!iso && !german) return std::nullopt;

  const auto month = take_digits(rest, 2, 2);
  if (!month || !take(rest, iso ? "-/" : ".")) return std::nullopt;
  const auto last = take_digits(rest, iso ? 2 : 4, iso ? 2 : 4);
  if (!last || !take(rest, "T ")) return std::nullopt;
  const std::chrono::year_month_day day{std::chrono::year(iso ? *first : *last),
                                        std::chrono::month(unsigned(*month)),
                                        std::chrono::day(unsigned(iso ? *last : *first))};
  if (!day.ok()) return std::nullopt;
  text = rest;
  return double(std::chrono::sys_days(day).time_since_epoch().count());
}

/// Takes "5/6/2026 " off the front, which may be a day of May or of June: the time of day that
/// follows counts by itself, and on behind midnight.
void take_open_date(std::string_view& text) {
  std::string_view rest = text;
  if (!take_digits(rest, 1, 2) || !take(rest, "/.-") || !take_digits(rest, 1, 2) ||
      !take(rest, "/.-") || !take_digits(rest, 2, 4) || !take(rest, " "))
    return;
  text = rest;
}

/// Takes "AM" or "PM" off the front, where it is there, into hours of 24; false for 13 PM.
bool take_half_of_day(std::string_view& text, int& hours) {
  std::string_view rest = trim(text);
  const std::string half = lower(rest.substr(0, 2));
  if (half != "am" && half != "pm") return true;
  text = rest.substr(2);
  if (hours < 1 || hours > 12) return false;
  hours = hours % 12 + (half == "pm" ? 12 : 0);
  return true;
}

/// Takes "Z" or "+01:00" off the front, where it is there: one clock has one zone.
void take_zone(std::string_view& text) {
  if (take(text, "Z")) return;
  std::string_view rest = text;
  if (!take(rest, "+-") || !take_digits(rest, 2, 2)) return;
  take(rest, ":");
  if (take_digits(rest, 2, 2)) text = rest;
}

/// "2026-11-23T10:05:07.25", "23.11.2026 10:05:07,25", "11/23/2026 10:05:07.25 PM", "10:05:07:250".
/// Two numbers alone ("10:05") may be hours or minutes: they are none.
std::optional<ClockTime> clock_time(std::string_view text) {
  ClockTime out;
  const std::optional<double> days = take_date(text);
  out.dated = days.has_value();
  if (!days) take_open_date(text);

  // The time of the day.
  auto hours = take_digits(text, 1, 2);
  if (!hours || !take(text, ":")) return std::nullopt;
  const auto minutes = take_digits(text, 2, 2);
  if (!minutes || !take(text, ":")) return std::nullopt;
  const auto seconds = take_digits(text, 2, 2);
  if (!seconds || *minutes > 59 || *seconds > 60) return std::nullopt;

  // Behind a colon stand milliseconds or microseconds, all their digits.
  const bool colon = text.starts_with(':');
  if (take(text, ".,:")) {
    std::size_t end = 0;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
    const auto part = parse_number("0." + std::string(text.substr(0, end)));
    if (end == 0 || !part || (colon && end != 3 && end != 6)) return std::nullopt;
    out.fraction = *part;
    text.remove_prefix(end);
  }

  if (!take_half_of_day(text, *hours) || *hours > 23) return std::nullopt;
  take_zone(text);
  if (!text.empty()) return std::nullopt;
  out.seconds = 86400 * days.value_or(0) + 3600 * *hours + 60 * *minutes + *seconds;
  return out;
}

/// A line of many, and whether it is plain: a finite number in each column, and nothing else.
struct LineOfBlock {
  std::size_t number = 0, begin = 0, size = 0;  ///< in the file; where its text lies
  bool is_plain = false;
};

/// Lines that are read together.
struct Block {
  std::string text;
  std::vector<LineOfBlock> lines;
  std::vector<double> numbers;  ///< of the plain lines, one behind the other

  void add(std::string_view line, std::size_t number) {
    lines.push_back({number, text.size(), line.size()});
    text += line;
  }
  std::string_view text_of(const LineOfBlock& line) const {
    return std::string_view(text).substr(line.begin, line.size);
  }
  void clear() { text.clear(), lines.clear(), numbers.clear(); }
};

/// Finds the plain lines of a block, and their numbers.
void read_numbers(Block& block, const CsvDialect& dialect) {
  // Zeros show that something was lost: then each line is looked at.
  const bool is_whole = block.text.find('\0') == std::string::npos;
  std::vector<std::string_view> cells;
  for (LineOfBlock& line : block.lines) {
    split_cells(block.text_of(line), dialect.separator, cells);
    line.is_plain = is_whole && cells.size() == dialect.names.size();
    const std::size_t before = block.numbers.size();
    for (std::size_t k = 0; k < cells.size() && line.is_plain; ++k) {
      block.numbers.push_back(number_or_nan(cells[k], dialect));
      line.is_plain = std::isfinite(block.numbers.back());
    }
    if (!line.is_plain) block.numbers.resize(before);
  }
}

/// Appends rows to a table, one line at a time.
class RowAppender {
 public:
  RowAppender(RawTable& table, const CsvDialect& dialect)
      : table_(table),
        dialect_(dialect),
        is_open_(dialect.is_open),
        groups_(is_open_ ? table.columns.size() : 0) {}

  /// Clock times are counted in s from the first; a column that also holds plain numbers is none.
  void settle_clocks() {
    for (const auto& [k, clock] : clocks_) {
      RawColumn& column = table_.columns[k];
      const auto empty = static_cast<std::size_t>(
          std::ranges::count_if(column.values, [](double v) { return std::isnan(v); }));
      if (clock.count + empty != column.values.size()) {
        column.bad = BadCell{0, "a mix of clock times and numbers"};
        continue;
      }
      column.unit = "s";
      table_.notes.push_back(
          "'" + column.name + "' holds times of a clock: counted in s from the " +
          "whole second of the first" + (clock.midnights > 0 ? ", on behind midnight" : ""));
    }
  }

  /// Refuses "1,124" beside "987" in a column where nothing tells whether it is 1.124 or 1124. The
  /// first lines, where they have both, tell that it is 1124.
  void settle_groups() const {
    if (!is_open_) return;
    for (const Groups& groups : groups_)
      if (!groups.first.empty() && groups.has_plain)
        throw Error(table_.at_line(groups.line),
                    "'" + groups.first +
                        "' may be in thousands or have decimals, and no number of the file tells",
                    "write numbers without signs between thousands");
  }

  /// Says what stood beside the table and was not read.
  void note_beside() {
    if (noted_ > 0)
      table_.notes.push_back("cells beside the table passed over: " + first_note_ +
                             (noted_ > 1 ? ", and in " + std::to_string(noted_ - 1) +
                                               (noted_ > 2 ? " more rows" : " more row")
                                         : ""));
  }

  /// Says where the names stood again.
  void note_headings() {
    if (headings_ > 0)
      table_.notes.push_back("the names stand again at " + first_heading_ +
                             (headings_ > 2
                                  ? " and " + std::to_string(headings_ - 1) + " times more"
                              : headings_ > 1 ? " and once more"
                                              : "") +
                             ": passed over, the rows below go on");
  }

  /// The lines of a block whose numbers have been read.
  void append(const Block& block) {
    auto numbers = block.numbers.begin();
    for (const LineOfBlock& line : block.lines) {
      const auto own = numbers;
      if (line.is_plain) numbers += static_cast<std::ptrdiff_t>(table_.columns.size());
      if (line.is_plain && !is_open_ && other_heading_.empty())
        append_plain(own, line.number);
      else
        append(block.text_of(line), line.number);
    }
  }

 private:
  /// A row of which nothing can be said but its numbers.
  void append_plain(std::vector<double>::const_iterator numbers, std::size_t line) {
    given_ += table_.columns.size();
    note_line(line);
    for (RawColumn& column : table_.columns) column.values.push_back(*numbers++);
  }

  /// Any row.
  void append(std::string_view text, std::size_t line) {
    if (is_comment(text)) return;
    require_whole(text, line);
    split_cells(text, dialect_.separator, cells_);
    if (is_heading(line)) return;
    require_cell_count(line);
    if (is_open_) watch_groups(line);
    const std::size_t row = table_.rows();
    note_line(line);
    for (std::size_t k = 0; k < table_.columns.size(); ++k) append_cell(table_.columns[k], k, row);
  }

  /// Notes the line of the row that comes next where the numbering jumps.
  void note_line(std::size_t line) {
    if (line != next_line_) table_.lines.emplace_back(table_.rows(), line);
    next_line_ = line + 1;
  }

  /// Whole numbers of three digits in a column, and the first with a sign before three digits.
  struct Groups {
    std::string first;
    std::size_t line = 0;
    bool has_plain = false;
  };

  void watch_groups(std::size_t line) {
    for (std::size_t k = 0; k < std::min(cells_.size(), groups_.size()) && is_open_; ++k) {
      const Grouping grouping = grouping_of(cells_[k], dialect_.decimal);
      is_open_ = grouping != Grouping::Decimal;
      groups_[k].has_plain |= grouping == Grouping::Without;
      if (grouping == Grouping::Group && groups_[k].first.empty())
        groups_[k].first = cells_[k], groups_[k].line = line;
    }
  }

  /// Zeros stand where a disk or a logger lost what belongs there; a number before them may be cut.
  /// A row of nothing else is one without numbers.
  void require_whole(std::string_view text, std::size_t line) const {
    constexpr std::string_view kNothing("\0 \t\r", 4);
    if (text.find('\0') == std::string_view::npos ||
        text.find_first_not_of(kNothing) == std::string_view::npos)
      return;
    throw Error(table_.at_line(line), "holds NUL bytes: a part of the row was lost",
                "copy the file again from its source, or delete the row");
  }

  /// Whether the row holds the names of the table, or their units, once more. Throws Error at the
  /// first numbers below other names, which belong to another table.
  bool is_heading(std::size_t line) {
    const bool begins_as_number =
        !cells_.front().empty() &&
        std::string_view("+-.,0123456789").find(cells_.front().front()) != std::string_view::npos;
    if (begins_as_number && other_heading_.empty()) return false;

    const bool has_number = std::ranges::any_of(cells_, [&](std::string_view cell) {
      return number_of_cell(cell, dialect_.decimal, dialect_.thousands).has_value();
    });
    if (has_number && !other_heading_.empty())
      throw Error(table_.at_line(line),
                  "belongs to another table, which " + other_heading_ + " heads",
                  "give each table a file of its own");
    if (has_number) return false;

    // The same names, or the units that stand below them, with their brackets.
    std::vector<std::string> texts;
    for (const std::string_view cell : cells_) texts.push_back(text_of_cell(cell));
    while (texts.size() > dialect_.names.size() && texts.back().empty()) texts.pop_back();
    texts.resize(std::max(texts.size(), dialect_.names.size()));
    if (table_.named() && texts == dialect_.names) {
      if (headings_++ == 0) first_heading_ = table_.at_line(line);
      units_may_follow_ = true;
      return true;
    }
    const auto holds = [](const std::string& text, const std::string& unit) {
      return text.empty() == unit.empty() && text.find(unit) != std::string::npos;
    };
    if (std::exchange(units_may_follow_, false) && std::ranges::equal(texts, dialect_.units, holds))
      return true;

    // Other names: most of the texts are some.
    const auto filled =
        std::ranges::count_if(texts, [](const auto& text) { return !text.empty(); });
    if (const std::size_t named = count_channel_names(cells_);
        named >= 2 && 2 * named >= static_cast<std::size_t>(filled))
      other_heading_ = "line " + std::to_string(line) + " ('" + texts.front() + "' ...)";
    return false;
  }

  void append_cell(RawColumn& column, std::size_t k, std::size_t row) {
    const std::string_view cell = k < cells_.size() ? cells_[k] : std::string_view();
    double value = number_or_nan(cell, dialect_);
    if (!std::isfinite(value)) {
      if (const auto clock = clock_time(cell)) return append_clock(column, clocks_[k], *clock);
      if (!column.bad) column.bad = BadCell{row, std::string(cell.substr(0, 40))};
      value = std::numeric_limits<double>::quiet_NaN();
    }
    column.values.push_back(value);
  }

  /// What is known of a column of clock times.
  struct Clock {
    std::size_t count = 0, midnights = 0;
    double whole_seconds = 0;  ///< of the first, from which the others are counted
    double last = 0;
  };

  void append_clock(RawColumn& column, Clock& clock, const ClockTime& time) {
    constexpr double kDay = 86400;
    if (clock.count++ == 0) clock.whole_seconds = time.seconds;
    double seconds = time.seconds - clock.whole_seconds + time.fraction;
    // Behind midnight a time without a date starts again.
    if (!time.dated) {
      seconds += kDay * static_cast<double>(clock.midnights);
      if (seconds < clock.last - kDay / 2) ++clock.midnights, seconds += kDay;
    }
    // To the nanosecond: the stamps are printed decimals, their differences are not.
    seconds = std::round(1e9 * seconds) / 1e9;
    clock.last = seconds;
    column.values.push_back(seconds);
  }

  /// Empty cells at the end may be missing or too many (trailing separators); filled ones may not,
  /// but for notes beside the table.
  void require_cell_count(std::size_t line) {
    while (cells_.size() > table_.columns.size() && cells_.back().empty()) cells_.pop_back();
    const std::size_t expected = table_.columns.size();
    if (cells_.size() > expected && are_beside(std::span(cells_).subspan(expected), dialect_)) {
      if (noted_++ == 0)
        first_note_ = "'" + std::string(cells_.back()) + "' at " + table_.at_line(line);
      cells_.resize(expected);
    }
    if (cells_.size() > expected)
      throw Error(table_.at_line(line),
                  "has " + std::to_string(cells_.size()) + " cells, the table has " +
                      std::to_string(expected) + " columns",
                  "write one sample per line with the same separator everywhere");

    // Cells that are not there cost no byte of the file and eight of memory each.
    given_ += cells_.size(), missing_ += expected - cells_.size();
    if (missing_ > given_ + kMissingCells)
      throw Error(
          table_.at_line(line), "most lines up to here lack most of their cells",
          "the first lines have " + std::to_string(expected) + " columns: is another table below?");
  }

  RawTable& table_;
  const CsvDialect& dialect_;
  std::vector<std::string_view> cells_;
  std::size_t next_line_ = 0, given_ = 0, missing_ = 0, noted_ = 0;
  std::string first_note_;
  std::size_t headings_ = 0;  ///< rows that name the columns again
  std::string first_heading_, other_heading_;
  bool units_may_follow_ = false;
  std::map<std::size_t, Clock> clocks_;  ///< by column
  bool is_open_;                         ///< no number has told what stands between digits
  std::vector<Groups> groups_;           ///< by column, while that is so
};

/// Reads the lines of a table block by block: while all cores find the numbers of some, the next
/// are filled.
class BlockReader {
 public:
  BlockReader(Lines& source, const CsvDialect& dialect)
      : source_(source),
        dialect_(dialect),
        blocks_(static_cast<std::size_t>(default_threads())),
        next_(blocks_.size()) {}

  /// A line that the source has given already.
  void add(std::string_view text, std::size_t number) { next_.front().add(text, number); }

  /// Appends those lines and all that are left. Where the source cannot be read on, what is wrong
  /// in the lines before it counts first.
  void append_all(RowAppender& appender) {
    while (!next_.front().lines.empty()) {
      std::swap(blocks_, next_);
      const bool is_little = blocks_.front().text.size() < kBlock;
      parallel_for(blocks_.size() + 1, is_little ? 1 : 0, [&](std::size_t k) {
        if (k == 0)
          fill_next();
        else
          read_numbers(blocks_[k - 1], dialect_);
      });
      for (Block& block : blocks_) {
        appender.append(block);
        block.clear();
      }
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 18;  // bytes: hundreds of microseconds

  void fill_next() {
    try {
      for (Block& block : next_)
        while (block.text.size() < kBlock && !has_ended_)
          if (const auto line = source_.next())
            block.add(*line, source_.line());
          else
            has_ended_ = true;
    } catch (const Error&) {
      failure_ = std::current_exception();
      has_ended_ = true;
    }
  }

  Lines& source_;
  const CsvDialect& dialect_;
  std::vector<Block> blocks_, next_;
  bool has_ended_ = false;
  std::exception_ptr failure_;
};

/// Lines of which those that a quoted line end has divided are one again.
class WholeLines final : public Lines {
 public:
  explicit WholeLines(Lines& source) : source_(source) {}

  std::optional<std::string_view> next() override {
    if (!apart_.empty()) return give_apart();
    const auto line = source_.next();
    line_ = source_.line();
    if (!line || line->find('"') == std::string_view::npos || !leaves_quote_open(*line))
      return line;

    // Take lines up to the one that closes the quote. A quote that none closes is a sign of inches,
    // say, and a line that begins with a number is a row: then all stay as they are.
    current_ = *line;
    std::string whole = current_;
    while (apart_.size() < kMostLines) {
      const auto more = source_.next();
      if (!more) break;
      apart_.emplace_back(source_.line(), *more);
      const std::string_view begin = trim(*more);
      if (!begin.empty() && parse_number(begin.substr(0, 1))) break;
      whole.append(" ").append(*more);
      if (leaves_quote_open(whole)) continue;
      line_ = source_.line();
      apart_.clear();
      current_ = std::move(whole);
      break;
    }
    return current_;
  }
  std::size_t line() const override { return line_; }
  double expected_lines() const override { return source_.expected_lines(); }

 private:
  static constexpr std::size_t kMostLines = 8;

  std::string_view give_apart() {
    line_ = apart_.front().first;
    current_ = std::move(apart_.front().second);
    apart_.pop_front();
    return current_;
  }

  Lines& source_;
  std::string current_;
  std::deque<std::pair<std::size_t, std::string>> apart_;  ///< read, and not given yet
  std::size_t line_ = 0;
};

/// Room for the rest of the file at once, so that growing does not hold every column twice.
void reserve_rows(RawTable& table, const Lines& source) {
  const double rows = source.expected_lines();
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

/// A comma that separates columns and stands within numbers as well moves the later columns: the
/// lines then hold more numbers than there are names.
void refuse_moved_columns(const RawTable& table, const CsvDialect& dialect) {
  const RawColumn& last = table.columns.back();
  if (dialect.separator != ',' || !table.named() || !last.name.empty() || last.values.empty())
    return;
  const auto nameless = std::ranges::find_if(table.columns.rbegin(), table.columns.rend(),
                                             [](const auto& c) { return !c.name.empty(); }) -
                        table.columns.rbegin();
  throw Error(table.at_line(table.lines.empty() ? 1 : table.lines[0].second),
              "its lines hold " + std::to_string(table.columns.size()) +
                  " numbers, and there are names for " +
                  (nameless == 1 ? "one" : std::to_string(nameless)) +
                  " fewer: a comma within the numbers?",
              "separate the columns by semicolons or tabs, or quote numbers like \"1,093.60\"");
}

/// Whether a cell is two numbers without a blank between, as where columns of fixed width touch:
/// "0.06100.66", "12.5-243.4". A date, 29.11.2026, is none.
bool is_two_numbers(std::string_view cell) {
  const std::size_t first = cell.find('.'), last = cell.rfind('.');
  if (first == last || cell.find_first_not_of("+-.0123456789") != std::string_view::npos)
    return false;
  constexpr std::size_t kLongestMonth = 2;
  const std::string_view between = cell.substr(first + 1, last - first - 1);
  return between.find('.') == std::string_view::npos && between.size() > kLongestMonth;
}

/// Throws Error where blanks separate the columns and two of them touch.
void refuse_touching(std::string_view line, const CsvDialect& dialect, const std::string& where) {
  if (dialect.separator != ' ' || is_comment(line)) return;
  std::vector<std::string_view> cells;
  split_cells(line, dialect.separator, cells);
  for (const std::string_view cell : cells)
    if (is_two_numbers(cell))
      throw Error(where, "'" + std::string(cell) + "' is two numbers: its columns touch",
                  "columns that blanks, tabs or semicolons separate in every line");
}

}  // namespace

bool is_csv(const fs::path&, std::string_view extension, std::string_view head) {
  constexpr std::string_view kExtensions[] = {".csv", ".txt", ".tsv", ".dat", ".asc", ".log", ""};
  const bool text =
      head.find('\0') == std::string_view::npos || encoding_of(head) != TextEncoding::Bytes;
  return text && std::find(std::begin(kExtensions), std::end(kExtensions), extension) !=
                     std::end(kExtensions);
}

std::vector<RawTable> read_csv(const fs::path& path) {
  LineSource source(path);
  WholeLines lines(source);
  RawTable table;
  table.file = path.string();
  read_lines(lines, {}, table);
  std::vector<RawTable> tables;
  tables.push_back(std::move(table));
  return tables;
}

void read_lines(Lines& source, std::optional<char> separator, RawTable& table) {
  // Understand the dialect from the first lines.
  std::vector<std::string> head;
  std::vector<std::size_t> numbers;
  while (head.size() < kSniffedLines) {
    const auto line = source.next();
    if (!line) break;
    head.emplace_back(*line);
    numbers.push_back(source.line());
  }
  const CsvDialect dialect = sniff_dialect(head, table.place(), separator);
  for (std::size_t k = dialect.first_data_line; k < head.size(); ++k)
    refuse_touching(head[k], dialect, table.at_line(numbers[k]));

  // Then all lines: those already read, and the rest of the file.
  add_empty_columns(table, dialect);
  reserve_rows(table, source);
  RowAppender appender(table, dialect);
  BlockReader blocks(source, dialect);
  for (std::size_t k = dialect.first_data_line; k < head.size(); ++k)
    blocks.add(head[k], numbers[k]);
  blocks.append_all(appender);
  appender.settle_clocks();
  appender.settle_groups();
  appender.note_beside();
  appender.note_headings();

  drop_empty_columns(table);
  refuse_moved_columns(table, dialect);
  if (dialect.counts_rows)
    table.notes.push_back(
        "there is one name fewer than columns: the first, which counts the rows, has none");
  if (!dialect.thousands_mark.empty())
    table.notes.push_back("numbers are read with '" + dialect.thousands_mark +
                          "' between thousands");
  if (dialect.thousands)
    table.notes.push_back(std::string("numbers are read with '") + dialect.thousands +
                          "' between thousands and '" + dialect.decimal + "' as decimal sign");
}

TextTable read_text_table(const fs::path& path) {
  LineSource source(path);
  WholeLines lines(source);
  TextTable table;
  std::vector<std::string_view> cells;
  char separator = ',';
  while (const auto line = lines.next()) {
    if (is_comment(*line)) continue;

    // The first line names the columns and decides on the separator: the one that it has most of.
    if (table.names.empty())
      for (const char candidate : {',', ';', '\t'})
        if (std::ranges::count(*line, candidate) > std::ranges::count(*line, separator))
          separator = candidate;
    split_cells(*line, separator, cells);
    if (table.names.empty()) {
      for (const std::string_view cell : cells) table.names.push_back(text_of_cell(cell));
      continue;
    }

    if (cells.size() < table.names.size())
      throw Error(path.string() + ":" + std::to_string(lines.line()),
                  "has " + std::to_string(cells.size()) + " cells, the first line names " +
                      std::to_string(table.names.size()));
    std::vector<std::string>& row = table.rows.emplace_back();
    for (const std::string_view cell : cells) row.push_back(text_of_cell(cell));
    table.lines.push_back(lines.line());

    // A decimal comma, where no comma separates: one number that can be read no other way tells.
    if (separator != ',' && std::ranges::any_of(cells, [](std::string_view cell) {
          return !parse_number(cell) && parse_number(cell, ',');
        }))
      table.decimal = ',';
  }
  return table;
}

}  // namespace dashpot
