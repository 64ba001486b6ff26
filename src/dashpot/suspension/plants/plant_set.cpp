#include <algorithm>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/require_keys.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/plant.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

/// A plant that states some of its numbers states all of them: masses and stiffnesses that nobody
/// named would be those of the table, of another vehicle.
void require_stated(const PlantModel& model, const NamedValues& stated, const std::string& where) {
  constexpr std::string_view kOfStops = "stop_stiffness";  // there are none unless stated
  std::vector<std::string> missing;
  for (const ParameterRow& row : model.parameters)
    if (row.value > 0 && row.name != kOfStops &&
        std::ranges::none_of(stated, [&](const auto& one) { return one.first == row.name; }))
      missing.push_back("'" + std::string(row.name) + "' (" + std::string(row.unit) + ")");
  if (missing.empty()) return;
  throw Error(where, std::string(model.name) + " needs " + join(missing, ", ") + " too",
              "state all that it has, or {} for the numbers of the table");
}

double read_parameter(const ParameterRow& row, const Value& value) {
  return value.kind() == Value::Kind::Number ? checked(row, value.as_number(), value.where())
                                             : parse_value(row, value.as_string(), value.where());
}

NamedValues read_parameters(const PlantModel& model, const Value& parameters) {
  NamedValues values;
  for (const auto& [name, value] : parameters.members())
    values.emplace_back(
        name,
        read_parameter(
            model.parameters[row_named(model.parameters, name, model.name, value.where())], value));
  return values;
}

/// Those of a plant with its sensors: known, or found by a fit.
NamedValues read_found_parameters(const PlantModel& model, const Value& parameters) {
  NamedValues values;
  for (const auto& [name, value] : parameters.members()) {
    const bool is_object = value.kind() == Value::Kind::Object;
    const Value* found = is_object ? value.find("found") : &value;
    if (!found || (found->kind() == Value::Kind::String && found->as_string() == "unknown"))
      throw Error(value.where(), "'" + name + "' is unknown",
                  "its value: 'dashpot identify --in' writes the plant as it was found into "
                  "plants/");
    values.emplace_back(
        name, read_parameter(
                  model.parameters[row_named(model.parameters, name, model.name, value.where())],
                  *found));
  }
  return values;
}

/// `changes` replace what is stated.
Plant from_parameters(const PlantModel& model, const NamedValues& stated,
                      const NamedValues& changes, const std::string& where) {
  NamedValues values = stated;
  values.insert(values.end(), changes.begin(), changes.end());
  if (!stated.empty()) require_stated(model, values, where);
  return make_plant(model, values, where);
}

std::vector<double> read_row(const Value& value, std::size_t size) {
  std::vector<double> row = value.as_numbers();
  if (row.size() != size)
    throw Error(value.where(), "has " + std::to_string(row.size()) + " numbers",
                std::to_string(size) + ", one per coordinate");
  return row;
}

std::vector<double> read_matrix(ObjectReader& reader, std::string_view key, std::size_t size) {
  const Value& value = reader.required(key);
  if (value.items().size() != size)
    throw Error(value.where(), "has " + std::to_string(value.items().size()) + " rows",
                std::to_string(size) + ", one per coordinate");

  std::vector<double> matrix;
  for (const Value& row : value.items()) {
    const std::vector<double> numbers = read_row(row, size);
    matrix.insert(matrix.end(), numbers.begin(), numbers.end());
  }

  // A mechanical system's matrices are symmetric.
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (matrix[i * size + j] != matrix[j * size + i])
        throw Error(value.where(), "is not symmetric in row " + std::to_string(i + 1) +
                                       ", column " + std::to_string(j + 1));
  return matrix;
}

/// Floors that shake with the ground; dampers stand on it.
Plant from_matrices(const Value& value) {
  ObjectReader reader(value, "a plant's matrices");
  Plant plant;
  for (const Value& name : reader.required("floors").items())
    plant.coordinates.push_back({name.as_string(), "m"});

  plant.mass = read_matrix(reader, "mass", plant.size());
  plant.damping = read_matrix(reader, "damping", plant.size());
  plant.stiffness = read_matrix(reader, "stiffness", plant.size());

  // Places for dampers, each between the ground and a row of floors.
  for (const Value& item : reader.required("dampers").items()) {
    ObjectReader damper(item, "a damper's place");
    Strut strut{.name = damper.string("name")};
    strut.row = strut.body_row = read_row(damper.required("row"), plant.size());
    damper.finish();
    plant.struts.push_back(std::move(strut));
  }
  reader.finish();

  plant.ground.assign(plant.size(), 1);
  return plant;
}

