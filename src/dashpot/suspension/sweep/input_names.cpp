#include "dashpot/suspension/sweep/input_names.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/error.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/ground/ground_sequences.h"

namespace dashpot {
namespace {

using Target = SweepInput::Target;

constexpr double kMostSeed = 4294967295.0;  // a double holds it, and so does every table
constexpr ParameterRow kSeedRow{"road.seed", "1", 1, 0, kMostSeed, "of the road's random numbers",
                                true};
constexpr ParameterRow kCurrentRow{"current", "A", 0, -100, 100, "where there is no controller"};
constexpr ParameterRow kLagRow{"lag_rate", "1/s", 0, 0, 1e6, "of the coil; 0: none"};
constexpr ParameterRow kSpeedRow{"speed", "m/s", 20, 0.1, 200, "of the vehicle"};

std::vector<ParameterRow> law_rows(const Law& law) {
  std::vector<ParameterRow> rows;
  for (const ParamInfo& param : law.params)
    rows.push_back({param.name, param.unit, param.value, param.lower, param.upper, param.meaning});
  return rows;
}

/// The parameters of the damper of these words.
std::vector<ParameterRow> damper_rows(const std::string& text) {
  const std::string name = first_word(text);
  std::vector<ParameterRow> rows;
  const auto simple = std::ranges::find(simple_dampers(), name, &SimpleDamper::name);
  const std::vector<std::string> sets = parameter_set_names();
  if (simple != simple_dampers().end())
    rows = simple->parameters;
  else if (std::ranges::find(sets, name) != sets.end())
    rows = law_rows(load_parameter_set(name).model.law());

  // Each damper can be mounted in its own way.
  rows.insert(rows.end(), mounting_settings().begin(), mounting_settings().end());
  return rows;
}

/// The row of that parameter. Notes in `input` which dampers have it.
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

  // No damper has it: say which parameters there are.
  if (known.empty())
    throw Error(where,
                "the dampers are those of the plant, which have no parameter '" + parameter + "'",
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

/// Classes by their letters; the value of "B" is its place in the list.
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

/// Finds what the input's name means. Returns the row of its table.
ParameterRow find_target(SweepInput& input, const SweepRequest& request, const std::string& where) {
  const std::size_t dot = input.name.find('.');
  const std::string owner = input.name.substr(0, dot);
  input.parameter = dot == std::string::npos ? input.name : input.name.substr(dot + 1);
  const auto is = [&](Target target, const ParameterRow& row) {
    input.target = target;
    return row;
  };

  // Names of their own, then parameters of the plant, of dampers and of the road.
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

  // A controller's.
  const auto named = std::ranges::find(request.controllers, owner, &SweepController::name);
  if (named == request.controllers.end()) {
    std::vector<std::string> known{"road", "damper"};
    for (const SweepController& controller : request.controllers) known.push_back(controller.name);
    throw Error(where, "nothing here is called '" + owner + "'", suggest(owner, known));
  }
  input.controller = static_cast<std::size_t>(named - request.controllers.begin());
  return is(Target::Controller, controller_row(*named, input.parameter, where));
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

}  // namespace dashpot
