#include "dashpot/machine/in_plant_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/read_quantity.h"
#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/machine/plant_of_matrices.h"
#include "dashpot/suspension/ground/road_profile.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

/// The words for what moves a plant and for what a sensor shows.
constexpr std::array kInputWords = {
    std::pair{"force", PlantInput::Force}, std::pair{"ground", PlantInput::Ground},
    std::pair{"ground_acceleration", PlantInput::GroundAcceleration}};

struct QuantityWord {
  std::string_view word;
  PlantQuantity quantity;
};
constexpr std::array kQuantityWords = {
    QuantityWord{"displacement", PlantQuantity::Displacement},
    QuantityWord{"velocity", PlantQuantity::Velocity},
    QuantityWord{"acceleration", PlantQuantity::Acceleration},
    QuantityWord{"deflection", PlantQuantity::Deflection},
    QuantityWord{"deflection_velocity", PlantQuantity::DeflectionVelocity},
    QuantityWord{"damper_force", PlantQuantity::DamperForce}};

const PlantInput* find_input(const std::string& word) {
  for (const auto& [known, kind] : kInputWords)
    if (word == known) return &kind;
  return nullptr;
}
const QuantityWord* find_quantity(const std::string& word) {
  for (const QuantityWord& known : kQuantityWords)
    if (word == known.word) return &known;
  return nullptr;
}
/// The name of a coordinate, of a strut, and of where a tyre meets the road: "front" of the
/// front_tyre.
std::string place_name(const Coordinate& coordinate) { return coordinate.name; }
std::string place_name(const Strut& strut) { return strut.name; }
std::string place_name(const Tyre& tyre) { return tyre.name.substr(0, tyre.name.rfind("_tyre")); }

std::vector<std::string> input_words() {
  std::vector<std::string> words;
  for (const auto& [word, kind] : kInputWords) words.emplace_back(word);
  return words;
}
std::vector<std::string> quantity_words() {
  std::vector<std::string> words;
  for (const QuantityWord& known : kQuantityWords) words.emplace_back(known.word);
  return words;
}

/// The row of a plant's parameter.
const ParameterRow& row_of(const PlantModel& model, const std::string& name,
                           const std::string& where) {
  return model.parameters[row_named(model.parameters, name, model.name, where)];
}

PlantUnknown unknown_within(const ParameterRow& row) {
  return {std::string(row.name), row.lower, row.upper, {}};
}

/// What is unknown within "300..500 kg", where the unit behind the upper end holds for both;
/// nothing where the text is no range.
std::optional<PlantUnknown> range_in(const std::string& text, PlantUnknown unknown,
                                     std::string_view unit, const std::string& where) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) return {};
  const std::string high = text.substr(dots + 2);
  const std::size_t behind = high.find_first_not_of("0123456789.eE+- ");
  const std::string low =
      text.substr(0, dots) + (behind == std::string::npos ? "" : high.substr(behind));
  unknown.lower = parse_quantity(low, unit, where);
  unknown.upper = parse_quantity(high, unit, where);
  return unknown;
}

/// What is unknown within {from: 300 kg, to: 500 kg, about: 390 kg}, any of which may be missing.
PlantUnknown read_unknown(const Value& value, PlantUnknown unknown, std::string_view unit) {
  ObjectReader reader(value, "an unknown number");
  if (const Value* from = reader.optional("from")) unknown.lower = read_quantity(*from, unit);
  if (const Value* to = reader.optional("to")) unknown.upper = read_quantity(*to, unit);
  if (const Value* about = reader.optional("about")) unknown.about = read_quantity(*about, unit);
  reader.finish();
  return unknown;
}

/// "unknown", "300..500 kg" or "2 kg" goes to what is unknown or to what is known.
void read_number(InPlantSetup& setup, const std::string& name, const std::string& text,
                 const std::string& where) {
  const ParameterRow& row = row_of(*setup.model, name, where);
  if (text == "unknown") {
    setup.unknown.push_back(unknown_within(row));
  } else if (const auto unknown =
                 range_in(text, unknown_within(row), row.unit, where + ", " + name)) {
    setup.unknown.push_back(*unknown);
  } else {
    setup.known.emplace_back(name, parse_value(row, text, where));
  }
}

/// Which of a plant's coordinates, struts or tyres (`what`) has this name; the only one needs none.
template <class Part>
std::size_t place_named(const std::vector<Part>& parts, const std::string& what,
                        const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    known.push_back(place_name(parts[k]));
    if (known.back() == name) return k;
  }
  if (name.empty() && parts.size() == 1) return 0;
  if (name.empty()) throw Error(where, "says not where", "at: one of " + join(known, ", "));
  throw Error(where, "the plant has no " + what + " '" + name + "'", suggest(name, known));
}

