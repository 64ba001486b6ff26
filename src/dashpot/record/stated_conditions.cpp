#include "dashpot/record/stated_conditions.h"

#include <algorithm>
#include <optional>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/physics/damper_physics.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

struct ConditionUnit {
  std::string_view name, unit;
};
/// What columns may be by their names; a longer name before one that begins it.
constexpr ConditionUnit kConditionUnits[] = {{"gap_area", "m^2"},         {"gap", "m"},
                                             {"piston_area", "m^2"},      {"pole_length", "m"},
                                             {"spring_stiffness", "N/m"}, {"temperature", "K"},
                                             {"viscosity", "Pa*s"},       {"yield_stress", "Pa"}};
constexpr std::string_view kDrawings = "damper";
constexpr double kIceInKelvin = 273.15;
constexpr std::string_view kBuild = "specimen";  // which build of a drawing: a number

/// The unit that a title holds behind a name, as "gap [mm]", "gap (mm)" or "gap_mm".
std::string unit_behind(std::string_view title, std::string_view name) {
  std::string rest(title.substr(name.size()));
  std::erase_if(rest, [](char c) { return c == '[' || c == ']' || c == '(' || c == ')'; });
  rest = std::string(trim(rest));
  return rest.starts_with('_') ? std::string(trim(std::string_view(rest).substr(1))) : rest;
}

/// Null where it has none of that name.
const double* find_condition_of(const Record& record, std::string_view name) {
  const auto at =
      std::ranges::find(record.conditions, name, &std::pair<std::string, double>::first);
  return at == record.conditions.end() ? nullptr : &at->second;
}

}  // namespace

StatedConditions::StatedConditions(const Manifest& manifest, fs::path folder)
    : manifest_(&manifest), folder_(std::move(folder)) {
  for (const std::string& title : manifest.columns()) {
    if (title == kDrawings) {
      has_drawings_ = true;
      known_.insert(title);
    }
    if (title == kBuild) add_build_column();

    // A quantity, by the longest of the names that begin its title; its unit stands behind.
    for (const ConditionUnit& known : kConditionUnits) {
      if (!lower(title).starts_with(known.name)) continue;
      const std::string unit = unit_behind(title, known.name);
      const auto parsed = parse_unit(unit);
      if (unit.empty()) {
        known_.insert(title);
        notes_.push_back("the manifest's column '" + title +
                         "' has no unit and is not used: name it '" + title + " [" +
                         std::string(known.unit == "m" ? "mm" : known.unit) + "]'");
      } else if (parsed && parsed->dimension == parse_unit(known.unit)->dimension) {
        known_.insert(title);
        columns_.push_back({title, std::string(known.name), parsed->factor, parsed->offset});
        notes_.push_back("condition " + std::string(known.name) + " from the manifest's column '" +
                         title + "'");
      }
      break;
    }
  }
}

void StatedConditions::add_build_column() {
  const std::string title(kBuild);
  known_.insert(title);
  if (!manifest_->holds_numbers(title))
    return notes_.push_back(
        "the manifest's column '" + title +
        "' is not used: some of it are no numbers; number the builds 1, 2, ...");
  columns_.push_back({title, title, 1, 0});
  notes_.push_back("condition " + title + " from the manifest's column '" + title + "'");
}

void StatedConditions::add_column(Record& record, const SourcePath& file,
                                  const Column& column) const {
  if (find_condition_of(record, column.condition)) return;
  const double value = column.factor * manifest_->number(file, column.title) + column.offset;

  // What a drawing has too is held to its bounds.
  const auto fields = description_fields();
  const auto drawn = std::ranges::find(fields, column.condition, &DescriptionField::name);
  const bool is_known = std::ranges::find(kConditionUnits, column.condition,
                                          &ConditionUnit::name) != std::end(kConditionUnits);
  if (is_known && drawn != fields.end())
    require_within(value, *drawn,
                   manifest_->path() + ", column '" + column.title + "', " + file.relative);
  record.conditions.emplace_back(column.condition, value);
}

