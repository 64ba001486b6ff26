#include "dashpot/suspension/sweep/inputs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/random/sobol.hpp>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/error.h"
#include "dashpot/suspension/damper_words.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

using Target = SweepInput::Target;

constexpr double kMostSeed = 4294967295.0;  // a double holds it, and so does every table
constexpr ParameterRow kSeedRow{"road.seed", "1", 1, 0, kMostSeed, "of the road's random numbers",
                                true};
constexpr ParameterRow kCurrentRow{"current", "A", 0, -100, 100, "where there is no controller"};
constexpr ParameterRow kLagRow{"lag_rate", "1/s", 0, 0, 1e6, "of the coil; 0: none"};
constexpr ParameterRow kSpeedRow{"speed", "m/s", 20, 0.1, 200, "of the vehicle"};

std::string first_word(const std::string& text) {
  return std::string(trim(split(text, ',').front()));
}

std::vector<ParameterRow> law_rows(const Law& law) {
  std::vector<ParameterRow> rows;
  for (const ParamInfo& param : law.params)
    rows.push_back({param.name, param.unit, param.value, param.lower, param.upper, param.meaning});
  return rows;
}

/// What a damper's text can be told.
std::vector<ParameterRow> damper_rows(const std::string& text) {
  const std::string name = first_word(text);
  std::vector<ParameterRow> rows;
  const auto simple = std::ranges::find(simple_dampers(), name, &SimpleDamper::name);
  const std::vector<std::string> sets = parameter_set_names();
  if (simple != simple_dampers().end())
    rows = simple->parameters;
  else if (std::ranges::find(sets, name) != sets.end())
    rows = law_rows(load_parameter_set(name).model.law());
  rows.insert(rows.end(), mounting_settings().begin(), mounting_settings().end());
  return rows;
}

/// The row of that parameter, and which dampers can be told it.
ParameterRow damper_row(SweepInput& input, const SweepRequest& request, const std::string& where) {
  const std::string& parameter = input.parameter;
  std::vector<std::string> known;
  ParameterRow found;
  for (const SweepController& controller : request.controllers)
    for (const std::string& text : controller.words.dampers)
      for (const ParameterRow& row : damper_rows(text)) {
        known.push_back("damper." + std::string(row.name));
        if (row.name != parameter) continue;
        found = row;
        input.dampers.push_back(first_word(text));
      }
  if (!input.dampers.empty()) return found;
  if (known.empty())
    throw Error(where,
                "the dampers are those of the plant, which cannot be told '" + parameter + "'",
                "name dampers: \"ideal,damping_min=300,damping_max=3900\"");
  throw Error(where, "no damper here has a parameter '" + parameter + "'",
              suggest("damper." + parameter, known));
}

ParameterRow plant_row(const VehicleWords& words, const std::string& name,
                       const std::string& where) {
  const PlantSet set = load_plant(words);
  if (set.kind.empty()) throw Error(where, set.name + " has matrices, no parameter '" + name + "'");
  const PlantModel& model = find_plant_model(set.kind);
  std::vector<std::string> known;
  for (const ParameterRow& row : model.parameters) {
    if (row.name == name) return row;
    known.emplace_back(row.name);
  }
  known.insert(known.end(), {"road.class", "road.speed", "road.seed", "damper.force_factor",
                             "current", "lag_rate"});
  throw Error(where, "nothing of a vehicle is known as '" + name + "'", suggest(name, known));
}

ParameterRow controller_row(const SweepController& controller, const std::string& parameter,
                            const std::string& where) {
  if (controller.words.controller.empty())
    throw Error(where,
                "'" + controller.name + "' has no controller whose '" + parameter + "' could vary");
  const ControlLaw& law = find_control_law(first_word(controller.words.controller), where);
  return law.parameters[row_named(law.parameters, parameter, law.name, where)];
}