/// Where an input of this kind acts.
PlantInputPlace input_place(PlantInput kind, const Plant& plant, const std::string& at,
                            const std::string& where) {
  if (kind == PlantInput::Force)
    return {kind, place_named(plant.coordinates, "coordinate", at, where)};
  if (kind == PlantInput::Ground && has_several_roads(plant))
    return {kind, 0, place_named(plant.tyres, "road under a tyre", at, where)};
  if (!at.empty()) throw Error(where, "the ground is under all of the plant", "leave out 'at'");
  return {kind};
}

/// What a sensor of this quantity stands on.
PlantSensorPlace sensor_place(const QuantityWord& word, const Plant& plant, const std::string& at,
                              const std::string& where) {
  PlantSensorPlace place{word.quantity};
  if (!place.is_of_damper())
    place.coordinate = place_named(plant.coordinates, "coordinate", at, where);
  else if (plant.struts.size() > 1)
    place.strut = place_named(plant.struts, "strut", at, where);
  else if (!at.empty())
    throw Error(where, std::string(word.word) + " is the damper's", "leave out 'at'");
  return place;
}

/// Whether a name may stand in that of a file and before a parameter's.
bool is_plain(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char letter) {
    return std::isalnum(letter) || letter == '_' || letter == '-';
  });
}

/// The struts of one kind of damper: one, or a list.
std::vector<std::size_t> struts_of_kind(const Value& value, const Plant& plant) {
  std::vector<std::size_t> struts;
  const auto add = [&](const Value& one) {
    struts.push_back(place_named(plant.struts, "strut", one.as_string(), one.where()));
  };
  if (value.kind() == Value::Kind::String)
    add(value);
  else
    for (const Value& one : value.items()) add(one);
  return struts;
}

/// "alike", "apart", or kinds by name, each with its struts.
DamperKinds read_kinds(const Value& value, const Plant& plant) {
  DamperKinds kinds;
  if (value.kind() == Value::Kind::String) {
    const std::string word = value.as_string();
    if (word != "alike" && word != "apart")
      throw Error(value.where(), "damper_kinds are '" + word + "'",
                  "alike, apart, or kinds by name, each with its struts: {front: [front_left, "
                  "front_right], rear: [rear_left, rear_right]}");
    kinds.are_stated = true;
    if (word == "alike" || plant.struts.size() == 1) return kinds;
    kinds.names.clear();
    for (std::size_t strut = 0; strut < plant.struts.size(); ++strut) {
      kinds.names.push_back(plant.struts[strut].name);
      kinds.of.push_back(strut);
    }
    return kinds;
  }

  // Each strut once.
  constexpr std::size_t kNone = SIZE_MAX;
  kinds.are_stated = true;
  kinds.names.clear();
  kinds.of.assign(plant.struts.size(), kNone);
  for (const auto& [name, struts] : value.members()) {
    if (!is_plain(name))
      throw Error(struts.where(), "'" + name + "' is no name for a kind of damper",
                  "letters, digits, _ and -");
    const std::vector<std::size_t> own = struts_of_kind(struts, plant);
    if (own.empty())
      throw Error(struts.where(), "'" + name + "' is a kind without a damper", "its struts");
    for (const std::size_t strut : own) {
      if (kinds.of[strut] != kNone)
        throw Error(struts.where(),
                    "the damper in " + plant.struts[strut].name + " is of two kinds",
                    "one of them");
      kinds.of[strut] = kinds.names.size();
    }
    kinds.names.push_back(name);
  }

  // None is left, and no name says two things.
  for (std::size_t strut = 0; strut < kinds.of.size(); ++strut)
    if (kinds.of[strut] == kNone)
      throw Error(value.where(), "the damper in " + plant.struts[strut].name + " is of no kind",
                  "each strut under the name of a kind");
  for (std::size_t strut = 0; strut < kinds.of.size(); ++strut)
    if (const std::string& name = plant.struts[strut].name;
        name != kinds.names[kinds.of[strut]] &&
        std::ranges::find(kinds.names, name) != kinds.names.end())
      throw Error(value.where(), "'" + name + "' is a strut and names the kind of another one",
                  "another name for that kind");
  if (kinds.size() == 1) return {.are_stated = true};
  return kinds;
}

