#include "dashpot/export/js/js.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/damper/force_band.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/js/js_code.h"

namespace dashpot {
namespace {

constexpr std::array<std::string_view, 3> kCalled{"damper_reset", "damper_advance", "damper_force"};
constexpr std::size_t kInputs = 3;  ///< displacement, velocity, current

/// A comment on how to use what follows; it has nothing from outside in it.
constexpr std::string_view kUse =
    R"(/* A damper's force, made by Dashpot from the C code of the model: see model.origin.
 *
 *   const state = create();                          // or create({alpha: 900}): see model.parameters
 *   reset(state, displacement, velocity, current);   // m, m/s, A or V: long at rest here
 *   force = step(state, displacement, velocity, current);          // N, model.sample_time later
 *   force = advance(state, displacement, velocity, current, dt);   // N, dt seconds later
 *
 * Extension is positive, and so is a force that resists it. Between two inputs motion and command
 * are taken as linear. A state is a Float64Array of yours; a copy of it is a snapshot. */
)";

/// The functions around the code: the caller's state goes into $ and comes out again.
constexpr std::string_view kInterface =
    R"(const take = (state, displacement, velocity, current) => {
  if (state.length !== model.state_size) throw new RangeError(`a state has ${model.state_size} numbers`);
  $.set(state, $model);
  $[$input] = displacement;
  $[$input + 1] = velocity;
  $[$input + 2] = current;
};
const give = (state) => {
  for (let k = 0; k < model.state_size; ++k) state[k] = $[$model + k];
};

function create(parameters = {}) {
  const state = new Float64Array(model.state_size);
  for (const {place, value} of model.parameters) state[place] = value;
  for (const [name, value] of Object.entries(parameters)) {
    const known = model.parameters.find((parameter) => parameter.name === name);
    if (!known) throw new RangeError(`${name} is no parameter of ${model.name}`);
    if (!Number.isFinite(value)) throw new RangeError(`${name} is ${value}, not a number`);
    state[known.place] = value;
  }
  reset(state, 0, 0, 0);
  return state;
}

function reset(state, displacement, velocity, current) {
  take(state, displacement, velocity, current);
  damper_reset($model, $input);
  give(state);
  return damper_force($input, $model + model.inputs.length);
}

function advance(state, displacement, velocity, current, dt) {
  take(state, displacement, velocity, current);
  const force = damper_advance($model, $input, dt);
  give(state);
  return force;
}

function step(state, displacement, velocity, current) {
  return advance(state, displacement, velocity, current, model.sample_time);
}

function force(state, displacement, velocity, current) {
  take(state, displacement, velocity, current);
  return damper_force($input, $model + model.inputs.length);
}
)";

/// Of a family by physics: what plate flow alone says of the same damper.
constexpr const char* kFlowInterface = R"(
function plate_flow(state, displacement, velocity, current) {
  take(state, displacement, velocity, current);
  return family_plate_flow($input, $model + model.inputs.length);
}
)";

Value input(const char* name, const std::string& unit, double low, double high) {
  return Value::object({{"name", name}, {"unit", unit}, {"low", low}, {"high", high}});
}

/// `first`: the place of the first parameter in a state. Those of a family have the range of the
/// dampers that it was fitted on.
Value parameters_of(const DamperModel& model, std::size_t first) {
  Value list = Value::array();
  const auto* family = model_as<FamilyModel>(model);
  for (const CParameter& one : c_parameters(model)) {
    Value parameter = Value::object({{"name", one.name},
                                     {"unit", one.unit},
                                     {"meaning", one.meaning},
                                     {"place", first + list.items().size()},
                                     {"value", one.value},
                                     {"lower", one.lower},
                                     {"upper", one.upper}});
    if (family)
      for (const Family::Range& range : family->family().domain)
        for (const MemberField& field : member_fields())
          if (field.field == range.field && field.name == one.name) {
            parameter.add("low", range.min);
            parameter.add("high", range.max);
          }
    list.push_back(std::move(parameter));
  }
  return list;
}

