#include "dashpot/export/c/c_observer.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

constexpr std::size_t kObserverTestSteps = 100;

constexpr const char* kObserverHeader = R"(/* @title@
 *
 * @about@
 *
 *   damper_model model;
 *   damper_init(&model);
 *   for (;;) damper_step(&model, &input, outputs);
 *
 * Inputs: @inputs@
 * Drives: @drives@
 * Sensors: @sensors@
 * Outputs: @outputs@
 *
 * C99 with math.h: no heap, no files, no variables outside a damper_model.
 * Made by Dashpot @version@:
 *   @command@
 * MISRA C:2012, deviations: @deviations@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_INPUTS @input_count@
#define DAMPER_SENSORS @sensor_count@
#define DAMPER_OUTPUTS @output_count@
#define DAMPER_DRIVES @drive_count@ /* of the dampers: one of all, or one each */
#define DAMPER_STATE_SIZE @size@
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, between two calls of damper_step */

)";

constexpr const char* kObserverBegin = R"(#include "@prefix@.h"

#include <math.h>

typedef struct DamperInput {
  double displacement, velocity, current;
} DamperInput;

)";

/// What comes out, with its units and what counts as large.
struct Outputs {
  std::vector<CPort> ports;
  std::vector<double> scales;

  void add(const std::string& name, const std::string& unit, const std::string& meaning,
           double scale) {
    ports.push_back({name, unit, meaning, "commands[" + std::to_string(ports.size()) + "]"});
    scales.push_back(scale);
  }
};

Outputs outputs_of(const PlantObserver& observer, const ObserverNames& names) {
  constexpr double kPerDifference = 1000;  // the steps of differences are a thousandth
  const ObserverTables& t = observer.tables();
  const double force = kPerDifference * t.difference[static_cast<std::size_t>(t.plant + t.roads)];
  Outputs outputs;
  for (const std::string& strut : names.struts) {
    const std::string whose = names.struts.size() > 1 ? strut + "_" : "";
    outputs.add(whose + "damper_force", "N",
                "force of the damper, positive when it resists extension", force);
    outputs.add(whose + "damper_force_deviation", "N", "standard deviation of that", force);
    outputs.add(whose + "damper_deflection", "m", "of the damper, extension positive",
                kPerDifference * t.way);
    outputs.add(whose + "damper_velocity", "m/s", "of the damper, extension positive",
                kPerDifference * t.speed);
  }
  for (std::size_t k = 0; k < names.states.size(); ++k)
    outputs.add("state_" + names.states[k], names.state_units[k], "of the plant",
                kPerDifference * t.difference[k]);
  return outputs;
}

/// The tables of the filter and the struct of them.
std::string filter_code(const ObserverTables& t) {
  const std::pair<const char*, const std::vector<double>*> tables[] = {
      {"kErrorKeep", &t.error_keep},     {"kTransition", &t.transition},
      {"kByStart", &t.by_start},         {"kByEnd", &t.by_end},
      {"kDeflection", &t.deflection},    {"kOnGround", &t.on_ground},
      {"kSensorPlant", &t.sensor_plant}, {"kSensorInput", &t.sensor_input},
      {"kSensorSlope", &t.sensor_slope}, {"kSensorRoad", &t.sensor_road},
      {"kSensorForce", &t.sensor_force}, {"kSensorVariance", &t.sensor_variance},
      {"kProcess", &t.process},          {"kDifference", &t.difference}};
  std::string code, places;
  for (const auto& [name, values] : tables) {
    code += c_table(name, *values);
    places += std::string(", ") + name;
  }
  code += c_table("kFirstDeviation", t.first_deviation);

  // The struct, in its own order.
  std::string sizes, own;
  for (const int size :
       {t.plant, t.inputs, t.drives, t.roads, t.dampers, t.errors, t.shifts, t.sensors, t.steps})
    sizes += std::to_string(size) + ", ";
  for (const auto& [name, of_dampers] :
       {std::pair{"kDamper", &t.damper}, std::pair{"kMemory", &t.memory},
        std::pair{"kByWay", &t.by_way}}) {
    std::string row;
    for (const int size : *of_dampers) row += (row.empty() ? "" : ", ") + std::to_string(size);
    own += std::string("static const int ") + name + "[] = {" + row + "};\n";
  }
  return code + own + "\nstatic const PlantFilter kFilter = {" + sizes + c_number(t.step) + ", " +
         c_number(t.road_keep) + ", kDamper, kMemory, kByWay" + places + ", " + c_number(t.way) +
         ", " + c_number(t.speed) + ", " + c_number(t.shift_added) + "};\n\n";
}