/// What a plant cannot do without: a number that its table does not have at 0. Stops are none
/// unless they are stated, so that their stiffness does not matter.
void require_stated(const InPlantSetup& setup, const std::string& where) {
  std::vector<std::string> missing, units;
  for (const ParameterRow& row : setup.model->parameters) {
    const std::string name(row.name);
    if (row.value == 0 || name.starts_with("stop_")) continue;
    const bool known =
        std::ranges::any_of(setup.known, [&](const auto& one) { return one.first == name; });
    if (known || std::ranges::find(setup.unknown, name, &PlantUnknown::name) != setup.unknown.end())
      continue;
    missing.push_back(name + " (" + std::string(row.meaning) + ")");
    units.emplace_back(row.unit);
  }
  if (missing.empty()) return;
  throw Error(where, "says nothing of " + join(missing, ", "),
              missing.size() == 1 ? "its value in " + units.front() + ", or 'unknown'"
                                  : "their values in " + join(units, ", ") + ", or 'unknown'");
}

/// A drive: the name of a channel, or a constant level with its unit.
DamperDrive read_drive(const std::string& text, DriveUnit unit, const std::string& where) {
  const bool is_level = !text.empty() && text.find_first_of("0123456789.-+") == 0;
  if (!is_level) return {.channel = text};

  // A level in the other unit belongs to the other key.
  const bool is_volt = unit == DriveUnit::Volt;
  const DriveUnit other = is_volt ? DriveUnit::Ampere : DriveUnit::Volt;
  const std::size_t behind = text.find_first_not_of("0123456789.eE+- ");
  const std::optional<Unit> given =
      behind == std::string::npos ? std::nullopt : parse_unit(text.substr(behind));
  if (given && given->dimension == parse_unit(to_string(other))->dimension)
    throw Error(where,
                "'" + text + "' is a level in " + to_string(other) + ", not in " + to_string(unit),
                std::string(is_volt ? "'current: " : "'voltage: ") + text +
                    "' for a damper that is "
                    "driven by a " +
                    (is_volt ? "current" : "voltage"));
  return {.channel = {}, .level = parse_quantity(text, to_string(unit), where)};
}

/// Drives by the names of struts or kinds, each damper's once: {front: coil_f, rear: coil_r}.
struct NamedDrive {
  std::string name, where;
  DamperDrive drive;
};

std::vector<DamperDrive> drives_by_name(const std::vector<NamedDrive>& named,
                                        const InPlantSetup& setup, const std::string& where) {
  std::vector<std::optional<DamperDrive>> found(setup.dampers());
  for (const NamedDrive& one : named) {
    const std::vector<std::size_t> dampers = dampers_named(setup, one.name);
    if (dampers.empty())
      throw Error(one.where, "'" + one.name + "' is neither a strut nor a kind of damper",
                  suggest(one.name, damper_names(setup)));
    for (const std::size_t d : dampers) {
      if (found[d]) throw Error(one.where, "drives a damper that another one drives", "one each");
      found[d] = one.drive;
    }
  }

  // Each damper has one.
  std::vector<DamperDrive> drives;
  const Plant plant = make_plant(*setup.model, setup.known);
  for (std::size_t d = 0; d < found.size(); ++d) {
    if (!found[d])
      throw Error(where, "nothing is said of the damper in " + plant.struts[d].name,
                  "a channel or a level for each: " + join(damper_names(setup), ", "));
    drives.push_back(*found[d]);
  }
  return drives;
}

/// What drives the dampers: all of them, or each by its strut or kind.
std::vector<DamperDrive> read_drives(const Value& value, DriveUnit unit,
                                     const InPlantSetup& setup) {
  const auto drive_of = [&](const Value& one) {
    return one.kind() == Value::Kind::Number ? DamperDrive{.channel = {}, .level = one.as_number()}
                                             : read_drive(one.as_string(), unit, one.where());
  };
  if (value.kind() != Value::Kind::Object) return {drive_of(value)};
  std::vector<NamedDrive> named;
  for (const auto& [name, one] : value.members())
    named.push_back({name, one.where(), drive_of(one)});
  return drives_by_name(named, setup, value.where());
}

/// "CHANNEL@body"
std::pair<std::string, std::string> channel_and_place(const std::string& text) {
  const std::size_t at = text.find('@');
  return {text.substr(0, at), at == std::string::npos ? "" : text.substr(at + 1)};
}

bool is_drive(const std::string& key) { return key == "current" || key == "voltage"; }