/// "B" as its place among the classes' letters.
SweepInput road_classes(SweepInput input, const Value& value) {
  input.target = Target::RoadClass;
  input.unit = "1";
  input.meaning = "class of ISO 8608";
  input.distribution.kind = Distribution::Kind::OneOf;
  for (const Value& item : value.items()) {
    const std::string& letter = item.as_string();
    if (letter.size() != 1 || letter[0] < 'A' || letter[0] > 'H')
      throw Error(item.where(), "unknown class '" + letter + "' of roads", "A (smooth) to H");
    input.distribution.values.push_back(static_cast<double>(input.words.size()));
    input.words.push_back(letter);
  }
  if (input.words.empty()) throw Error(value.where(), "no class to choose from", "[B, C]");
  return input;
}

/// What the name means, and the row of its table.
ParameterRow find_target(SweepInput& input, const SweepRequest& request, const std::string& where) {
  const std::size_t dot = input.name.find('.');
  const std::string owner = input.name.substr(0, dot);
  input.parameter = dot == std::string::npos ? input.name : input.name.substr(dot + 1);
  const auto is = [&](Target target, const ParameterRow& row) {
    input.target = target;
    return row;
  };
  if (input.name == "current") return is(Target::Current, kCurrentRow);
  if (input.name == "lag_rate") return is(Target::LagRate, kLagRow);
  if (input.name == "road.seed") return is(Target::RoadSeed, kSeedRow);
  if (dot == std::string::npos)
    return is(Target::Plant, plant_row(request.controllers.front().words, input.name, where));
  if (owner == "damper") return is(Target::Damper, damper_row(input, request, where));
  if (owner == "road") {
    if (input.parameter == "speed" && first_word(request.road) == "measured")
      return is(Target::Road, kSpeedRow);
    const SequenceInfo& info = find_ground_sequence(first_word(request.road), where).info;
    return is(Target::Road, info.params[row_named(info.params, input.parameter, info.name, where)]);
  }
  const auto named = std::ranges::find(request.controllers, owner, &SweepController::name);
  if (named == request.controllers.end()) {
    std::vector<std::string> known{"road", "damper"};
    for (const SweepController& controller : request.controllers) known.push_back(controller.name);
    throw Error(where, "nothing here is called '" + owner + "'", suggest(owner, known));
  }
  input.controller = static_cast<std::size_t>(named - request.controllers.begin());
  return is(Target::Controller, controller_row(*named, input.parameter, where));
}

/// Mixes numbers so that any change of any gives others (splitmix64's last step).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  return Random(a ^ (b * 0x9e3779b97f4a7c15)).next();
}

std::uint64_t number_of(const std::string& name) {  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
  return hash;
}

/// In the middle of its cell of 2^53, so neither 0 nor 1.
double unit_interval(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1.0p-52;
}

/// Where every drawn input stands between 0 and 1. Each has random numbers of its own by its name,
/// so that one more does not move the others.
std::vector<double> drawn_shares(const SweepRequest& request, std::size_t sample) {
  std::vector<const SweepInput*> drawn;
  for (const SweepInput& input : request.inputs)
    if (!input.on_grid) drawn.push_back(&input);
  if (drawn.empty()) return {};
  std::vector<double> shares;
  if (request.drawing == SweepRequest::Drawing::Plain) {
    for (const SweepInput* input : drawn)
      shares.push_back(unit_interval(mixed(mixed(request.seed, sample), number_of(input->name))));
    return shares;
  }
  // Sobol's points, moved as a whole by the seed (a digital shift keeps how evenly they lie).
  boost::random::sobol points(drawn.size());
  points.seed(sample);
  for (const SweepInput* input : drawn)
    shares.push_back(unit_interval(points() ^ mixed(request.seed, number_of(input->name))));
  return shares;
}

std::string setting(const std::string& parameter, double value) {
  return parameter + '=' + format_exact(value);
}

/// A random road without a stated length is made as long as the ride, for the last axle too.
std::string with_length(const std::string& road, const SweepRequest& request) {
  constexpr double kLongestVehicle = 30;  // m
  const std::string name = first_word(road);
  if (!name.starts_with("iso8608") && name != "filtered_noise") return road;
  const SequenceInfo& info = find_ground_sequence(name).info;
  double speed = info.params[row_named(info.params, "speed", name, request.source)].value;
  for (const std::string& part : split(road, ',')) {
    const std::size_t equals = part.find('=');
    const std::string_view key = trim(std::string_view(part).substr(0, equals));
    if (key == "length") return road;
    if (key == "speed") speed = parse_quantity(part.substr(equals + 1), "m/s", request.source);
  }
  return road + ',' + setting("length", speed * request.duration + kLongestVehicle);
}

}  // namespace

