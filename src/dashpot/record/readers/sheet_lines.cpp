#include "dashpot/record/readers/sheet_lines.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/xml_part.h"

namespace dashpot {
namespace {

constexpr std::size_t kSheetColumns = 64;      // more is no recording
constexpr std::size_t kSheetRows = 1'048'576;  // of the format
constexpr std::size_t kCellBytes = 200;        // of a text that are kept
constexpr std::size_t kMostStrings = 1'000'000;
constexpr std::size_t kSheetBlock = std::size_t{1} << 16;

void append_cut(std::string& text, std::string_view more) {
  text.append(more.substr(0, kCellBytes - std::min(text.size(), kCellBytes)));
}

/// <sst><si><t>name</t></si><si><r><t>na</t></r><r><t>me</t></r></si>...
class SharedStrings final : public XmlPart {
 public:
  using XmlPart::XmlPart;
  std::vector<std::string> strings;

 protected:
  void on_begin(std::string_view name, const Attributes&) override {
    if (name == "si") strings.emplace_back();
    if (name == "rPh") in_phonetic_ = true;
    in_text_ = name == "t" && !in_phonetic_ && !strings.empty();
    if (strings.size() > kMostStrings)
      throw Error(place_, "holds more than a million texts", "save the table alone as CSV");
  }
  void on_end(std::string_view name) override {
    in_text_ = false;
    if (name == "rPh") in_phonetic_ = false;
  }
  void on_text(std::string_view text) override {
    if (in_text_) append_cut(strings.back(), text);
  }

 private:
  bool in_text_ = false, in_phonetic_ = false;
};

/// The column of a reference such as "BR17", from 0; nothing when it is none.
std::optional<std::size_t> column_of(std::string_view reference) {
  std::size_t column = 0, letters = 0;
  while (letters < reference.size() && letters < 3 && reference[letters] >= 'A' &&
         reference[letters] <= 'Z')
    column = 26 * column + static_cast<std::size_t>(reference[letters++] - 'A' + 1);
  if (letters == 0) return std::nullopt;
  return column - 1;
}

/// A text as a cell between tabs: in quotes, so that "#N/A" begins no comment.
std::string quoted(std::string text) {
  std::ranges::replace(text, '"', '\'');
  std::ranges::replace_if(text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return '"' + text + '"';
}

/// A number of days as the text of a date and time, or of a time of day where it is less than one.
std::string clock_text(double days, bool from_1904) {
  using namespace std::chrono;
  constexpr double kMostDays = 2'958'466;  // 10000-01-01
  if (!(days >= 0) || days >= kMostDays) return quoted("a date that is none");

  // To 10 microseconds: a double of 45 000 days holds one of them, and stamps are to be uniform.
  constexpr std::int64_t kPerSecond = 100'000, kPerDay = 86400 * kPerSecond;
  const auto since = static_cast<std::int64_t>(std::llround(days * double(kPerDay)));
  const std::int64_t day = since / kPerDay, rest = since % kPerDay, whole = rest / kPerSecond;
  const std::string time = fmt::format("{:02}:{:02}:{:02}.{:05}", whole / 3600, whole / 60 % 60,
                                       whole % 60, rest % kPerSecond);
  if (day == 0 && !from_1904) return time;

  // The count from 1900 has a 29th of February that was none, hence two beginnings.
  const sys_days zero =
      from_1904 ? sys_days{1904y / January / 1} : sys_days{1899y / December / (day < 60 ? 31 : 30)};
  const year_month_day date{zero + std::chrono::days(day)};
  return fmt::format("{:04}-{:02}-{:02}T{}", int(date.year()), unsigned(date.month()),
                     unsigned(date.day()), time);
}

}  // namespace

std::vector<std::string> read_shared_strings(PackedPart part, const std::string& place) {
  SharedStrings strings(place);
  std::string block(kSheetBlock, '\0');
  std::size_t got;
  do {
    got = part.read(block.data(), block.size());
    strings.take({block.data(), got});
  } while (got > 0);
  return std::move(strings.strings);
}

/// <row r="2"><c r="A2" s="1" t="s"><f>..</f><v>0</v></c><c t="inlineStr"><is><t>..</t></is></c>
struct SheetLines::Parser final : XmlPart {
  Parser(std::string place, const WorkbookWords& words)
      : XmlPart(std::move(place)), words_(words) {}

  std::deque<std::pair<std::size_t, std::string>> rows;  ///< number and text, not yet given

