#include "dashpot/record/statement_text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::string_view kRow = "(row)";  // the column of a time that is counted

/// The records that came from a file, in their order.
std::vector<const Record*> records_of(const Dataset& dataset, const std::string& file) {
  std::vector<const Record*> records;
  for (const Record& record : dataset.records)
    if (record.source == file || record.source.starts_with(file + ",")) records.push_back(&record);
  return records;
}

/// The name of a column, or its number where the file has no names.
std::string column_name(const std::string& column) {
  constexpr std::string_view kUnnamed = "column ";
  const std::string number =
      column.starts_with(kUnnamed) ? column.substr(kUnnamed.size()) : std::string();
  const bool is_number =
      !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? number : yaml_string(column);
}

/// "{column: "x", unit: mm, sign: -1}": what makes SI of a column.
std::string column_text(const ColumnReading& reading, const std::vector<const Record*>& records) {
  std::string text = "{column: " + column_name(reading.column);
  const Unit unit = parse_unit(reading.unit).value_or(Unit{});
  if (!reading.unit.empty()) text += ", unit: " + yaml_string(reading.unit);
  const double scale = std::abs(reading.factor) / unit.factor;
  const double offset = reading.raw_offset + unit.offset / reading.factor;
  if (scale != 1) text += ", scale: " + format_exact(scale);
  if (offset != 0) text += ", offset: " + format_exact(offset);

  // A sign that was found, once stated, is not looked for again.
  const Channel* const channel = records.empty() ? nullptr : records[0]->find(reading.channel);
  if (channel && channel->origin.find("sign flipped") != std::string::npos)
    text += ", sign: -1";
  else if (reading.channel == "force")
    text += ", sign: 1";
  if (reading.basis.find("mean of the record subtracted") != std::string::npos)
    text += ", centre: mean";
  return text + "}";
}

std::string time_text(const ColumnReading& reading, const std::vector<const Record*>& records) {
  if (reading.column == kRow)
    return records.empty() || records.front()->sample_time <= 0
               ? ""
               : "    time: {sample_time: " + format_exact(records.front()->sample_time) + "}\n";
  return "    time: {column: " + column_name(reading.column) +
         (reading.unit.empty() ? "" : ", unit: " + yaml_string(reading.unit)) + "}\n";
}

/// The constant drive of each record, where no column tells it.
std::string level_text(const std::vector<const Record*>& records) {
  std::vector<std::string> levels;
  for (const Record* record : records)
    if (record->drive_level) levels.push_back(format_exact(*record->drive_level));
  if (levels.size() != records.size() || levels.empty()) return "";
  const bool alike = std::ranges::count(levels, levels.front()) == std::ssize(levels);
  return "    level: " + (alike ? levels.front() : "[" + join(levels, ", ") + "]") + "\n";
}

/// The names of a file's records as a template, "15 mm 1 Hz, {level} A", where they are others than
/// the file gives by itself. `drive_unit`: of the level of each that the entry states; empty: none.
std::string name_text(const std::vector<const Record*>& records, const std::string& file,
                      const std::string& drive_unit) {
  if (records.empty() || fs::path(file).filename().string().starts_with(records[0]->name))
    return "";
  std::set<std::string> templates;
  for (const Record* record : records) {
    std::string name = record->name;
    if (name.find_first_of("{}") != std::string::npos) return "";

    // Behind the motion stands the level with its unit, so that no frequency is taken for it; names
    // that differ in it alone share an entry.
    if (!drive_unit.empty()) {
      const std::string number = format_number(*record->drive_level);
      const std::size_t at = name.rfind(' ' + number + ' ' + drive_unit);
      if (at != std::string::npos) name.replace(at + 1, number.size(), "{level}");
    }
    templates.insert(name);
  }
  if (templates.size() > 1) return "";
  return "    name: " + yaml_string(*templates.begin()) + "\n";
}