/// Several channels may show one quantity, each at a place of its own; all else is said once.
void require_said_once(std::vector<std::string> parts, const std::string& where) {
  std::erase_if(parts, [](const std::string& part) {
    const std::string key(trim(part.substr(0, part.find('='))));
    return find_input(key) || find_quantity(key) || is_drive(key);
  });
  if (const auto twice = stated_twice(parts))
    throw Error(where + ", " + *twice, "is stated twice", "once");
}

InPlantSetup from_words(const std::string& words) {
  const std::string where = "--in";
  std::vector<std::string> parts = split(words, ',');
  InPlantSetup setup;
  setup.model = &find_machine(std::string(trim(parts.front())), where);
  std::vector<std::pair<std::string, std::string>> channels;
  std::vector<NamedDrive> drives;
  require_said_once(parts, where);

  // The plant's numbers first: they say which coordinates it has.
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const std::size_t equals = parts[k].find('=');
    if (equals == std::string::npos)
      throw Error(where, "'" + parts[k] + "' has no '='", "name=value, as mass=2kg");
    const std::string key(trim(parts[k].substr(0, equals)));
    const std::string value(trim(parts[k].substr(equals + 1)));
    const std::string at = where + ", " + key;
    if (find_input(key) || find_quantity(key)) {
      channels.emplace_back(key, value);
    } else if (is_drive(key)) {
      const DriveUnit unit = key == "current" ? DriveUnit::Ampere : DriveUnit::Volt;
      const auto [drive, place] = channel_and_place(value);
      if (setup.drive_unit != DriveUnit::None && (setup.drive_unit != unit || place.empty()))
        throw Error(at, "the dampers are driven already",
                    "one of 'current' and 'voltage', or one for each damper: coil_f@front");
      setup.drive_unit = unit;
      drives.push_back({place, at, read_drive(drive, unit, at)});
    } else if (key == "held_back") {
      setup.held_back = parse_quantity(value, "1", at);
    } else if (key == "skip") {
      setup.skip = parse_quantity(value, "s", at);
    } else if (key == "start") {
      if (value != "rest" && value != "unknown")
        throw Error(at, "is '" + value + "'", "rest or unknown");
      setup.from_rest = value == "rest";
    } else {
      std::vector<std::string> known = input_words();
      for (const std::string& word : quantity_words()) known.push_back(word);
      for (const char* word : {"current", "voltage", "held_back", "skip", "start"})
        known.emplace_back(word);
      for (const ParameterRow& row : setup.model->parameters) known.emplace_back(row.name);
      if (std::ranges::find(known, key) == known.end())
        throw Error(where, "unknown key '" + key + "'", suggest(key, known));
      read_number(setup, key, value, where);
    }
  }

  // Then where its inputs and sensors stand.
  const Plant plant = make_plant(*setup.model, setup.known, where);
  for (const auto& [key, value] : channels) {
    const auto [channel, place] = channel_and_place(value);
    const std::string at = where + ", " + key;
    if (const PlantInput* kind = find_input(key))
      setup.inputs.push_back({channel, input_place(*kind, plant, place, at)});
    else
      setup.sensors.push_back(
          {.channel = channel, .place = sensor_place(*find_quantity(key), plant, place, at)});
  }
  if (drives.size() == 1 && drives.front().name.empty())
    setup.drives = {drives.front().drive};
  else if (!drives.empty())
    setup.drives = drives_by_name(drives, setup, where);
  return setup;
}

/// A number that a fit found: {found: 387 kg, low: 380 kg, high: 394 kg}.
void read_found(InPlantSetup& setup, const std::string& name, const ParameterRow& row,
                const Value& value) {
  ObjectReader reader(value, "a number that was found");
  const double found =
      checked(row, read_quantity(reader.required("found"), row.unit), value.where());
  const FoundNumber interval{name, read_quantity(reader.required("low"), row.unit),
                             read_quantity(reader.required("high"), row.unit)};
  reader.finish();
  if (!(interval.low <= found && found <= interval.high))
    throw Error(value.where(), "lies outside its own interval",
                "low, found and high in that order");
  setup.known.emplace_back(name, found);
  setup.found.push_back(interval);
}

void read_parameters(InPlantSetup& setup, const Value& parameters) {
  for (const auto& [name, value] : parameters.members()) {
    const ParameterRow& row = row_of(*setup.model, name, value.where());
    if (value.kind() == Value::Kind::Object && value.find("found")) {
      read_found(setup, name, row, value);
    } else if (value.kind() == Value::Kind::Object) {
      setup.unknown.push_back(read_unknown(value, unknown_within(row), row.unit));
    } else if (value.kind() == Value::Kind::Number) {
      setup.known.emplace_back(name, checked(row, value.as_number(), value.where()));
    } else {
      read_number(setup, name, value.as_string(), value.where());
    }
  }
}