SweepInput read_sweep_input(const std::string& name, const Value& value,
                            const SweepRequest& request, bool on_grid) {
  SweepInput input{.name = name};
  input.on_grid = on_grid;
  if (name == "road.class") return road_classes(std::move(input), value);
  const ParameterRow row = find_target(input, request, value.where());
  input.unit = row.unit;
  input.meaning = row.meaning;
  input.distribution = on_grid ? read_values(value, row) : read_distribution(value, row);
  return input;
}

std::string SweepInput::description() const {
  return words.empty() ? distribution.description(unit) : "one of " + join(words, ", ");
}

std::string SweepInput::text_of(double value) const {
  return words.empty() ? format_number(value) : words[static_cast<std::size_t>(value)];
}

bool SweepInput::is_told_to(const std::string& damper) const {
  return std::ranges::find(dampers, first_word(damper)) != dampers.end();
}

std::size_t SweepRequest::grid_size() const {
  std::size_t size = 1;
  for (const SweepInput& input : inputs)
    if (input.on_grid) size *= input.distribution.values.size();
  return size;
}

SweepDraw draw_vehicle(const SweepRequest& request, std::size_t vehicle) {
  const std::size_t places = request.grid_size(), sample = vehicle / places;
  std::size_t place = vehicle % places;
  SweepDraw draw{.vehicle = vehicle};
  draw.road_seed =
      request.road_seed.value_or(mixed(mixed(request.seed, sample), number_of("road")) >> 32);
  const std::vector<double> shares = drawn_shares(request, sample);
  auto share = shares.begin();
  for (const SweepInput& input : request.inputs) {
    const std::vector<double>& values = input.distribution.values;
    if (input.on_grid) {
      draw.values.push_back(values[place % values.size()]);
      place /= values.size();
    } else {
      draw.values.push_back(input.distribution.at(*share++));
    }
    if (input.target == Target::RoadSeed)
      draw.road_seed = static_cast<std::uint64_t>(draw.values.back());
  }
  return draw;
}

VehicleWords vehicle_words(const SweepRequest& request, std::size_t controller,
                           const SweepDraw& draw) {
  VehicleWords words = request.controllers[controller].words;
  for (std::size_t k = 0; k < request.inputs.size(); ++k) {
    const SweepInput& input = request.inputs[k];
    const std::string now = setting(input.parameter, draw.values[k]);
    switch (input.target) {
      case Target::Plant:
        words.values.push_back(now);
        break;
      case Target::Damper:  // of those that can be told; the last setting of a name counts
        for (std::string& damper : words.dampers)
          if (input.is_told_to(damper)) damper += ',' + now;
        break;
      case Target::Controller:
        if (input.controller == controller) words.controller += ',' + now;
        break;
      case Target::Current:
        words.current = draw.values[k];
        break;
      case Target::LagRate:
        words.lag_rate = draw.values[k];
        break;
      default:
        break;  // of the road
    }
  }
  words.sensors.seed = draw.road_seed;
  words.where = request.source + ", vehicle " + std::to_string(draw.vehicle);
  return words;
}

std::string road_words(const SweepRequest& request, const SweepDraw& draw) {
  std::string road = request.road;
  for (std::size_t k = 0; k < request.inputs.size(); ++k) {
    const SweepInput& input = request.inputs[k];
    if (input.target == Target::Road) road += ',' + setting(input.parameter, draw.values[k]);
    if (input.target == Target::RoadClass) road += ",class=" + input.text_of(draw.values[k]);
  }
  return with_length(road, request);
}

bool varies_dampers(const SweepRequest& request, std::size_t controller) {
  return std::ranges::any_of(request.inputs, [&](const SweepInput& input) {
    return input.target == Target::Current || input.target == Target::LagRate ||
           (input.target == Target::Damper &&
            std::ranges::any_of(
                request.controllers[controller].words.dampers,
                [&](const std::string& damper) { return input.is_told_to(damper); }));
  });
}

}  // namespace dashpot
