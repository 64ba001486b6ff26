#include "dashpot/record/readers/lvm.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv_dialect.h"
#include "dashpot/record/readers/line_source.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::string_view kLvmBegin = "LabVIEW Measurement", kLvmHeaderEnd = "***End_of_Header***";
constexpr std::string_view kLvmX = "X_Value", kLvmComment = "Comment";

using LvmCells = std::vector<std::string_view>;

/// The entries of a header by their keys, each with what stands behind it.
using LvmHeader = std::map<std::string, std::vector<std::string>, std::less<>>;

class LvmFile {
 public:
  explicit LvmFile(const fs::path& path) : file_(path.string()), source_(path) {
    // The separator stands behind the first words; its name, in the header itself.
    const auto first = source_.next();
    if (first && first->find('\t') == std::string_view::npos)
      separator_ = first->find(';') != std::string_view::npos ? ';' : ',';
    const LvmHeader header = read_header();
    if (first_of(header, "Decimal_Separator") == ",") decimal_ = ',';
    x_columns_ = first_of(header, "X_Columns");
  }

  std::vector<RawTable> read() {
    std::optional<std::string_view> line;
    while ((line = source_.next())) {
      if (trim(*line).empty()) continue;
      begin_segment(*line);
      read_rows();
    }
    std::erase_if(tables_, [](const RawTable& table) { return table.rows() == 0; });
    if (tables_.empty())
      throw Error(file_, "has headers but no samples", "copy it again from LabVIEW");
    for (std::size_t k = 0; k < tables_.size() && tables_.size() > 1; ++k) {
      tables_[k].part_index = k;
      tables_[k].part = "segment " + std::to_string(k + 1);
    }
    return std::move(tables_);
  }

 private:
  std::string here() const { return file_ + ":" + std::to_string(source_.line()); }

  static std::string first_of(const LvmHeader& header, std::string_view key) {
    const auto entry = header.find(key);
    return entry == header.end() || entry->second.empty() ? "" : entry->second.front();
  }

  void add(LvmHeader& header, std::string_view line) {
    split_cells(line, separator_, cells_);
    header[std::string(cells_.front())] = {cells_.begin() + 1, cells_.end()};
  }

  /// The lines up to the end of a header, and `begun` before them.
  LvmHeader read_header(std::string_view begun = {}) {
    LvmHeader header;
    if (!begun.empty()) add(header, begun);
    while (const auto line = source_.next()) {
      if (trim(*line).starts_with(kLvmHeaderEnd)) return header;
      if (!trim(*line).empty()) add(header, *line);
    }
    throw Error(here(), "ends inside a header", "copy it again from LabVIEW");
  }

  /// What all channels of a segment have in common; nothing where no channel states it.
  std::optional<double> common(const LvmHeader& header, std::string_view key) const {
    const auto entry = header.find(key);
    if (entry == header.end()) return {};
    std::optional<double> shared;
    for (const std::string& cell : entry->second) {
      const auto value = parse_number(cell, decimal_);
      if (!value) continue;
      if (shared && *shared != *value)
        throw Error(here(), "the channels have " + std::string(key) + " of their own",
                    "one for all: resample them, or write files of their own");
      shared = value;
    }
    return shared;
  }

  /// Reads a segment's header, if it has one, and the names of its columns.
  void begin_segment(std::string_view line) {
    if (!trim(line).starts_with(kLvmX)) {
      header_ = read_header(line);
      const auto names = source_.next();
      if (!names || !trim(*names).starts_with(kLvmX))
        throw Error(here(), "a header is not followed by the names of the columns",
                    "a line that begins with " + std::string(kLvmX));
      line = *names;
    }
    split_cells(line, separator_, cells_);

    // The columns of the table: of several X the first, and the channels with their units.
    RawTable table;
    table.file = file_;
    taken_.clear();
    const bool is_time = lower(first_of(header_, "X_Dimension")) != "frequency";
    const auto step = common(header_, "Delta_X");
    common(header_, "X0");
    if (x_columns_ == "No")
      table.sample_time = is_time ? step : std::nullopt;
    else
      take(table, 0, is_time ? "time" : std::string(kLvmX), is_time ? "s" : "");
    const auto units = header_.find("Y_Unit_Label");
    bool names_channels = false;
    for (std::size_t k = 1; k < cells_.size(); ++k) {
      if (cells_[k] == kLvmX || cells_[k] == kLvmComment || cells_[k].empty()) continue;
      const bool has_unit = units != header_.end() && k <= units->second.size();
      take(table, k, text_of_cell(cells_[k]), has_unit ? text_of_cell(units->second[k - 1]) : "");
      names_channels = true;
    }
    if (!names_channels) throw Error(here(), "names no channel", "names behind X_Value");
    tables_.push_back(std::move(table));
  }

  void take(RawTable& table, std::size_t cell, const std::string& name, const std::string& unit) {
    table.columns.push_back({name, unit, {}, {}});
    taken_.push_back(cell);
  }

  /// The samples up to an empty line or the end; they continue the table before where they can.
  void read_rows() {
    RawTable segment = std::move(tables_.back());
    tables_.pop_back();
    LvmCells row;
    while (const auto line = source_.next()) {
      if (trim(*line).empty()) break;
      split_cells(*line, separator_, cells_);
      row.clear();
      for (const std::size_t k : taken_)
        row.push_back(k < cells_.size() ? cells_[k] : LvmCells::value_type());
      segment.append_row(row, source_.line(), decimal_);
    }
    if (!tables_.empty() && continues(tables_.back(), segment))
      join(tables_.back(), segment);
    else
      tables_.push_back(std::move(segment));
  }

  static bool continues(const RawTable& before, const RawTable& after) {
    constexpr double kMostSteps = 1.5;
    if (before.rows() < 2 || after.rows() == 0 || before.columns.size() != after.columns.size() ||
        before.sample_time || before.columns.front().name != "time")
      return false;
    for (std::size_t k = 0; k < before.columns.size(); ++k)
      if (before.columns[k].name != after.columns[k].name ||
          before.columns[k].unit != after.columns[k].unit)
        return false;
    const std::vector<double>& time = before.columns.front().values;
    const double step = time.back() - time[time.size() - 2];
    const double gap = after.columns.front().values.front() - time.back();
    return gap > 0 && gap <= kMostSteps * step;
  }

  static void join(RawTable& before, const RawTable& after) {
    const std::size_t rows = before.rows();
    for (const auto& [row, line] : after.lines) before.lines.emplace_back(rows + row, line);
    for (std::size_t k = 0; k < before.columns.size(); ++k) {
      RawColumn& column = before.columns[k];
      const RawColumn& more = after.columns[k];
      column.values.insert(column.values.end(), more.values.begin(), more.values.end());
      if (more.bad && !column.bad) column.bad = BadCell{rows + more.bad->row, more.bad->text};
    }
  }

  std::string file_;
  LineSource source_;
  char separator_ = '\t', decimal_ = '.';
  std::string x_columns_;
  LvmHeader header_;  // of the segment
  LvmCells cells_;
  std::vector<std::size_t> taken_;  // the cells of a line that are columns
  std::vector<RawTable> tables_;
};

}  // namespace

bool is_lvm(const fs::path&, std::string_view, std::string_view head) {
  return head.starts_with(kLvmBegin);
}

std::vector<RawTable> read_lvm(const fs::path& path) { return LvmFile(path).read(); }

}  // namespace dashpot
