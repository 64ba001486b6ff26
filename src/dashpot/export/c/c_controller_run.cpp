#include "dashpot/export/c/c_controller_run.h"

#include <algorithm>
#include <cmath>

#include "dashpot/export/export_run.h"
#include "dashpot/suspension/control/sensors.h"
#include "dashpot/suspension/dampers/damper_state.h"

namespace dashpot {
namespace {

/// The true signals at a strut, sample by sample, from a seed.
std::vector<StrutSignals> strut_run(const ControlLimits& limits, std::size_t count,
                                    std::uint64_t seed) {
  constexpr double kForce = 1500;  // N
  constexpr double kFastest = 30;  // Hz
  const Domain body{-0.05, 0.05, -0.5, 0.5, -kForce, kForce},
      strut{-0.03, 0.03, -0.8, 0.8, limits.current_min, limits.current_max};

  // Two independent motions: of the body, and of the strut between body and wheel.
  const std::vector<DamperInput> up = export_run(body, limits.sample_time, count + 1,
                                                 {seed, kFastest}),
                                 stretch = export_run(strut, limits.sample_time, count,
                                                      {seed + 1, kFastest});
  std::vector<StrutSignals> run;
  for (std::size_t k = 0; k < count; ++k)
    run.push_back({.body_velocity = up[k].velocity,
                   .body_acceleration = (up[k + 1].velocity - up[k].velocity) / limits.sample_time,
                   .wheel_velocity = up[k].velocity - stretch[k].velocity,
                   .deflection = stretch[k].displacement,
                   .deflection_velocity = stretch[k].velocity,
                   .force = up[k].current,
                   .current = stretch[k].current});
  return run;
}

/// The plant's state, sample by sample: all its heights, then all their rates.
std::vector<std::vector<double>> state_run(std::size_t states, double sample_time,
                                           std::size_t count) {
  std::vector<std::vector<double>> run(count, std::vector<double>(states));
  for (std::size_t q = 0; q < states / 2; ++q) {
    const auto motion =
        export_run({-0.05, 0.05, -0.5, 0.5, 0, 1}, sample_time, count, {1000 + q, 30});
    for (std::size_t k = 0; k < count; ++k) {
      run[k][q] = motion[k].displacement;
      run[k][states / 2 + q] = motion[k].velocity;
    }
  }
  return run;
}

/// The sensors of the vehicle without noise: their filters alone.
SensorOptions quiet(SensorOptions sensors) {
  sensors.acceleration_noise = sensors.acceleration_resolution = 0;
  sensors.deflection_noise = sensors.deflection_resolution = sensors.delay = 0;
  return sensors;
}

}  // namespace

std::vector<CBlock::Sample> controller_run(const Vehicle& vehicle, const CControlPath& path,
                                           std::size_t count) {
  // A run per strut, and the library's way from its demands to its commands.
  const std::size_t struts = vehicle.dampers.size();
  const ControlLimits& limits = vehicle.limits;
  std::vector<std::vector<StrutSignals>> runs;
  std::vector<MountedDamper> dampers = vehicle.dampers;
  for (std::size_t k = 0; k < struts; ++k) {
    runs.push_back(strut_run(limits, count, 100 * (k + 1)));
    dampers[k].current = runs[k][0].current;
  }
  std::vector<CommandPath> commands;
  for (std::size_t k = 0; k < struts; ++k)
    commands.emplace_back(dampers[k], limits, runs[k][0].deflection);
  const auto states = state_run(path.plant_states, limits.sample_time, count);
  Sensors sensors(quiet(vehicle.sensors), struts, limits.sample_time);
  std::vector<double> state(vehicle.controller->state_size());
  vehicle.controller->reset(state);

  std::vector<CBlock::Sample> samples(count);
  std::vector<StrutSignals> seen(struts);
  std::vector<DamperDemand> demands(struts);
  for (std::size_t k = 0; k < count; ++k) {
    // The inputs at the sample, in the order of the ports.
    auto& [inputs, given, matters] = samples[k];
    for (std::size_t s = 0; s < struts; ++s) seen[s] = runs[s][k];
    for (const StrutSignal* signal : path.measured)
      for (const StrutSignals& strut : seen) inputs.push_back(strut.*signal->value);
    inputs.insert(inputs.end(), states[k].begin(), states[k].end());

    // The library's own way: sensors, demands, commands within their limits.
    sensors.measure(seen);
    vehicle.controller->step(seen, states[k], state, demands);
    for (std::size_t s = 0; s < struts; ++s) {
      const DamperInput now{seen[s].deflection, seen[s].deflection_velocity, seen[s].current};
      given.push_back(std::clamp(commands[s].command(demands[s], now, seen[s].force),
                                 limits.current_min, limits.current_max));
    }
  }
  return samples;
}

}  // namespace dashpot
