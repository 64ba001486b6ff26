#include "dashpot/suspension/sweep/request_file.h"

#include <algorithm>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/suspension/sweep/input_names.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;

/// The quantity under a key, within bounds.
void read_into(ObjectReader& reader, const ParameterRow& row, double& target) {
  if (const Value* value = reader.optional(row.name))
    target = checked(row, read_quantity(*value, row.unit), value->where());
}

/// A count or a seed, which are whole numbers.
template <class Count>
void read_count(ObjectReader& reader, const ParameterRow& row, Count& target) {
  double number = static_cast<double>(target);
  read_into(reader, row, number);
  target = static_cast<Count>(number);
}

constexpr double kMostWhole = 9007199254740992.0;  // a double holds every whole number up to it
constexpr ParameterRow kSamples{"samples", "1", 1000, 1, 1e7, "", true};
constexpr ParameterRow kSeed{"seed", "1", 1, 0, kMostWhole, "", true};
constexpr ParameterRow kRoadSeed{"road_seed", "1", 1, 0, kMostWhole, "", true};
constexpr ParameterRow kDuration{"duration", "s", 30, 0.1, 1e5, ""};
constexpr ParameterRow kDiscard{"discard", "s", 5, 0, 1e5, ""};
constexpr ParameterRow kOutside{"outside_limit", "1", 0.05, 0, 1, ""};
constexpr ParameterRow kTolerance{"tolerance", "1", 1e-6, 1e-12, 1e-2, ""};
constexpr ParameterRow kCurrent{"current", "A", 0, -100, 100, ""};
constexpr ParameterRow kCurrentMax{"current_max", "A", 0, 0, 100, ""};
constexpr ParameterRow kLagRate{"lag_rate", "1/s", 0, 0, 1e6, ""};
constexpr ParameterRow kSampleTime{"sample_time", "s", 1e-3, 1e-5, 1, ""};

/// A name as it is, or a file: the one beside the request, where it is there.
std::string found_file(const std::string& text, const fs::path& folder) {
  const std::string name = text.substr(0, text.find(','));
  if (name.find_first_of("./") == std::string::npos || fs::path(name).is_absolute()) return text;
  const fs::path beside = folder / name;
  return fs::exists(beside) ? beside.string() + text.substr(name.size()) : text;
}

SensorOptions read_sensors(const Value& value) {
  SensorOptions sensors;
  if (value.kind() == Value::Kind::String) {
    if (value.as_string() != "in_car" && value.as_string() != "ideal")
      throw Error(value.where(), "unknown sensors '" + value.as_string() + "'",
                  "ideal, in_car or {...}");
    sensors.in_car = value.as_string() == "in_car";
    return sensors;
  }

  // Each flaw by itself.
  ObjectReader reader(value, "sensors");
  sensors.in_car = reader.boolean("in_car", true);
  read_into(reader, {"acceleration_noise", "m/s^2", 0, 0, 100}, sensors.acceleration_noise);
  read_into(reader, {"acceleration_resolution", "m/s^2", 0, 0, 100},
            sensors.acceleration_resolution);
  read_into(reader, {"deflection_noise", "m", 0, 0, 1}, sensors.deflection_noise);
  read_into(reader, {"deflection_resolution", "m", 0, 0, 1}, sensors.deflection_resolution);
  read_into(reader, {"delay", "s", 0, 0, 1}, sensors.delay);
  read_into(reader, {"integration_corner", "Hz", 0, 1e-3, 1e3}, sensors.integration_corner);
  read_into(reader, {"derivative_corner", "Hz", 0, 1e-3, 1e4}, sensors.derivative_corner);
  reader.finish();
  return sensors;
}

/// The keys that may stand at the top, for all controllers, or under one of them.
void read_words(ObjectReader& reader, VehicleWords& words, const fs::path& folder) {
  if (const Value* dampers = reader.optional("dampers")) {
    words.dampers.clear();
    if (dampers->kind() == Value::Kind::String)
      words.dampers.push_back(found_file(dampers->as_string(), folder));
    else
      for (const Value& item : dampers->items())
        words.dampers.push_back(found_file(item.as_string(), folder));
  }

  // What commands the dampers.
  words.controller = reader.string("controller", words.controller);
  words.inverse = found_file(reader.string("inverse", words.inverse), folder);
  words.force_loop = reader.string("force_loop", words.force_loop);
  read_into(reader, kCurrent, words.current);
  read_into(reader, kCurrentMax, words.current_max);
  read_into(reader, kLagRate, words.lag_rate);
  read_into(reader, kSampleTime, words.sample_time);
  if (const Value* sensors = reader.optional("sensors")) words.sensors = read_sensors(*sensors);
}

void read_values(const Value& value, VehicleWords& words) {
  for (const auto& [name, member] : value.members())
    words.values.push_back(name + '=' +
                           (member.kind() == Value::Kind::Number ? format_exact(member.as_number())
                                                                 : member.as_string()));
}

/// Refuses what a controller states for itself and does not use, as the command line does. What
/// stands above them all is for those that use it.
void require_effect(const Value& stated, const VehicleWords& words) {
  for (const IdleWord& idle : idle_words(words)) {
    const std::string key = idle.key == "in_car" || idle.key == "delay" ? "sensors" : idle.key;
    if (const Value* value = stated.find(key))
      throw Error(value->where(), key + ' ' + idle.why, idle.right);
  }
}