/// The plant: one of the kinds, or matrices; and what is known and unknown of it.
void read_plant(InPlantSetup& setup, ObjectReader& reader, const std::string& source) {
  const std::string kind = reader.string("plant");
  const Value* parameters = reader.optional("parameters");
  if (kind != kOfMatrices) {
    setup.model = &find_machine(kind, source + ", plant");
    if (parameters) read_parameters(setup, *parameters);
    return;
  }
  std::vector<std::string> names;
  if (parameters)
    for (const auto& [name, value] : parameters->members()) names.push_back(name);
  const std::shared_ptr<PlantOfMatrices> matrices = read_plant_of_matrices(reader, names, source);
  setup.model = &matrices->model;
  setup.matrices = matrices;
  if (parameters) read_parameters(setup, *parameters);
  settle_unknowns(*matrices, setup, source);
}

/// The noise of a sensor or an input, or how far its zero may be off.
double read_deviation(ObjectReader& reader, std::string_view key, std::string_view unit) {
  const Value* noise = reader.optional(key);
  if (!noise) return 0;
  const double deviation = read_quantity(*noise, unit);
  if (deviation <= 0)
    throw Error(noise->where(), std::string(key) + " is not above 0", "leave it out if unknown");
  return deviation;
}

IdentifiedNoise read_identified(ObjectReader& reader, std::string_view unit) {
  return {read_deviation(reader, "noise_found", unit), read_deviation(reader, "zero_found", unit)};
}

/// A road without a channel: its class, or that it is unknown, and the speed.
RoadPrior read_road(ObjectReader& reader, const std::string& kind, const Value& value) {
  if (kind != "ground")
    throw Error(value.where(), "has no channel", "only a road may be without: kind: ground");
  RoadPrior road;
  const std::string word = reader.string("class");
  if (word != "unknown") road.roughness = road_roughness(word.size() == 1 ? word.front() : '?');
  road.speed = read_quantity(reader.required("speed"), "m/s");
  if (!(road.speed > 0)) throw Error(value.where(), "its speed is not above 0");
  return road;
}

/// A number that is known, or `about`: then it is to be found.
double read_about(const Value& number, const char* unit, bool& is_to_be_found) {
  if (number.kind() == Value::Kind::String && number.as_string() == "unknown")
    throw Error(number.where(), "is unknown, and nothing says where it is expected",
                "{about: ...}, within a tenth of it");
  if (number.kind() != Value::Kind::Object) return read_quantity(number, unit);
  ObjectReader about(number, "what is not quite known");
  const double expected = read_quantity(about.required("about"), unit);
  about.finish();
  is_to_be_found = true;
  return expected;
}

/// A road that another axle met before: how much later, as a time or by wheelbase and speed.
void read_follower(ObjectReader& reader, PlantInputChannel& input, const std::string& at,
                   const Value& value) {
  if (!input.channel.empty())
    throw Error(value.where(), "has a channel and follows another one", "one of both");
  input.follows = reader.string("follows");
  input.channel = input.follows + " at " + at;

  // Either way says it alone.
  const Value* delay = reader.optional("delay");
  const Value* wheelbase = reader.optional("wheelbase");
  const Value* speed = reader.optional("speed");
  if (delay && !wheelbase && !speed)
    input.later = read_about(*delay, "s", input.finds_later);
  else if (!delay && wheelbase && speed)
    input.later = read_quantity(*wheelbase, "m") / read_about(*speed, "m/s", input.finds_later);
  else
    throw Error(value.where(), "does not say how much later it meets the road",
                "delay: 0.14 s, or wheelbase: 2.8 m with speed: 20 m/s");
}

PlantInputChannel read_input(const Value& value, const Plant& plant) {
  ObjectReader reader(value, "an input");
  PlantInputChannel input{.channel = reader.string("channel", ""), .place = {}};
  const std::string kind = reader.string("kind"), at = reader.string("at", "");
  const PlantInput* known = find_input(kind);

  // What it does: as another road does, as a road of a class, or as its channel shows.
  if (reader.optional("follows"))
    read_follower(reader, input, at, value);
  else if (input.channel.empty())
    input.road = read_road(reader, kind, value);
  else if (known) {
    input.noise = read_deviation(reader, "noise", unit_of(*known));
    input.identified = read_identified(reader, unit_of(*known));
  }
  reader.finish();
  if (!known)
    throw Error(value.where(), "unknown kind of input '" + kind + "'",
                suggest(kind, input_words()));
  input.place = input_place(*known, plant, at, value.where());
  return input;
}

