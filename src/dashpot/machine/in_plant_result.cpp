#include "dashpot/machine/in_plant_result.h"

#include <numeric>

#include "dashpot/base/any_number.h"
#include "dashpot/machine/found_noise.h"

namespace dashpot {
namespace {

Value value_of(const FittedParameter& p) {
  Value value = Value::object({{"name", p.name}, {"unit", p.unit}, {"value", any_number(p.value)}});
  if (has_interval(p)) {
    value.add("low", any_number(p.low));
    value.add("high", any_number(p.high));
  }
  value.add("fixed", p.fixed);
  value.add("at_bound", p.at_bound);
  value.add("weak", p.weak);
  return value;
}

Value value_of(const SensorFigures& s) {
  return Value::object({{"recording", s.recording},
                        {"sensor", s.channel},
                        {"unit", s.unit},
                        {"rms", s.rms},
                        {"error_fitted", s.training},
                        {"error_held_back", s.held_back},
                        {"offset", s.offset}});
}

Value value_of(const FoundNoise& one) {
  Value value = Value::object({{"channel", one.channel}, {"unit", one.unit}});
  value.add("deviation", one.deviation > 0 ? Value(one.deviation) : Value());
  value.add("zero", one.zero);
  return value;
}

template <class T>
Value values_of(const std::vector<T>& all) {
  Value list = Value::array();
  for (const T& one : all) list.push_back(value_of(one));
  return list;
}

double mean_half(const ObservedQuantity& q) {
  return std::accumulate(q.half.begin(), q.half.end(), 0.0) / static_cast<double>(q.half.size());
}

Value additions_json(const std::vector<PlantAddition>& additions) {
  Value list = Value::array();
  for (const PlantAddition& one : additions)
    list.push_back(Value::object({{"what", one.what},
                                  {"intervals_times", one.intervals},
                                  {"most", one.most},
                                  {"most_times", one.of_most}}));
  return list;
}

}  // namespace

Value to_json(const PlantAdvice& advice) {
  Value profiles = Value::array();
  for (const ParameterProfile& one : advice.profiles)
    profiles.push_back(Value::object({{"name", one.name},
                                      {"unit", one.unit},
                                      {"value", Value::array(one.value)},
                                      {"misfit", Value::array(one.misfit)},
                                      {"low", any_number(one.low)},
                                      {"high", any_number(one.high)}}));
  return Value::object({{"grade", advice.grade},
                        {"worst", advice.worst},
                        {"sensors", additions_json(advice.sensors)},
                        {"recordings", additions_json(advice.rides)},
                        {"profiles", std::move(profiles)}});
}

Value to_json(const InPlantReport& r, const std::string& law) {
  Value confounded = Value::array();
  for (const auto& group : r.knowable.confounded) confounded.push_back(Value::array(group));

  Value told = Value::object({{"law", law},
                              {"converged", r.status == FitReport::Status::Converged},
                              {"message", r.message},
                              {"iterations", r.iterations},
                              {"cpu_seconds", r.seconds},
                              {"steps_per_sample", r.steps},
                              {"step_error", r.step_error},
                              {"plant", values_of(r.plant)},
                              {"plant_beside_any_force", values_of(r.plant_beside_any_force)},
                              {"damper", values_of(r.damper)},
                              {"nuisances", values_of(r.nuisances)},
                              {"noise_found", values_of(r.noise)},
                              {"singular_values", Value::array(r.knowable.singular_values)},
                              {"without_effect", Value::array(r.knowable.without_effect)},
                              {"confounded", std::move(confounded)},
                              {"sensors", values_of(r.sensors)},
                              {"advice", to_json(r.advice)},
                              {"warnings", Value::array(r.warnings)}});
  if (!r.along.empty()) told.add("along", r.along);
  if (!r.road_measured && r.has_models()) told.add("force_error", r.force_error);
  if (!r.lacks.empty()) told.add("lacks", r.lacks);
  return told;
}

ModelFile found_damper(const FoundDamper& damper, const InPlantReport& report,
                       const InPlantSetup& setup, double sample_time) {
  ModelFile file;
  file.model = damper.model->with_offset(0);
  file.drive_unit = setup.drive_unit;
  file.sample_time = sample_time;
  file.domain = damper.domain;
  file.dissipation = dissipation(*file.model, file.domain);
  file.noise_found = told_noise(report);
  return file;
}

Value to_json(const PlantEvaluation& evaluation, const InPlantSetup& setup) {
  Value sensors = Value::array();
  for (const SensorFigures& s : evaluation.sensors)
    sensors.push_back(Value::object({{"recording", s.recording},
                                     {"sensor", s.channel},
                                     {"unit", s.unit},
                                     {"rms", s.rms},
                                     {"error", any_number(s.training)},
                                     {"offset", any_number(s.offset)}}));
  return Value::object({{"plant", setup.model->name},
                        {"sensors", std::move(sensors)},
                        {"steps_per_sample", evaluation.steps},
                        {"step_error", any_number(evaluation.step_error)},
                        {"warnings", Value::array(evaluation.warnings)}});
}

Record run_of(const InPlantTrace& trace, const InPlantSetup& setup) {
  Record record;
  record.name = trace.recording;
  record.sample_time = trace.sample_time;
  for (std::size_t k = 0; k < trace.measured.front().size(); ++k)
    record.time.push_back(trace.sample_time * static_cast<double>(k));
  const auto add = [&](std::string name, std::string unit, const std::vector<double>& samples) {
    record.channels.push_back(
        {.name = std::move(name), .unit = std::move(unit), .samples = samples, .origin = {}});
  };

  // The sensors, then what no sensor shows.
  const Plant plant = make_plant(*setup.model, setup.known);
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const PlantSensor& sensor = setup.sensors[s];
    const std::string unit = unit_of(sensor.place, plant);
    add(sensor.channel, unit, trace.measured[s]);
    add(sensor.channel + "_modelled", unit, trace.modelled[s]);
  }
  for (const DamperTrace& damper : trace.dampers) {
    const std::string own = trace.dampers.size() > 1 ? damper.strut + "_damper_" : "damper_";
    add(own + "force", "N", damper.force);
    add(own + "deflection", "m", damper.deflection);
    add(own + "velocity", "m/s", damper.velocity);
  }
  return record;
}

