#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/record/readers/line_source.h"
#include "dashpot/record/readers/packed_parts.h"

namespace dashpot {

/// What the cells of all sheets of a workbook refer to.
struct WorkbookWords {
  std::vector<std::string> strings;  ///< shared ones
  /// By the style of a cell: whether its number is shown as a date, a time of day or both.
  std::vector<bool> is_clock;
  bool from_1904 = false;  ///< days are counted from 1904-01-01, not from 1899-12-30
};

/// The shared strings of a workbook, each cut to what a name or a cell of a table can need. Throws
/// Error(place, ...) on damage and on more than any recording has.
std::vector<std::string> read_shared_strings(PackedPart part, const std::string& place);

/// The rows of a sheet of an XLSX workbook as lines of cells between tabs, unpacked block by block:
/// memory does not grow with the sheet. Numbers stand as the sheet has them, with a point; texts
/// and errors (#N/A) in quotes; dates and times of day as "2026-11-23T10:05:07.25" and
/// "10:05:07.25"; a formula of which no value was kept as a text that says so. The lines have the
/// numbers of the rows; empty ones are left out. Throws Error(place, ...) on damage and on a sheet
/// with more columns or rows than a recording has.
class SheetLines final : public Lines {
 public:
  /// `words` must outlive it.
  SheetLines(PackedPart part, std::string place, const WorkbookWords& words);
  ~SheetLines() override;

  std::optional<std::string_view> next() override;
  std::size_t line() const override { return current_.first; }
  double expected_lines() const override;

 private:
  struct Parser;

  PackedPart part_;
  std::unique_ptr<Parser> parser_;
  std::vector<char> block_;
  std::size_t bytes_ = 0, given_ = 0;
  std::pair<std::size_t, std::string> current_;
};

}  // namespace dashpot
