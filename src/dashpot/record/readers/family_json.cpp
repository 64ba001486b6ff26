#include "dashpot/record/readers/family_json.h"

#include <cmath>

#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

struct Field {
  std::string_view key, name, unit;
};
constexpr Field kColumns[] = {{"time", "time", "s"},
                              {"displace", "displacement", "mm"},
                              {"velocity", "velocity", "mm/s"},
                              {"force", "force", "N"}};
constexpr Field kConditions[] = {{"viscocidad", "viscosity", "Pa*s"},
                                 {"Ap", "piston_area", "m^2"},
                                 {"Ag", "gap_area", "m^2"},
                                 {"h", "gap", "m"},
                                 {"L", "pole_length", "m"}};

constexpr std::string_view kDampers = "dampers";
constexpr Field kEnglishColumns[] = {{"time", "time", "s"},
                                     {"displacement", "displacement", "m"},
                                     {"velocity", "velocity", "m/s"},
                                     {"force", "force", "N"}};
constexpr std::string_view kEnglishConditions[] = {"piston_area", "gap_area",  "gap",
                                                   "pole_length", "viscosity", "spring_stiffness",
                                                   "temperature"};

fs::path inputs_of(const fs::path& path) {
  return path.parent_path() / ("inp_" + path.filename().string());
}

/// One field level of one damper. Throws Error when the columns are not equally long.
RawTable read_record(const Value& value, const std::string& file) {
  RawTable table;
  table.file = file;
  ObjectReader reader(value, "a record of the family data");

  for (const Field& field : kColumns) {
    RawColumn column{std::string(field.key),
                     std::string(field.unit),
                     reader.required(field.key).as_numbers(),
                     {}};
    for (std::size_t k = 0; k < column.values.size() && !column.bad; ++k)
      if (!std::isfinite(column.values[k])) column.bad = BadCell{k, "not a finite number"};

    if (!table.columns.empty() && column.values.size() != table.rows())
      throw Error(value.where(), "'" + std::string(field.key) + "' has " +
                                     std::to_string(column.values.size()) + " values, 'time' has " +
                                     std::to_string(table.rows()));
    table.columns.push_back(std::move(column));
  }
  reader.finish();
  return table;
}

/// The damper's constants, and the yield stress at each field level.
void add_conditions(std::vector<RawTable>& levels, const Value& value) {
  ObjectReader reader(value, "a damper of the family data");
  const std::vector<double> yield = reader.required("Ty").as_numbers();
  if (yield.size() < levels.size())
    throw Error(value.where(), "'Ty' has " + std::to_string(yield.size()) +
                                   " field levels, the recordings have " +
                                   std::to_string(levels.size()));
  for (std::size_t k = 0; k < levels.size(); ++k)
    levels[k].conditions.emplace_back("yield_stress", yield[k]);
  for (const Field& field : kConditions) {
    const double number = reader.number(field.key);
    for (RawTable& level : levels) level.conditions.emplace_back(field.name, number);
  }
  reader.finish();
}

/// A column of this many numbers, or of one that stands for all of them.
RawColumn read_english_column(const Value& value, const Field& field, std::size_t rows) {
  RawColumn column{std::string(field.name), std::string(field.unit), {}, {}};
  if (value.kind() == Value::Kind::Number)
    column.values.assign(rows, value.as_number());
  else
    column.values = value.as_numbers();
  for (std::size_t k = 0; k < column.values.size() && !column.bad; ++k)
    if (!std::isfinite(column.values[k])) column.bad = BadCell{k, "not a finite number"};
  if (column.values.size() != rows)
    throw Error(value.where(), "'" + std::string(field.key) + "' has " +
                                   std::to_string(column.values.size()) + " values, 'time' has " +
                                   std::to_string(rows));
  return column;
}

RawTable read_english_level(const Value& value, const std::string& file) {
  RawTable table;
  table.file = file;
  ObjectReader reader(value, "a level of a damper");
  const std::size_t rows = reader.required("time").as_numbers().size();
  for (const Field& field : kEnglishColumns)
    if (const Value* column = reader.optional(field.key))
      table.columns.push_back(read_english_column(*column, field, rows));
  table.columns.push_back(
      read_english_column(reader.required("current"), {"current", "current", "A"}, rows));
  if (const Value* stress = reader.optional("yield_stress"))
    table.conditions.emplace_back("yield_stress", stress->as_number());
  reader.finish();
  return table;
}

/// The documented layout: dampers with their numbers, each with its levels.
std::vector<RawTable> read_english(const Value& document, const std::string& file) {
  ObjectReader all(document, "a file of a family");
  std::vector<RawTable> tables;
  for (const Value& value : all.required(kDampers).items()) {
    ObjectReader reader(value, "a damper of a family");
    const std::string name = reader.string("name");
    std::vector<std::pair<std::string, double>> conditions;
    for (const std::string_view condition : kEnglishConditions)
      if (reader.optional(condition)) conditions.emplace_back(condition, reader.number(condition));
    std::size_t level = 0;
    for (const Value& item : reader.required("levels").items()) {
      RawTable table = read_english_level(item, file);
      table.conditions.insert(table.conditions.end(), conditions.begin(), conditions.end());
      table.group = name;
      table.part_index = level++;
      table.part = name + ", level " + std::to_string(level);
      tables.push_back(std::move(table));
    }
    reader.finish();
  }
  all.finish();
  return tables;
}

}  // namespace

bool is_family_json(const fs::path& path, std::string_view extension, std::string_view head) {
  const std::size_t start = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  std::error_code ignored;
  if (extension == ".json" && start != std::string_view::npos && head[start] == '{') {
    const std::size_t key = head.find_first_not_of(" \t\r\n", start + 1);
    if (key != std::string_view::npos && head.substr(key).starts_with("\"dampers\"")) return true;
  }
  return extension == ".json" && start != std::string_view::npos && head[start] == '{' &&
         fs::exists(inputs_of(path), ignored);
}

std::vector<RawTable> read_family_json(const fs::path& path) {
  const std::string file = path.string(), inputs_file = inputs_of(path).string();
  const Value records = parse_json(read_file(path), file);
  if (records.kind() == Value::Kind::Object && records.find(kDampers) &&
      records.find(kDampers)->kind() == Value::Kind::Array)
    return read_english(records, file);
  const Value inputs = parse_json(read_file(inputs_file), inputs_file);

  std::vector<RawTable> tables;
  for (const auto& [key, levels_value] : records.members()) {
    // The recordings of one damper, one per field level.
    std::vector<RawTable> levels;
    for (const Value& value : levels_value.items()) {
      RawTable table = read_record(value, file);
      table.group = key;
      table.part_index = levels.size();
      table.part = key + ", field level " + std::to_string(levels.size());
      levels.push_back(std::move(table));
    }

    // Its description, from the file beside.
    const Value* damper = inputs.find(key);
    if (!damper)
      throw Error(inputs_file, "has no damper '" + key + "'", "one entry per damper of " + file);
    add_conditions(levels, *damper);
    for (RawTable& level : levels) tables.push_back(std::move(level));
  }
  return tables;
}

}  // namespace dashpot
