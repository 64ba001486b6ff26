#include "stated_plant_section.h"

#include <string>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/machine/in_plant_words.h"

namespace dashpot::cli {
namespace {

/// A value of the plant's file in a line.
std::string words_of(const Value& value) {
  if (value.kind() == Value::Kind::Number) return format_number(value.as_number(), 5);
  if (value.kind() != Value::Kind::Object) return value.as_string();
  std::vector<std::string> parts;
  for (const auto& [key, part] : value.members()) parts.push_back(key + ' ' + words_of(part));
  return join(parts, ", ");
}

DocumentTable numbers_table(const InPlantSetup& setup) {
  DocumentTable table{.title = "Its numbers",
                      .columns = {{"parameter"}, {"stated", true}, {"unit"}, {"meaning", false, 1}},
                      .rows = {}};
  const auto& rows = setup.model->parameters;
  const auto add = [&](const std::string& name, const std::string& stated) {
    const ParameterRow& row = rows[row_named(rows, name, setup.model->name, "plant")];
    table.rows.push_back({name, stated, std::string(row.unit), std::string(row.meaning)});
  };
  for (const auto& [name, value] : setup.known) add(name, format_number(value, 5));
  for (const PlantUnknown& unknown : setup.unknown)
    add(unknown.name, "unknown, " + format_number(unknown.lower, 5) + " ... " +
                          format_number(unknown.upper, 5) +
                          (unknown.about ? ", about " + format_number(*unknown.about, 5) : ""));
  return table;
}

/// Inputs, sensors and drives as the file has them, without what two columns say already.
DocumentTable channels_table(const InPlantSetup& setup) {
  DocumentTable table{.title = "Its channels",
                      .columns = {{"channel"}, {"is"}, {"at"}, {"and", false, 1}},
                      .rows = {},
                      .note = "All numbers are in SI."};
  const Value file = to_json(setup);

  // A row of each: what has no column of its own stands in the last.
  const auto add = [&](const Value& one, const char* what) {
    std::vector<std::string> row = {"none", "", "", ""}, more;
    for (const auto& [key, value] : one.members())
      if (key == "channel")
        row[0] = words_of(value);
      else if (key == what)
        row[1] = words_of(value);
      else if (key == "at")
        row[2] = words_of(value);
      else
        more.push_back(key + ' ' + words_of(value));
    row[3] = join(more, "; ");
    table.rows.push_back(std::move(row));
  };
  for (const Value& input : file.find("inputs")->items()) add(input, "kind");
  for (const Value& sensor : file.find("sensors")->items()) add(sensor, "quantity");

  // What drives the dampers: one for all, or each its own.
  for (const char* key : {"current", "voltage"}) {
    const Value* drive = file.find(key);
    if (!drive) continue;
    if (drive->kind() != Value::Kind::Object)
      table.rows.push_back({words_of(*drive), key, "every damper", ""});
    else
      for (const auto& [strut, one] : drive->members())
        table.rows.push_back({words_of(one), key, strut, ""});
  }
  return table;
}

}  // namespace

DocumentSection stated_plant_section(const InPlantSetup& setup) {
  DocumentSection section{.name = "stated",
                          .title = "As the plant was stated",
                          .paragraphs = {},
                          .audience = Audience::Files};
  section.tables = {numbers_table(setup), channels_table(setup)};
  return section;
}

}  // namespace dashpot::cli