void StatedConditions::add_drawing(Record& record, const std::string& drawing,
                                   const fs::path& folder, const std::string& where) {
  // A drawing is read once; what is wrong with it is said with its own name and line.
  const bool is_file = drawing.ends_with(".yaml") || drawing.ends_with(".yml");
  const std::string path = is_file ? (folder / drawing).string() : drawing;
  auto at = drawings_.find(path);
  if (at == drawings_.end()) {
    const std::vector<std::string> known = description_names();
    if (!is_file && std::ranges::find(known, drawing) == known.end())
      throw Error(where, "'" + drawing + "' is no drawing",
                  "a file, NAME.yaml, or one of " + join(known, ", "));
    try {
      DamperDescription read = find_description(path);
      require_field(read, path);
      at = drawings_.emplace(path, std::move(read)).first;
    } catch (const Error& error) {
      throw Error(where, error.what());  // so that it ends the work, as any wrong statement
    }
  }
  DamperDescription damper = at->second;

  // Geometry and fluid as drawn, at the record's temperature; the yield stress at its own current.
  DamperPhysics physics = evaluate_physics(damper, {});
  if (const double* temperature = find_condition_of(record, "temperature");
      temperature && *temperature != damper.temperature) {
    const double drawn = physics.viscosity;
    require_within(*temperature, find_description_field("temperature", where), where);
    damper.temperature = *temperature;
    physics = evaluate_physics(damper, {});
    record.notes.push_back(physics.viscosity == drawn
                               ? "its temperature does not count: neither " + drawing +
                                     " nor its fluid " + damper.fluid->name +
                                     " says how the viscosity follows the temperature"
                               : "the viscosity of " + damper.fluid->name + " is that at " +
                                     format_number(*temperature - kIceInKelvin) +
                                     " degC; its yield stress follows no temperature");
  }
  std::vector<std::pair<std::string, double>> drawn{{"piston_area", physics.piston_area},
                                                    {"gap_area", physics.gap_area},
                                                    {"gap", damper.gap},
                                                    {"pole_length", damper.pole_length},
                                                    {"viscosity", physics.viscosity}};
  if (physics.spring_stiffness > 0)
    drawn.emplace_back("spring_stiffness", physics.spring_stiffness);
  if (record.find("voltage") && !record.find("current"))
    throw Error(where, record.name + " is driven by V; a drawing tells the yield stress over A",
                "recordings with the coil's current");
  if (record.drive_level)
    drawn.emplace_back("yield_stress", fluid_state(damper, *record.drive_level).yield_stress);
  else
    record.notes.push_back("the current is not constant: no yield stress follows from the drawing");
  for (const auto& [name, value] : drawn)
    if (!find_condition_of(record, name)) record.conditions.emplace_back(name, value);
  record.notes.push_back("damper as drawn in " + drawing);
}

void StatedConditions::add(Record& record, const SourcePath& file, const FileStatement& statement) {
  // Columns that the dataset file names.
  for (const ManifestCondition& stated : statement.manifest_conditions) {
    std::string text = stated.unit;
    for (const Column& column : columns_)
      if (text.empty() && column.title == stated.column) {
        add_column(record, file, {column.title, stated.name, column.factor, column.offset});
        text = "done";
      }
    if (text == "done") continue;
    const auto known = std::ranges::find(kConditionUnits, stated.name, &ConditionUnit::name);
    if (text.empty() && known != std::end(kConditionUnits))
      throw Error(stated.where, "the manifest's column '" + stated.column + "' has no unit",
                  "{manifest: " + stated.column +
                      ", unit: " + std::string(known->unit == "m" ? "mm" : known->unit) + "}");
    const Unit unit = text.empty() ? Unit{} : require_unit(text, stated.where);
    if (known != std::end(kConditionUnits) && unit.dimension != parse_unit(known->unit)->dimension)
      throw Error(stated.where, "unit '" + text + "' does not fit " + stated.name,
                  "a unit that converts to " + std::string(known->unit));
    add_column(record, file, {stated.column, stated.name, unit.factor, unit.offset});
  }

  // Columns that are conditions by their names.
  if (manifest_ && manifest_->lists(file))
    for (const Column& column : columns_) add_column(record, file, column);

  // The drawing, stated or in the manifest's column of that name.
  const DrawingStatement& drawing = statement.drawing;
  if (!drawing.file.empty()) return add_drawing(record, drawing.file, folder_, drawing.where);
  const std::string column = !drawing.column.empty() ? drawing.column
                             : has_drawings_         ? std::string(kDrawings)
                                                     : "";
  if (column.empty()) return;
  const auto cell = manifest_->cell(file, column);
  if (!cell && drawing.column.empty()) return;
  if (!cell)
    throw Error(manifest_->path(), "has no '" + column + "' for " + file.relative,
                "its columns are " + join(manifest_->columns(), ", "));
  // A column that happens to have that name may hold other words.
  const std::string name(trim(*cell));
  const bool names_file = name.ends_with(".yaml") || name.ends_with(".yml");
  if (drawing.column.empty() && !names_file) return;
  add_drawing(record, name, fs::path(manifest_->path()).parent_path(), manifest_->path());
}

}  // namespace dashpot