/// The band around the force; null where there is none, or where it takes the spread of networks,
/// which the code has not. `build_spread`: of the force of builds about its `offset`, N, as a
/// share.
Value interval_of(const ExportedModel& model) {
  if (!model.interval) return {};
  const auto* family = model_as<FamilyModel>(model.model);
  if (model.interval->spread > 0 && (!family || family->family().force->is_ensemble())) return {};
  Value band = to_json(*model.interval);
  if (family) {
    band.add("build_spread", family->family().build_spread);
    band.add("offset", family->offset());
  }
  return band;
}

Value about(const ExportedModel& model, const ExportOptions& options, std::size_t state_size) {
  const Domain& d = model.domain;
  Value value = Value::object(
      {{"name", model.model.name()},
       {"title", title_of(model.model)},
       {"kind", name_of(model.model.kind())},
       {"origin", model.origin},
       {"command", options.command},
       {"version", options.version},
       {"sample_time", export_sample_time(model, options)},
       {"state_size", kInputs + state_size},
       {"inputs",
        Value::array({input("displacement", "m", d.displacement_min, d.displacement_max),
                      input("velocity", "m/s", d.velocity_min, d.velocity_max),
                      input("current", unit_of(model.drive_unit), d.current_min, d.current_max)})},
       {"output", Value::object({{"name", "force"}, {"unit", "N"}})},
       {"interval", interval_of(model)},
       {"parameters", parameters_of(model.model, kInputs + model.model.state_size())}});
  if (const auto* family = model_as<FamilyModel>(model.model); family && has_settable(model.model))
    value.add("yield_curve",
              Value::object({{"currents", Value::array(family->member().yield.currents)},
                             {"stresses", Value::array(family->member().yield.stresses)}}));
  return value;
}

/// Definitions of all that js_program() names.
std::string definitions(const ExportedModel& model, const ExportOptions& options) {
  if (options.precision == CPrecision::Single)
    throw Error(model.model.name(), "cannot be JavaScript in single precision, which it has not",
                "--precision double");

  // Parameters stand behind the state, a law's with a lag rate even where there is none.
  const auto* law = model_as<LawModel>(model.model);
  const auto* family = model_as<FamilyModel>(model.model);
  const bool is_settable = has_settable(model.model);
  std::size_t size = model.model.state_size() + c_parameters(model.model).size();
  if (law && law->lag_rate() <= 0) ++size;
  size = std::max<std::size_t>(1, size);

  // The C code of write_c_source, of which damper_model is the last input and then the state.
  const bool has_flow = family && is_settable;
  const CProgram program =
      parse_c("#define DAMPER_STATE_SIZE " + std::to_string(size) +
              "\n#define DAMPER_SAMPLE_TIME " + c_number(export_sample_time(model, options)) +
              "\n" + std::string(c_text("damper_api.h")) + "\ntypedef damper_input DamperInput;\n" +
              with_texts(c_model(model.model, is_settable).code +
                         (has_flow ? c_family_plate_flow(*family) : "")) +
              std::string(c_text("damper_api.c")));
  std::vector<std::string_view> called(kCalled.begin(), kCalled.end());
  if (has_flow) called.push_back("family_plate_flow");
  const JsCode code = js_code(program, called, program.size_of_struct("damper_model") + kInputs);

  return "const model = " + js_value(about(model, options, size)).text() + ";\n" + code.text +
         "const $model = " + std::to_string(code.room) + ", $input = $model + model.state_size;\n" +
         std::string(kInterface) + (has_flow ? kFlowInterface : "");
}

std::string names_of(const DamperModel& model) {
  return std::string("{model, create, reset, step, advance, force") +
         (model_as<FamilyModel>(model) && has_settable(model) ? ", plate_flow}" : "}");
}

}  // namespace

JsText js_program(const ExportedModel& model, const ExportOptions& options) {
  return JsText::own("(() => {\n" + definitions(model, options) + "return " +
                     names_of(model.model) + ";\n})()");
}

std::vector<ExportedFile> write_js(const ExportedModel& model, const ExportOptions& options) {
  return {{export_name(model, options) + ".mjs", std::string(kUse) + definitions(model, options) +
                                                     "\nexport " + names_of(model.model) + ";\n"}};
}

}  // namespace dashpot