/// A run of signals that are large beside the sensors' noise, and what the library makes of it.
std::vector<CBlock::Sample> observer_run(const PlantObserver& observer,
                                         const ObserverNames& names) {
  constexpr double kLoud = 10;
  const ObserverTables& t = observer.tables();
  const auto inputs = static_cast<std::size_t>(t.inputs), sensors = names.sensors.size();
  const double force = 1000 * t.difference[static_cast<std::size_t>(t.plant + t.roads)];
  std::vector<CBlock::Sample> samples;
  std::vector<double> estimate(t.kept()), covariance(t.all() * t.all()), before;
  ObservedSample told;
  for (std::size_t k = 0; k < kObserverTestSteps; ++k) {
    const double place = static_cast<double>(k);

    // Inputs, the drives behind them, and sensors: sines.
    std::vector<double> now, measured;
    for (std::size_t u = 0; u < inputs; ++u)
      now.push_back((names.input_units[u] == "m"   ? 200 * t.way
                     : names.input_units[u] == "N" ? 0.2 * force
                                                   : 1) *
                    std::sin((0.05 + 0.02 * static_cast<double>(u)) * place));
    for (int d = 0; d < t.drives; ++d)
      now.push_back(0.5 + 0.5 * std::sin((0.02 + 0.01 * d) * place));
    for (std::size_t s = 0; s < sensors; ++s)
      measured.push_back(kLoud * std::sqrt(t.sensor_variance[s]) *
                         std::sin((0.06 + 0.03 * static_cast<double>(s)) * place));

    // The library's step, and what it tells.
    if (k == 0)
      observer.start(now, measured, {}, estimate, covariance, told);
    else
      observer.step(before, now, measured, estimate, covariance, told);
    CBlock::Sample sample{.inputs = now, .commands = {}};
    if (inputs == 0) sample.inputs.insert(sample.inputs.begin(), 0.0);
    sample.inputs.insert(sample.inputs.end(), measured.begin(), measured.end());
    for (std::size_t d = 0; d < names.struts.size(); ++d) {
      const PlantObserver::Damper damper =
          observer.damper_at(d, k == 0 ? now : before, now, {estimate, covariance});
      sample.commands.insert(sample.commands.end(),
                             {damper.force, damper.deviation, damper.deflection, damper.velocity});
    }
    sample.commands.insert(sample.commands.end(), estimate.begin(),
                           estimate.begin() + t.plant + t.roads);
    samples.push_back(std::move(sample));
    before = now;
  }
  return samples;
}

std::string listed(const std::vector<std::string>& names, const std::vector<std::string>& units) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k > 0 ? ", " : "") + names[k] + " (" + units[k] + ")";
  return text.empty() ? "none; one place that is not used" : text;
}

}  // namespace

