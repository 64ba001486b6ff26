#include "dashpot/record/readers/daq_text.h"

#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv_dialect.h"
#include "dashpot/record/readers/line_source.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::string_view kFirstKey = "Header Size:";

struct Header {
  double sample_time = 0;  // s
  double sample_count = 0;
  std::vector<std::string> names;  // without the events column
};

/// Reads the header, which ends with the names of the columns.
Header read_header(LineSource& source, const std::string& file) {
  Header header;
  double lines = 0;
  std::vector<std::string_view> cells;
  do {
    const auto line = source.next();
    if (!line) throw Error(file, "ends inside its header", "copy it again from the data logger");

    // The first line without a colon names the columns.
    const std::size_t colon = line->find(':');
    if (colon == std::string_view::npos) {
      split_cells(*line, ',', cells);
      header.names.assign(cells.begin(), cells.end());
      break;
    }

    const std::string_view key = trim(line->substr(0, colon));
    const double value = parse_number(line->substr(colon + 1)).value_or(0);
    if (key == "Header Size") lines = value;
    if (key == "Sampling Interval") header.sample_time = value;
    if (key == "Sampling Rate" && header.sample_time <= 0 && value > 0)
      header.sample_time = 1 / value;
    if (key == "Sample Count") header.sample_count = value;
  } while (static_cast<double>(source.line()) < lines);

  // Refuse a header that does not end so, or that states no time base.
  const std::string where = file + ":" + std::to_string(source.line());
  if (header.names.size() < 2 || header.names.back() != "Events")
    throw Error(where, "the header does not end with the names of the columns",
                "its last line is like 'Sample Number, Date/Time, CHANNEL0, CHANNEL1, Events'");
  if (!(header.sample_time > 0) || !std::isfinite(header.sample_time))
    throw Error(where, "the header states no sampling interval",
                "a line 'Sampling Interval:  0.005' in s");

  header.names.pop_back();
  return header;
}

RawTable begin_part(const Header& header, const std::string& file, std::size_t index) {
  RawTable table;
  table.file = file;
  table.part_index = index;
  table.sample_time = header.sample_time;
  for (const std::string& name : header.names) table.columns.push_back({name, "", {}, {}});
  return table;
}

/// Names parts by number and rows, counted through the whole file from 1.
void name_parts(std::vector<RawTable>& parts) {
  std::size_t first = 1;
  for (RawTable& part : parts) {
    part.part = "part " + std::to_string(part.part_index + 1) + ", rows " + std::to_string(first) +
                "-" + std::to_string(first + part.rows() - 1);
    first += part.rows();
  }
}

}  // namespace

bool is_daq_text(const fs::path&, std::string_view, std::string_view head) {
  return head.substr(0, kFirstKey.size()) == kFirstKey;
}

std::vector<RawTable> read_daq_text(const fs::path& path) {
  const std::string file = path.string();
  LineSource source(path);
  const Header header = read_header(source, file);

  // A part starts with the first sample and wherever the logger resumed.
  std::vector<RawTable> parts;
  std::vector<std::string_view> cells;
  std::size_t rows = 0;
  while (const auto line = source.next()) {
    if (trim(*line).empty()) continue;
    split_cells(*line, ',', cells);
    const bool resumes = cells.size() > header.names.size() && lower(cells.back()) == "daq resume";
    if (parts.empty() || resumes) parts.push_back(begin_part(header, file, parts.size()));
    parts.back().append_row(cells, source.line());
    ++rows;
  }

  if (parts.empty())
    throw Error(file, "has a header but no samples", "copy it again from the data logger");

  name_parts(parts);
  if (header.sample_count > 0 && static_cast<double>(rows) != header.sample_count)
    parts.back().notes.push_back("the header promises " + format_number(header.sample_count, 9) +
                                 " samples, the file has " + std::to_string(rows) +
                                 ": it was cut off");
  return parts;
}

}  // namespace dashpot