/// "50 Hz", "unknown", "20..60 Hz" or {about: 30 Hz, from: 20 Hz, to: 60 Hz}.
void read_cutoff(const Value& value, PlantSensor& sensor) {
  const PlantUnknown anywhere{"cutoff", 0, INFINITY, {}};
  std::optional<PlantUnknown> unknown;
  if (value.kind() == Value::Kind::Object)
    unknown = read_unknown(value, anywhere, "Hz");
  else if (value.kind() == Value::Kind::String && value.as_string() == "unknown")
    unknown = anywhere;
  else if (value.kind() == Value::Kind::String)
    unknown = range_in(value.as_string(), anywhere, "Hz", value.where());
  if (!unknown) {
    sensor.filter.cutoff = read_quantity(value, "Hz");
    if (!(sensor.filter.cutoff > 0))
      throw Error(value.where(), "filter: its cut-off is not above 0 Hz",
                  "leave it out if there is none");
    return;
  }

  // Where it is looked for, and where the search starts.
  if (!(unknown->lower >= 0 && unknown->lower < unknown->upper))
    throw Error(value.where(), "filter: its range is none", "from less to more, above 0 Hz");
  if (unknown->about && !(*unknown->about > 0 && *unknown->about >= unknown->lower &&
                          *unknown->about <= unknown->upper))
    throw Error(value.where(), "filter: 'about' lies outside its range");
  sensor.finds_cutoff = {unknown->lower, unknown->upper};
  sensor.filter.cutoff = unknown->about.value_or(0);
}

/// A cut-off, or {cutoff: 50 Hz, order: 4}.
void read_filter(const Value& value, PlantSensor& sensor) {
  if (value.kind() != Value::Kind::Object || !value.find("cutoff"))
    return read_cutoff(value, sensor);
  ObjectReader reader(value, "a filter");
  read_cutoff(reader.required("cutoff"), sensor);
  const double order = reader.number("order", sensor.filter.order);
  if (!(order >= 1 && order <= kMostFilterOrder && order == std::floor(order)))
    throw Error(value.where(), "filter: its order is " + format_number(order),
                fmt::format("1 to {}, of Butterworth's", kMostFilterOrder));
  sensor.filter.order = static_cast<int>(order);
  reader.finish();
}

PlantSensor read_sensor(const Value& value, const Plant& plant) {
  ObjectReader reader(value, "a sensor");
  PlantSensor sensor{.channel = reader.string("channel"), .place = {}};
  const std::string word = reader.string("quantity"), at = reader.string("at", "");
  const QuantityWord* known = find_quantity(word);
  if (!known)
    throw Error(value.where(), "unknown quantity '" + word + "'", suggest(word, quantity_words()));
  sensor.place = sensor_place(*known, plant, at, value.where());
  const std::string unit = unit_of(sensor.place, plant);
  sensor.noise = read_deviation(reader, "noise", unit);
  sensor.zero = read_deviation(reader, "zero", unit);
  sensor.identified = read_identified(reader, unit);
  if (const Value* delay = reader.optional("delay")) {
    sensor.finds_delay = delay->kind() == Value::Kind::String && delay->as_string() == "unknown";
    if (!sensor.finds_delay) sensor.delay = read_quantity(*delay, "s");
  }
  if (const Value* filter = reader.optional("filter")) read_filter(*filter, sensor);
  reader.finish();
  return sensor;
}

/// What is stated of a sensor's noise, and what was found of it, with its unit.
void add_noise(double stated, const IdentifiedNoise& identified, const std::string& unit,
               Value& sensor) {
  const auto with_unit = [&](double value) { return fmt::format("{} {}", value, unit); };
  const bool is_stated = stated > 0 && identified.from.empty();
  if (is_stated) sensor.add("noise", stated);
  if (is_stated || !(identified.deviation > 0)) return;
  sensor.add("noise_found", with_unit(identified.deviation));
  if (identified.zero > 0) sensor.add("zero_found", with_unit(identified.zero));
}

