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

}  // namespace

bool is_family_json(const fs::path& path, std::string_view extension, std::string_view head) {
  const std::size_t start = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  std::error_code ignored;
  return extension == ".json" && start != std::string_view::npos && head[start] == '{' &&
         fs::exists(inputs_of(path), ignored);
}

std::vector<RawTable> read_family_json(const fs::path& path) {
  const std::string file = path.string(), inputs_file = inputs_of(path).string();
  const Value records = parse_json(read_file(path), file);
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