Value to_json(const ObserveReport& report, const InPlantSetup& setup) {
  Value recordings = Value::array(), errors = Value::array(), origins = Value::array();

  // What was found of each recording.
  for (const ObservedRecording& one : report.recordings) {
    Value sensors = Value::array(), quantities = Value::array();
    for (const ObservedSensor& s : one.sensors)
      sensors.push_back(Value::object({{"sensor", s.channel},
                                       {"unit", s.unit},
                                       {"rms", s.rms},
                                       {"unexpected", s.surprise},
                                       {"inside", s.inside},
                                       {"offset", s.offset}}));
    for (const ObservedQuantity& q : one.quantities)
      quantities.push_back(
          Value::object({{"name", q.name}, {"unit", q.unit}, {"half_band_mean", mean_half(q)}}));
    recordings.push_back(Value::object({{"name", one.name},
                                        {"quantities", std::move(quantities)},
                                        {"sensors", std::move(sensors)}}));
  }

  // What was taken as uncertain.
  const VelocityShift& shift = report.noise.shift;
  for (const ForceError& one : report.noise.force)
    errors.push_back(Value::object({{"deviation_N", one.deviation}, {"memory_s", one.memory}}));
  for (const PlantSensor& sensor : setup.sensors)
    origins.push_back(!(sensor.noise > 0)              ? "found in these recordings"
                      : sensor.identified.from.empty() ? "stated"
                                                       : sensor.identified.from);
  return Value::object({{"plant", setup.model->name},
                        {"force_errors", std::move(errors)},
                        {"velocity_shift", Value::object({{"deviation_m_s", shift.deviation},
                                                          {"memory_s", shift.memory}})},
                        {"sensor_noise", Value::array(report.noise.sensors)},
                        {"sensor_noise_from", std::move(origins)},
                        {"roughness_m3", report.noise.roughness},
                        {"forces_known_within", report.forces_known_within},
                        {"steps_per_sample", report.steps},
                        {"cpu_seconds", report.seconds},
                        {"recordings", std::move(recordings)},
                        {"warnings", Value::array(report.warnings)}});
}

Record estimates_of(const ObservedRecording& observed) {
  Record record;
  record.name = observed.name;
  record.sample_time = observed.sample_time;
  for (std::size_t k = 0; k < observed.quantities.front().value.size(); ++k)
    record.time.push_back(observed.sample_time * static_cast<double>(k));
  for (const ObservedQuantity& q : observed.quantities) {
    record.channels.push_back({.name = q.name, .unit = q.unit, .samples = q.value, .origin = {}});
    record.channels.push_back(
        {.name = q.name + "_half_band", .unit = q.unit, .samples = q.half, .origin = {}});
  }
  return record;
}

}  // namespace dashpot