/// What the records of a file have in common.
std::string condition_text(const std::vector<const Record*>& records) {
  const auto alike = [&](auto of) {
    return std::ranges::all_of(records,
                               [&](const Record* r) { return of(*r) == of(*records.front()); });
  };
  if (records.empty()) return "";
  std::string text;
  if (alike([](const Record& r) { return r.condition; }) && !records.front()->condition.empty())
    text += "    condition: " + yaml_string(records.front()->condition) + "\n";
  if (alike([](const Record& r) { return r.conditions; }) && !records.front()->conditions.empty()) {
    std::vector<std::string> numbers;
    for (const auto& [name, value] : records.front()->conditions)
      numbers.push_back(yaml_string(name) + ": " + format_exact(value));
    text += "    conditions: {" + join(numbers, ", ") + "}  # SI\n";
  }
  return text;
}

/// All of an entry behind its files.
std::string entry_text(const Dataset& dataset, const std::string& file) {
  const std::vector<const Record*> records = records_of(dataset, file);

  // Its columns: channels, the time base, and those that are of no use.
  std::string channels, time, unused;
  std::set<std::string> told;  // each test of a file has readings of its own, all alike
  bool has_drive = false;
  for (const ColumnReading& reading : dataset.readings) {
    if (reading.file != file || !told.insert(reading.column + '\n' + reading.channel).second)
      continue;
    if (reading.channel.empty()) {
      unused += "      # not used: " + yaml_comment(reading.column + ", " + reading.basis) + "\n";
    } else if (reading.channel == "time") {
      time = time_text(reading, records);
    } else {
      channels +=
          "      " + yaml_string(reading.channel) + ": " + column_text(reading, records) + "\n";
      has_drive = has_drive || reading.channel == "current" || reading.channel == "voltage";
    }
  }

  // What no column says: the level of the drive where there is one.
  const bool driven = dataset.drive_unit != DriveUnit::None;
  const std::string level = has_drive || !driven ? "" : level_text(records);
  return "    channels:\n" + channels + unused + time + level +
         name_text(records, file, level.empty() ? "" : name_of(dataset.drive_unit)) +
         condition_text(records);
}

/// A pattern that matches this file of the folder: what would be a pattern in its name may be any
/// one character.
std::string pattern_of(const fs::path& file, const fs::path& folder) {
  const fs::path below = file.lexically_relative(folder);
  std::string name = (below.empty() || *below.begin() == ".." ? file : below).string();
  for (char& c : name)
    if (c == '*' || c == '[' || c == ']') c = '?';
  return yaml_string(name);
}

/// A folder from the root of the file system; "" is the one that Dashpot runs in.
fs::path whole(const fs::path& folder) {
  return fs::absolute(folder.empty() ? "." : folder).lexically_normal();
}

}  // namespace

std::string file_statement_text(const Dataset& dataset, const std::string& file) {
  return entry_text(dataset, file);
}

std::string statement_text(const Dataset& dataset, const fs::path& folder, const fs::path& beside) {
  // The files that gave records, those with equal entries together.
  std::vector<std::pair<std::string, std::vector<std::string>>> entries;
  for (const SourceFile& file : dataset.files) {
    if (records_of(dataset, file.path).empty()) continue;
    const std::string text = entry_text(dataset, file.path);
    const auto same =
        std::ranges::find(entries, text, [](const auto& entry) { return entry.first; });
    if (same == entries.end())
      entries.push_back({text, {pattern_of(file.path, folder)}});
    else
      same->second.push_back(pattern_of(file.path, folder));
  }

  std::string out =
      "# What Dashpot understood of these recordings. Correct it, and read them by it:\n"
      "#   dashpot inspect THIS-FILE\n"
      "name: " +
      yaml_string(dataset.name) + "\n";
  if (!dataset.citation.empty()) out += "citation: " + yaml_string(dataset.citation) + "\n";
  const fs::path root = whole(folder).lexically_relative(whole(beside));
  out += "root: " + yaml_string(root.empty() ? "." : root.string()) + "\n";
  out += "drive: " + name_of(dataset.drive_unit) + "\n";
  if (dataset.leave_out)
    out += "leave_out: " + yaml_string(format_leave_out(*dataset.leave_out)) + "\n";
  out += "files:\n";
  for (const auto& [text, files] : entries)
    out += "  - match: [" + join(files, ", ") + "]\n" + text;
  return out;
}

}  // namespace dashpot