 protected:
  void on_begin(std::string_view name, const Attributes& attributes) override {
    if (name == "row") {
      begin_row(attributes["r"]);
    } else if (name == "c") {
      begin_cell(attributes);
    } else if (name == "v" || (name == "t" && !in_phonetic_)) {
      in_value_ = in_cell_;
    } else if (name == "f") {
      has_formula_ = true;
    } else if (name == "rPh") {
      in_phonetic_ = true;
    }
  }

  void on_end(std::string_view name) override {
    in_value_ = false;
    if (name == "rPh") in_phonetic_ = false;
    if (name == "c" && in_cell_) end_cell();
    if (name == "row" && !text_.empty()) rows.emplace_back(row_, std::move(text_)), text_.clear();
  }

  void on_text(std::string_view text) override {
    if (in_value_) append_cut(value_, text);
  }

 private:
  void begin_row(std::string_view number) {
    const auto stated = parse_number(number);
    row_ = stated && *stated >= 1 && *stated <= double(kSheetRows)
               ? static_cast<std::size_t>(*stated)
               : row_ + 1;
    if (++rows_read_ > kSheetRows)
      throw Error(place_, "holds more rows than a sheet can", "copy it again from its source");
    next_column_ = written_ = 0;
    text_.clear();
  }

  void begin_cell(const Attributes& attributes) {
    column_ = column_of(attributes["r"]).value_or(next_column_);
    next_column_ = column_ + 1;
    type_ = attributes["t"];
    const double style = parse_number(attributes["s"]).value_or(0);
    style_ = style >= 0 && style < 1e6 ? static_cast<std::size_t>(style) : 0;
    value_.clear();
    has_formula_ = false;
    in_cell_ = true;
  }

  void end_cell() {
    in_cell_ = false;
    const std::string cell = cell_text();
    if (cell.empty() || column_ < written_) return;
    if (column_ >= kSheetColumns)
      throw Error(place_ + ":" + std::to_string(row_),
                  "has a cell in column " + std::to_string(column_ + 1) + "; no more than " +
                      std::to_string(kSheetColumns) + " columns are read",
                  "delete what stands beside the table, or save a wide one as CSV, which may have "
                  "more columns");
    text_.append(column_ - written_, '\t');
    written_ = column_;
    text_ += cell;
  }

  /// The cell as it stands between tabs; "" when it is empty.
  std::string cell_text() {
    if (value_.empty()) return has_formula_ ? quoted("a formula without a kept value") : "";
    if (type_ == "s") return shared_string();
    if (type_ == "b") return value_ == "1" ? "1" : "0";
    if (type_ == "d") return quoted(value_);
    if (type_ == "inlineStr" || type_ == "str" || type_ == "e") return quoted(value_);
    const auto number = parse_number(value_);
    if (!number) return quoted(value_);
    const bool is_clock = style_ < words_.is_clock.size() && words_.is_clock[style_];
    return is_clock ? clock_text(*number, words_.from_1904) : value_;
  }

  std::string shared_string() const {
    const auto index = parse_number(value_);
    if (!index || !(*index >= 0) || *index >= double(words_.strings.size()))
      throw Error(place_ + ":" + std::to_string(row_), "refers to a text that is not there",
                  "the file is damaged: copy it again from its source");
    return quoted(words_.strings[static_cast<std::size_t>(*index)]);
  }

  const WorkbookWords& words_;
  std::size_t row_ = 0, rows_read_ = 0, column_ = 0, next_column_ = 0, style_ = 0;
  std::size_t written_ = 0;  ///< tabs in `text_`
  std::string text_, value_, type_;
  bool in_cell_ = false, in_value_ = false, in_phonetic_ = false, has_formula_ = false;
};

SheetLines::SheetLines(PackedPart part, std::string place, const WorkbookWords& words)
    : part_(std::move(part)),
      parser_(std::make_unique<Parser>(std::move(place), words)),
      block_(kSheetBlock) {}

SheetLines::~SheetLines() = default;

std::optional<std::string_view> SheetLines::next() {
  while (parser_->rows.empty()) {
    if (block_.empty()) return std::nullopt;
    const std::size_t got = part_.read(block_.data(), block_.size());
    parser_->take({block_.data(), got});
    bytes_ += got;
    if (got == 0) block_.clear();  // the end
  }
  current_ = std::move(parser_->rows.front());
  parser_->rows.pop_front();
  ++given_;
  return current_.second;
}

double SheetLines::expected_lines() const {
  const double read = static_cast<double>(std::max<std::size_t>(bytes_, 1));
  const auto rows = static_cast<double>(given_ + parser_->rows.size());
  return std::min(rows * static_cast<double>(part_.size()) / read, double(kSheetRows));
}

}  // namespace dashpot
