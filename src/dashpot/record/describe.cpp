#include "dashpot/record/describe.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "dashpot/base/text.h"
#include "dashpot/record/doubts.h"

namespace dashpot {
namespace {

using Row = std::vector<std::string>;

/// Characters of a UTF-8 text, for alignment.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::size_t> widths_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  return widths;
}

std::string align(const std::vector<Row>& rows) {
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string out;
  for (const Row& row : rows) {
    std::string line = " ";
    for (std::size_t k = 0; k < row.size(); ++k)
      line.append(" ").append(row[k]).append(widths[k] - width(row[k]) + 1, ' ');
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

/// A table that is too wide for a screen goes on in another below it, with its first column again.
std::string align_in_parts(const std::vector<Row>& rows) {
  constexpr std::size_t kScreen = 79, kGap = 2;
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string out;
  for (std::size_t first = 1; first < widths.size();) {
    // As many columns as have room, at least one.
    std::size_t end = first, taken = kGap + widths[0];
    while (end < widths.size() && (end == first || taken + kGap + widths[end] <= kScreen))
      taken += kGap + widths[end++];

    std::vector<Row> part;
    for (const Row& row : rows) {
      part.push_back({row.front()});
      part.back().insert(part.back().end(), row.begin() + static_cast<std::ptrdiff_t>(first),
                         row.begin() + static_cast<std::ptrdiff_t>(end));
    }
    out += (out.empty() ? "" : "\n") + align(part);
    first = end;
  }
  return out;
}

std::string conversion(const ColumnReading& reading) {
  if (reading.channel.empty()) return {};
  std::string text = "x " + format_number(reading.factor, 6);
  if (reading.raw_offset == 0) return text;
  return "(raw - " + format_number(reading.raw_offset, 6) + ") " + text;
}

/// A column as a row of the table that tells how a file was understood.
Row reading_row(const ColumnReading& reading) {
  return {reading.column, reading.channel.empty() ? "-" : reading.channel, reading.unit,
          conversion(reading), reading.basis};
}

std::string range(const Record& record, std::string_view channel, double scale) {
  const Channel* found = record.find(channel);
  if (!found || found->samples.empty()) return "-";
  const auto [low, high] = std::minmax_element(found->samples.begin(), found->samples.end());
  return format_number(*low * scale) + "..." + format_number(*high * scale);
}

std::string fastest(const Record& record, double scale) {
  const Channel* velocity = record.find("velocity");
  if (!velocity) return "-";
  double most = 0;
  for (const double v : velocity->samples) most = std::max(most, std::abs(v));
  return format_number(scale * most, 3);
}

std::string drive(const Record& record, DriveUnit unit) {
  if (unit == DriveUnit::None) return "constant";
  if (record.drive_level) return format_number(*record.drive_level) + " " + to_string(unit);
  const std::string varying = range(record, drive_channel(unit), 1);
  return varying == "-" ? "unknown" : varying + " " + to_string(unit);
}

std::string role(const Record& record) {
  return record.role == Role::Training  ? "training"
         : record.role == Role::LeftOut ? "left out"
                                        : "";
}

std::string step(const Record& record) {
  return record.sample_time > 0 ? format_number(record.sample_time * 1e3, 5) : "varies";
}

std::string record_table(const Dataset& dataset, const PrintUnits& units) {
  const PrintUnit length = units.of("m"), speed = units.of("m/s"), force = units.of("N");
  std::vector<Row> rows{{"record", "condition", "drive", "samples", "step ms", "length s",
                         "displacement " + length.name, "speed " + speed.name,
                         "force " + force.name}};
  const bool has_roles = std::ranges::any_of(
      dataset.records, [](const Record& record) { return !role(record).empty(); });
  if (has_roles) rows.front().push_back("role");
  for (const Record& record : dataset.records) {
    rows.push_back({record.name, record.condition, drive(record, dataset.drive_unit),
                    std::to_string(record.size()), step(record),
                    format_number(record.time.back() - record.time.front()),
                    range(record, "displacement", length.factor), fastest(record, speed.factor),
                    range(record, "force", force.factor)});
    if (has_roles) rows.back().push_back(role(record));
  }
  return align_in_parts(rows);
}

/// A note without its numbers: notes of one pattern are shown once.
std::string pattern_of(const std::string& note) {
  std::string out;
  for (const char c : note)
    if (!(c >= '0' && c <= '9')) out += c;
  return out;
}

/// Notes of one pattern, and what they are about.
struct SharedNote {
  std::string pattern, text;
  std::vector<std::string> subjects;
  bool differs = false;   ///< in its numbers
  std::size_t count = 1;  ///< how many notes these are
};

void add_note(std::vector<SharedNote>& notes, const std::string& text, const std::string& subject) {
  const std::string pattern = pattern_of(text);
  const auto at = std::find_if(notes.begin(), notes.end(),
                               [&](const SharedNote& n) { return n.pattern == pattern; });
  if (at == notes.end()) return notes.push_back({pattern, text, {subject}, false});
  at->differs = at->differs || at->text != text;
  ++at->count;
  if (at->subjects.back() != subject) at->subjects.push_back(subject);
}

std::string format_note(const SharedNote& note, std::string_view plural) {
  std::string subject = note.subjects.front();
  if (note.subjects.size() > 1)
    subject = std::to_string(note.subjects.size()) + " " + std::string(plural) + " (" + subject +
              ", " + note.subjects[1] + (note.subjects.size() > 2 ? " ...)" : ")");
  const std::string others = note.subjects.size() > 1
                                 ? ", and likewise"
                                 : "; and " + std::to_string(note.count - 1) + " more like it";
  return (subject.empty() ? "" : subject + ": ") + note.text + (note.differs ? others : "");
}

std::string note_list(const Dataset& dataset) {
  std::vector<SharedNote> of_files, of_records;
  for (const std::string& note : dataset.notes)
    if (!note.starts_with(kSuspectNote)) of_files.push_back({note, note, {""}, false});
  for (const auto& [record, why] : dataset.suspects)
    of_records.push_back({why, std::string(kSuspectNote) + why, {record}, false});
  for (const auto& [file, why] : dataset.passed_over)
    add_note(of_files, "passed over: " + why, file);
  for (const Record& record : dataset.records) {
    for (const std::string& note : record.notes)
      if (std::ranges::none_of(
              dataset.notes, [&](const std::string& told) { return told.ends_with(": " + note); }))
        add_note(of_records, note, record.name);

    std::vector<std::string> conditions;
    for (const auto& [name, value] : record.conditions)
      conditions.push_back(name + " " + format_number(value));
    if (!conditions.empty()) add_note(of_records, "SI: " + join(conditions, ", "), record.name);
    for (const Channel& channel : record.channels)
      if (!channel.origin.starts_with("column "))
        add_note(of_records, channel.name + " " + channel.origin, record.name);
  }

  std::string out;
  for (const SharedNote& note : of_files) out += "  " + format_note(note, "files") + "\n";
  for (const SharedNote& note : of_records) out += "  " + format_note(note, "records") + "\n";
  return out.empty() ? out : "\nnotes\n" + out;
}

}  // namespace

std::string FilesAlike::heading() const {
  const std::string others = std::to_string(files.size() - 1);
  return files.front() + (files.size() > 1 ? " and " + others + " more like it" : "");
}

std::vector<FilesAlike> files_alike(const std::vector<ColumnReading>& readings) {
  std::vector<FilesAlike> groups, files;
  for (const ColumnReading& reading : readings) {
    const std::string name = std::filesystem::path(reading.file).filename().string();
    if (files.empty() || files.back().files.front() != name) files.push_back({{name}, {}});

    // The parts of one file are read alike.
    std::vector<ColumnReading>& columns = files.back().columns;
    if (std::ranges::find(columns, reading_row(reading), reading_row) == columns.end())
      columns.push_back(reading);
  }

  // Files that were understood alike become one group.
  for (FilesAlike& file : files) {
    const auto same = std::ranges::find_if(groups, [&](const FilesAlike& group) {
      return std::ranges::equal(group.columns, file.columns, {}, reading_row, reading_row);
    });
    if (same == groups.end()) {
      groups.push_back(std::move(file));
    } else {
      same->files.push_back(file.files.front());
    }
  }
  return groups;
}

std::string describe(const Dataset& dataset) { return describe(dataset, PrintUnits()); }

std::string describe(const Dataset& dataset, const PrintUnits& units) {
  std::string out = dataset.name + ": " + counted(dataset.records.size(), "record") + " from " +
                    counted(dataset.files.size(), "file") + "\n";
  if (!dataset.citation.empty()) out += "  cite: " + dataset.citation + "\n";

  for (const FilesAlike& group : files_alike(dataset.readings)) {
    std::vector<Row> rows{{"column", "channel", "unit", "to SI", "why"}};
    std::ranges::transform(group.columns, std::back_inserter(rows), reading_row);
    out.append("\n").append(group.heading()).append("\n").append(align(rows));
  }
  out.append("\n").append(record_table(dataset, units)).append(note_list(dataset));
  return out;
}

}  // namespace dashpot