constexpr const char* kWithSensors = "a plant with its sensors";

/// A file of `identify --in`, of which the plant alone is taken.
PlantSet from_plant_with_sensors(const Value& document, const std::string& source,
                                 const std::string& name, const NamedValues& values) {
  const Value& kind = *document.find("plant");
  PlantSet set{.name = name,
               .source = source,
               .verified = true,
               .reason = "as stated and found there",
               .plant = {},
               .damping = {},
               .kind = kind.as_string()};
  const PlantModel& model = find_plant_model(set.kind, kind.where());
  if (const Value* parameters = document.find("parameters"))
    set.stated = read_found_parameters(model, *parameters);
  set.plant = from_parameters(model, set.stated, values, source);
  set.plant.name = name;
  set.plant.title = std::string(model.title) + " (" + name + ")";
  set.plant.source = set.source;
  return set;
}

/// The document, where it is a plant with its sensors in JSON or YAML.
std::optional<Value> as_plant_with_sensors(std::string_view text, const std::string& source) {
  try {
    Value document =
        trim(text).starts_with('{') ? parse_json(text, source) : parse_yaml(text, source);
    if (file_kind(document) == kWithSensors) return document;
  } catch (const Error&) {  // whoever reads it as another file says what is wrong with it
  }
  return {};
}

DampingRange read_damping(const Value& value) {
  const std::vector<double> d = value.as_numbers();
  if (d.size() != 3 || !(0 <= d[0] && d[0] <= d[1] && d[1] <= d[2]))
    throw Error(value.where(), "is no range of damping", "[least, nominal, greatest] in N*s/m");
  return {d[0], d[1], d[2]};
}

}  // namespace

std::vector<std::string> plant_set_names() { return data_names("plants", ".json"); }

PlantSet parse_plant_set(std::string_view text, const std::string& source, const std::string& name,
                         const NamedValues& values) {
  if (const std::optional<Value> with_sensors = as_plant_with_sensors(text, source))
    return from_plant_with_sensors(*with_sensors, source, name, values);
  const Value document = parse_json_of(text, source, "a plant");
  ObjectReader reader(document, "a plant");
  if (document.find("matrices"))
    require_keys(document, "a plant", {"source", "verified", "reason", "title"});
  else
    require_keys(document, "a plant",
                 {"source", "verified", "reason", "title", "plant", "parameters"});
  PlantSet set{.name = name,
               .source = reader.string("source"),
               .verified = reader.required("verified").as_bool(),
               .reason = reader.string("reason"),
               .plant = {}};

  // The plant: matrices of its own, or a kind with parameters.
  const std::string title = reader.string("title");
  if (const Value* matrices = reader.optional("matrices")) {
    if (!values.empty())
      throw Error(source, "has matrices, no parameter '" + values.front().first + "'");
    set.plant = from_matrices(*matrices);
  } else {
    const Value& kind = reader.required("plant");
    set.kind = kind.as_string();
    const PlantModel& model = find_plant_model(set.kind, kind.where());
    const Value& parameters = reader.required("parameters");
    set.stated = read_parameters(model, parameters);
    set.plant = from_parameters(model, set.stated, values, parameters.where());
  }

  if (const Value* damping = reader.optional("damping")) set.damping = read_damping(*damping);
  reader.finish();
  set.plant.name = name;
  set.plant.title = title;
  set.plant.source = set.source;
  return set;
}

PlantSet load_plant_set(const std::string& name, const NamedValues& values) {
  // A set of data/plants.
  const std::vector<std::string> sets = plant_set_names();
  if (std::ranges::find(sets, name) != sets.end()) {
    const std::filesystem::path path = data_folder("plants") / (name + ".json");
    return parse_plant_set(read_file(path), path.string(), name, values);
  }

  // Or a kind of plant, whose table's numbers are no source's.
  std::vector<std::string> known = sets;
  for (const PlantModel* model : plant_models()) {
    if (model->name == name)
      return {name,
              std::string(model->source),
              false,
              "the numbers of the table",
              make_plant(*model, values, name),
              {},
              name};
    known.emplace_back(model->name);
  }
  throw Error("", "unknown plant '" + name + "'",
              sets.empty() ? "of the sets that come with Dashpot " + suggest(name, sets) +
                                 "; kinds of plant: " + join(known, ", ")
                           : suggest(name, known));
}

}  // namespace dashpot