CBlock c_observer_block(const PlantObserver& observer, const ObserverNames& names,
                        const std::string& origin, const ExportOptions& options) {
  const ObserverTables& t = observer.tables();
  const DamperModel& damper = *observer.dampers().front();
  const auto* law = model_as<LawModel>(damper);
  const std::string stem = law ? "observed" : "model";
  const std::size_t all = t.all(), inputs = std::max<std::size_t>(1, names.inputs.size()),
                    size = t.kept() + all * all + static_cast<std::size_t>(t.inputs + t.drives);
  const Outputs outputs = outputs_of(observer, names);
  const std::string unit = to_string(names.drive_unit),
                    title = "Observer of a " + names.plant + " with the damper " + names.damper +
                            (t.dampers > 1 ? " in each strut" : "");
  const std::string about =
      "From what is measured at each sample: the damper's force and motion and the plant's state, "
      "as the past allows. It begins in a plant that stands. Everything is in SI. An extended "
      "Kalman filter of " +
      std::to_string(all) + " numbers, " + std::to_string(t.steps) + " steps per sample." +
      (origin.empty() ? "" : ' ' + origin);
  std::vector<std::string> output_names, output_units;
  for (const CPort& port : outputs.ports) {
    output_names.push_back(port.name);
    output_units.push_back(port.unit);
  }

  const std::vector<std::string> of_struts(names.struts.size(), unit);

  // The header and the facts in it.
  const auto number = [](std::size_t count) { return CText::own(std::to_string(count)); };
  const std::vector<std::pair<std::string, CText>> values{
      {"title", c_comment(title)},
      {"about", c_comment(about)},
      {"inputs", c_comment(listed(names.inputs, names.input_units))},
      {"drives", c_comment(t.drives > 1 ? listed(names.struts, of_struts)
                                        : "of every damper (" + unit + ")")},
      {"sensors", c_comment(listed(names.sensors, names.sensor_units))},
      {"outputs", c_comment(listed(output_names, output_units))},
      {"version", c_comment(options.version)},
      {"deviations", CText::own(std::string(c_deviations()))},
      {"input_count", number(inputs)},
      {"sensor_count", number(names.sensors.size())},
      {"output_count", number(outputs.ports.size())},
      {"drive_count", number(static_cast<std::size_t>(t.drives))},
      {"size", number(size)},
      {"sample_time", CText::own(c_number(t.step * t.steps))}};

  // The source: the damper's model, the filter, its tables, the interface.
  const std::string sizes = filled(
      "#define OBSERVED_REST @stem@_rest\n#define OBSERVED_ADVANCE @stem@_advance\n"
      "#define OBSERVED_FORCE @stem@_force\n#define FILTER_MOST @all@\n"
      "#define FILTER_MOST_SENSORS @sensors@\n#define FILTER_MOST_INPUTS @inputs@\n"
      "#define FILTER_MOST_DAMPERS @dampers@\n#define FILTER_MOST_DAMPER @damper@\n"
      "#define FILTER_MOST_MEMORY @memory@\n#define FILTER_KEPT @kept@\n\n",
      {{"stem", CText::own(stem)},
       {"all", number(all)},
       {"sensors", number(names.sensors.size())},
       {"inputs", number(inputs)},
       {"dampers", number(names.struts.size())},
       {"damper", number(static_cast<std::size_t>(std::max(1, t.damper.front())))},
       {"memory", number(static_cast<std::size_t>(t.memory.front()))},
       {"kept", number(t.kept())}});
  const std::string code = (law ? c_law(*law, stem) : c_model(damper)).code;

  // The interface port by port, and the run that checks it.
  std::vector<CPort> ports = {
      {"input", "", "what moves the plant: " + listed(names.inputs, names.input_units), "inputs[#]",
       inputs},
      {"drive", unit, t.dampers > 1 ? "of the dampers" : "of the damper", "drives[#]",
       static_cast<std::size_t>(t.drives)},
      {"sensor", "", "what is measured: " + listed(names.sensors, names.sensor_units), "sensors[#]",
       names.sensors.size()}};
  const auto parts = [](const std::vector<std::string>& of, const std::vector<std::string>& units) {
    std::vector<CPort::Part> all_parts;
    for (std::size_t k = 0; k < of.size(); ++k) all_parts.push_back({of[k], units[k]});
    return all_parts;
  };
  ports[0].parts = names.inputs.empty() ? std::vector<CPort::Part>{{"none", ""}}
                                        : parts(names.inputs, names.input_units);
  if (t.drives > 1) ports[1].parts = parts(names.struts, of_struts);
  ports[2].parts = parts(names.sensors, names.sensor_units);
  return {.name = c_name(options.name.empty() ? names.damper + "_observer" : options.name),
          .title = title,
          .about = about,
          .precision = options.c_precision(),
          .header =
              filled(kObserverHeader + std::string(c_text("observer_api.h")) + kCHeaderEnd, values),
          .source = kObserverBegin +
                    with_texts(code + sizes + "#include \"plant_filter.h\"\n" + filter_code(t)) +
                    std::string(c_text("observer_api.c")),
          .step = "damper_step(&model, &input, commands);",
          .inputs = std::move(ports),
          .commands = outputs.ports,
          .state_size = size,
          .sample_time = t.step * t.steps,
          .range = 1,
          .tolerance = options.c_precision() == CPrecision::Double ? 1e-9 : 1e-3,
          .samples = observer_run(observer, names),
          .scales = outputs.scales,
          .version = options.version};
}

}  // namespace dashpot