/// The cut-off of a sensor's filter, or what is known of it.
Value cutoff_json(const PlantSensor& sensor) {
  if (!sensor.finds_cutoff) return sensor.filter.cutoff;
  const auto& [lower, upper] = *sensor.finds_cutoff;
  Value known = Value::object();
  if (lower > 0) known.add("from", lower);
  if (std::isfinite(upper)) known.add("to", upper);
  if (sensor.filter.cutoff > 0) known.add("about", sensor.filter.cutoff);
  return known.members().empty() ? Value("unknown") : known;
}

/// The kinds of dampers by name, each with its struts.
Value kinds_json(const DamperKinds& kinds, const Plant& plant) {
  Value all = Value::object();
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    Value struts = Value::array();
    for (std::size_t strut = 0; strut < plant.struts.size(); ++strut)
      if (kinds.at(strut) == kind) struts.push_back(plant.struts[strut].name);
    all.add(kinds.names[kind], std::move(struts));
  }
  return all;
}

Value drives_json(const std::vector<DamperDrive>& drives, const Plant& plant) {
  const auto one = [](const DamperDrive& drive) {
    return drive.channel.empty() ? Value(drive.level) : Value(drive.channel);
  };
  if (drives.size() == 1) return one(drives.front());
  Value all = Value::object();
  for (std::size_t d = 0; d < drives.size(); ++d) all.add(plant.struts[d].name, one(drives[d]));
  return all;
}

}  // namespace

InPlantSetup parse_in_plant_setup(std::string_view text, const std::string& source) {
  const Value value = parse_yaml(text, source);
  refuse_other_kind(value, "a plant with its sensors");
  ObjectReader reader(value, "a plant with its sensors");
  InPlantSetup setup;
  read_plant(setup, reader, source);
  const Plant plant = make_plant(*setup.model, setup.known, source);
  for (const Value& input : reader.required("inputs").items())
    setup.inputs.push_back(read_input(input, plant));
  for (const Value& sensor : reader.required("sensors").items())
    setup.sensors.push_back(read_sensor(sensor, plant));

  if (const Value* kinds = reader.optional("damper_kinds")) setup.kinds = read_kinds(*kinds, plant);

  // What drives the dampers: channels or levels, of one unit.
  for (const auto& [key, unit] :
       {std::pair{"current", DriveUnit::Ampere}, std::pair{"voltage", DriveUnit::Volt}}) {
    const Value* drive = reader.optional(key);
    if (!drive) continue;
    if (setup.drive_unit != DriveUnit::None)
      throw Error(drive->where(), "a damper is driven by a current or a voltage, not by both");
    setup.drive_unit = unit;
    setup.drives = read_drives(*drive, unit, setup);
  }
  const std::string start = reader.string("start", "unknown");
  if (start != "rest" && start != "unknown")
    throw Error(source + ", start", "is '" + start + "'", "rest or unknown");
  setup.from_rest = start == "rest";
  setup.held_back = reader.number("held_back", setup.held_back);
  if (const Value* skip = reader.optional("skip")) setup.skip = read_quantity(*skip, "s");
  reader.finish();
  require_stated(setup, source);
  require_setup(setup);
  return setup;
}

InPlantSetup read_in_plant_setup(const std::string& words) {
  const std::string first = words.substr(0, words.find(','));
  if (first.find_first_of("./") != std::string::npos)
    return parse_in_plant_setup(read_file(words), words);
  InPlantSetup setup = from_words(words);
  require_stated(setup, "--in");
  require_setup(setup);
  return setup;
}