std::vector<SweepController> read_controllers(const Value& value, const VehicleWords& common,
                                              const fs::path& folder) {
  std::vector<SweepController> controllers;
  for (const auto& [name, member] : value.members()) {
    if (name.empty() || name == "road" || name == "damper" ||
        name.find_first_of(".,\"") != std::string::npos)
      throw Error(member.where(), "'" + name + "' cannot be the name of a controller",
                  "a word of its own, as passive");

    // Whatever it does not state is that of all.
    SweepController controller{name, common};
    ObjectReader reader(member, "a controller");
    read_words(reader, controller.words, folder);
    reader.finish();
    require_effect(member, controller.words);
    controllers.push_back(std::move(controller));
  }
  if (controllers.empty())
    throw Error(value.where(), "there is no controller",
                "controllers: {skyhook: {controller: skyhook}}");
  return controllers;
}

/// The controller that is named, else "passive", else the first.
std::size_t find_baseline(const std::vector<SweepController>& controllers, const Value* value) {
  const std::string name = value ? value->as_string() : "passive";
  const auto found = std::ranges::find(controllers, name, &SweepController::name);
  if (found != controllers.end()) return static_cast<std::size_t>(found - controllers.begin());
  if (!value) return 0;
  std::vector<std::string> known;
  for (const SweepController& controller : controllers) known.push_back(controller.name);
  throw Error(value->where(), "no controller is called '" + name + "'", suggest(name, known));
}

void read_inputs(const Value* value, bool on_grid, SweepRequest& request) {
  if (!value) return;
  for (const auto& [name, member] : value->members()) {
    if (std::ranges::find(request.inputs, name, &SweepInput::name) != request.inputs.end())
      throw Error(member.where(), name + " varies twice", "once, under vary or under grid");
    request.inputs.push_back(read_sweep_input(name, member, request, on_grid));
  }
}

void read_drawing(ObjectReader& reader, SweepRequest& request) {
  read_count(reader, kSamples, request.samples);
  read_count(reader, kSeed, request.seed);
  if (const Value* value = reader.optional("drawing")) {
    const std::string& name = value->as_string();
    if (name != "sobol" && name != "plain")
      throw Error(value->where(), "unknown drawing '" + name + "'",
                  suggest(name, {"sobol", "plain"}));
    request.drawing = name == "sobol" ? SweepRequest::Drawing::Sobol : SweepRequest::Drawing::Plain;
  }
  if (reader.optional("road_seed")) read_count(reader, kRoadSeed, request.road_seed.emplace());
}

void require_consistent(const SweepRequest& request, const std::string& source) {
  if (!(request.discard < request.duration))
    throw Error(source,
                "nothing is left of " + format_number(request.duration) + " s when " +
                    format_number(request.discard) + " s are discarded",
                "a longer 'duration', or a shorter 'discard'");
  const auto is_road = [](const SweepInput& input) {
    return input.target == SweepInput::Target::RoadClass ||
           (input.target == SweepInput::Target::Road && input.parameter == "roughness");
  };
  if (std::ranges::count_if(request.inputs, is_road) > 1)
    throw Error(source, "both road.class and road.roughness vary, which are the same",
                "one of them");
}

}  // namespace

SweepRequest parse_sweep(std::string_view text, const std::string& source, const fs::path& folder) {
  const Value document = parse_yaml(text, source);
  refuse_other_kind(document, "a sweep");
  ObjectReader reader(document, "a sweep");
  SweepRequest request{.source = source};
  request.name = reader.string("name", fs::path(source).stem().string());
  request.note = reader.string("note", "");

  // What all controllers have in common, then each of them.
  VehicleWords common;
  common.where = source;
  common.plant = found_file(reader.string("plant"), folder);
  if (const Value* values = reader.optional("values")) read_values(*values, common);
  read_words(reader, common, folder);
  const Value* controllers = reader.optional("controllers");
  request.controllers = controllers ? read_controllers(*controllers, common, folder)
                                    : std::vector<SweepController>{{"vehicle", common}};
  request.baseline = find_baseline(request.controllers, reader.optional("baseline"));

  // The road, how vehicles are drawn and how they ride.
  request.road = found_file(reader.string("road"), folder);
  read_drawing(reader, request);
  read_into(reader, kDuration, request.duration);
  read_into(reader, kDiscard, request.discard);
  read_into(reader, kOutside, request.outside_limit);
  read_into(reader, kTolerance, request.relative_tolerance);

  // What varies: names of it refer to all of the above.
  read_inputs(reader.optional("vary"), false, request);
  read_inputs(reader.optional("grid"), true, request);
  reader.finish();
  require_consistent(request, source);
  return request;
}

SweepRequest load_sweep(const fs::path& path) {
  return parse_sweep(read_file(path), path.string(), path.parent_path());
}

SweepRequest named_sweep(const std::string& name) {
  const std::vector<std::string> known = sweep_names();
  if (std::ranges::find(known, name) == known.end())
    throw Error("", "unknown sweep '" + name + "'", suggest(name, known));
  return load_sweep(data_folder("sweeps") / (name + ".yaml"));
}

std::vector<std::string> sweep_names() { return data_names("sweeps", ".yaml"); }

}  // namespace dashpot