Value to_json(const InPlantSetup& setup) {
  // What is known of the plant, and what is not.
  Value parameters = Value::object();
  for (const auto& [name, value] : setup.known) {
    const auto found = std::ranges::find(setup.found, name, &FoundNumber::name);
    parameters.add(
        name, found == setup.found.end()
                  ? Value(value)
                  : Value::object({{"found", value}, {"low", found->low}, {"high", found->high}}));
  }
  for (const PlantUnknown& unknown : setup.unknown) {
    Value range = Value::object();
    range.add("from", unknown.lower);
    range.add("to", unknown.upper);
    if (unknown.about) range.add("about", *unknown.about);
    parameters.add(unknown.name, std::move(range));
  }
  const Plant plant = make_plant(*setup.model, setup.known);

  // What moves it.
  Value inputs = Value::array();
  for (const PlantInputChannel& input : setup.inputs) {
    Value one = Value::object();
    if (!input.follows.empty()) {
      one.add("follows", input.follows);
      one.add("delay",
              input.finds_later ? Value::object({{"about", input.later}}) : Value(input.later));
    } else if (!input.road) {
      one.add("channel", input.channel);
    }
    one.add("kind", kInputWords[static_cast<std::size_t>(input.place.kind)].first);
    if (input.place.kind == PlantInput::Force)
      one.add("at", plant.coordinates[input.place.coordinate].name);
    if (input.place.tyre) one.add("at", place_name(plant.tyres[*input.place.tyre]));
    add_noise(input.noise, input.identified, unit_of(input.place.kind), one);
    if (input.road) {
      std::string road_class = "unknown";
      for (char letter = 'A'; letter <= 'H'; ++letter)
        if (input.road->roughness == road_roughness(letter)) road_class = letter;
      one.add("class", road_class);
      one.add("speed", input.road->speed);
    }
    inputs.push_back(std::move(one));
  }

  // What was measured on it, and what drives the damper.
  Value sensors = Value::array();
  for (const PlantSensor& sensor : setup.sensors) {
    const QuantityWord& word = kQuantityWords[static_cast<std::size_t>(sensor.place.quantity)];
    Value one = Value::object();
    one.add("channel", sensor.channel);
    one.add("quantity", word.word);
    if (!sensor.place.is_of_damper())
      one.add("at", plant.coordinates[sensor.place.coordinate].name);
    else if (plant.struts.size() > 1)
      one.add("at", plant.struts[sensor.place.strut].name);
    add_noise(sensor.noise, sensor.identified, unit_of(sensor.place, plant), one);
    if (sensor.zero > 0 &&
        (sensor.identified.from.empty() || sensor.zero != sensor.identified.zero))
      one.add("zero", sensor.zero);
    if (sensor.finds_delay)
      one.add("delay", "unknown");
    else if (sensor.delay != 0)
      one.add("delay", sensor.delay);
    if (sensor.finds_cutoff || sensor.filter.cutoff > 0)
      one.add("filter",
              Value::object({{"cutoff", cutoff_json(sensor)}, {"order", sensor.filter.order}}));
    sensors.push_back(std::move(one));
  }
  Value file = Value::object({{"plant", setup.model->name}});
  if (setup.matrices)
    for (const auto& [key, value] : setup.matrices->file) file.add(key, value);
  file.add("parameters", std::move(parameters));
  file.add("inputs", std::move(inputs));
  file.add("sensors", std::move(sensors));
  if (setup.kinds.size() > 1)
    file.add("damper_kinds", kinds_json(setup.kinds, plant));
  else if (setup.kinds.are_stated)
    file.add("damper_kinds", "alike");
  if (setup.drive_unit != DriveUnit::None) {
    const std::string key = setup.drive_unit == DriveUnit::Volt ? "voltage" : "current";
    file.add(key, drives_json(setup.drives, plant));
  }
  file.add("start", setup.from_rest ? "rest" : "unknown");
  file.add("held_back", setup.held_back);
  file.add("skip", setup.skip);
  return file;
}

InPlantSetup as_found(InPlantSetup setup, const InPlantReport& report) {
  for (const FittedParameter& p :
       report.plant_beside_any_force.empty() ? report.plant : report.plant_beside_any_force) {
    setup.known.emplace_back(p.name, p.value);
    if (has_interval(p)) setup.found.push_back({p.name, p.low, p.high});
  }
  setup.unknown.clear();

  // Dampers may have been found to be of several kinds.
  if (report.kinds.size() > 1) {
    setup.kinds = {
        .names = {}, .of = std::vector<std::size_t>(setup.dampers()), .are_stated = true};
    for (const FoundDamper& damper : report.kinds) {
      for (const std::size_t strut : damper.struts) setup.kinds.of[strut] = setup.kinds.size();
      setup.kinds.names.push_back(damper.name);
    }
  }
  const auto identified = [&](const std::string& channel, double stated) {
    const auto one = std::ranges::find(report.noise, channel, &FoundNoise::channel);
    if (stated > 0 || one == report.noise.end()) return IdentifiedNoise{};
    return IdentifiedNoise{one->deviation, one->zero};
  };
  for (PlantInputChannel& input : setup.inputs) {
    input.identified = identified(input.channel, input.noise);
    for (const FittedParameter& p : report.nuisances)
      if (input.finds_later && p.name == "delay of " + input.channel) input.later = p.value;
    input.finds_later = false;
  }
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    PlantSensor& sensor = setup.sensors[s];
    sensor.identified = identified(sensor.channel, sensor.noise);
    take_found(lags_found(report.nuisances, sensor.channel), sensor);
    sensor.finds_delay = false;
    sensor.finds_cutoff.reset();
  }
  return setup;
}

}  // namespace dashpot
