#include "dashpot/machine/observer_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

constexpr double kLongestWave = 0.01;  // cycle/m, below which a road counts as level
constexpr std::size_t kParts = 8;      // of a sample, in each of which chance goes straight

/// The inputs as a filter has them: those measured, then those that are not.
std::vector<PlantInputChannel> in_order(const InPlantSetup& setup) {
  std::vector<PlantInputChannel> inputs = setup.inputs;
  std::ranges::stable_partition(inputs, [](const PlantInputChannel& one) { return !one.road; });
  return inputs;
}

/// q and q' over one step under inputs that go straight: p' = A p + B u + R u'.
struct StepMatrices {
  std::vector<double> transition, by_start, by_end;
};

StepMatrices step_matrices(const DrivenPlant& plant, std::size_t acting, double h) {
  // One exponential of A with B and R beside it, and a ramp behind these.
  const std::size_t n = plant.size(), p = 2 * n, whole = p + 3 * acting,
                    inputs = acting - plant.dampers().size();
  std::vector<double> block(whole * whole);
  for (std::size_t i = 0; i < n; ++i) {
    double* row = &block[(n + i) * whole];
    block[i * whole + n + i] = h;
    for (std::size_t k = 0; k < n; ++k) {
      row[k] = -h * plant.stiffness()[i * n + k];
      row[n + k] = -h * plant.damping()[i * n + k];
    }
    for (std::size_t u = 0; u < inputs; ++u) {
      row[p + u] = h * plant.by_value()[u][i];
      row[p + 2 * acting + u] = h * plant.by_rate()[u][i];
    }
    for (std::size_t d = 0; d < plant.dampers().size(); ++d)
      row[p + inputs + d] = -h * plant.dampers()[d].by_force[i];
  }
  for (std::size_t u = 0; u < acting; ++u) block[(p + u) * whole + p + acting + u] = h;
  const std::vector<double> over = exponential(block, whole);

  // Of a value at the end: a ramp of height 1, with its rate; of one at the start: the rest.
  StepMatrices m{std::vector<double>(p * p), std::vector<double>(p * acting),
                 std::vector<double>(p * acting)};
  for (std::size_t i = 0; i < p; ++i) {
    std::copy_n(&over[i * whole], p, &m.transition[i * p]);
    for (std::size_t u = 0; u < acting; ++u) {
      const double constant = over[i * whole + p + u], ramp = over[i * whole + p + acting + u] / h,
                   rate = over[i * whole + p + 2 * acting + u] / h;
      m.by_start[i * acting + u] = constant - ramp - rate;
      m.by_end[i * acting + u] = ramp + rate;
    }
  }
  return m;
}

/// Whether small changes of a damper's state are followed; else it is carried along its motion.
bool is_estimated(const DamperModel& damper) {
  return damper.flows() && damper.state_size() <= kMostObservedDamper;
}

/// How large the numbers of the dampers' states are that are estimated.
std::vector<double> estimated_scale(const std::vector<std::shared_ptr<const DamperModel>>& dampers,
                                    const ObserverScale& scale) {
  std::vector<double> sizes;
  auto own = scale.state.begin();
  for (const auto& damper : dampers) {
    const auto end = own + static_cast<std::ptrdiff_t>(damper->state_size());
    if (is_estimated(*damper)) sizes.insert(sizes.end(), own, end);
    own = end;
  }
  return sizes;
}

/// The plant's state, 0 at first, behind steps over which one input went straight from each of
/// these values to the next.
std::vector<double> response_to(const StepMatrices& m, std::size_t p, std::size_t acting,
                                std::size_t input, std::span<const double> values) {
  std::vector<double> state(p), next(p);
  for (std::size_t step = 0; step + 1 < values.size(); ++step) {
    for (std::size_t i = 0; i < p; ++i) {
      next[i] = m.by_start[i * acting + input] * values[step] +
                m.by_end[i * acting + input] * values[step + 1];
      for (std::size_t k = 0; k < p; ++k) next[i] += m.transition[i * p + k] * state[k];
    }
    state = next;
  }
  return state;
}

/// What each sensor shows, as rows over the plant's state, inputs, their rates, roads and the
/// forces. `input_variance`: of what the inputs' sensors show beyond these.
void add_sensors(const DrivenPlant& plant, const InPlantSetup& setup, const ObserverNoise& noise,
                 double road_rate_variance, std::span<const double> input_variance,
                 ObserverTables& t) {
  const std::size_t n = plant.size(), p = 2 * n, inputs = static_cast<std::size_t>(t.inputs),
                    roads = static_cast<std::size_t>(t.roads), sensors = setup.sensors.size(),
                    dampers = plant.dampers().size();
  t.sensor_plant.resize(sensors * p);
  t.sensor_input.resize(sensors * inputs);
  t.sensor_slope.resize(sensors * inputs);
  t.sensor_road.resize(sensors * roads);
  t.sensor_force.resize(sensors * dampers);
  for (std::size_t s = 0; s < sensors; ++s) {
    const PlantQuantity quantity = setup.sensors[s].place.quantity;
    const std::size_t q = setup.sensors[s].place.coordinate, strut = setup.sensors[s].place.strut;
    double* state = &t.sensor_plant[s * p];
    t.sensor_variance.push_back(noise.sensors[s] * noise.sensors[s]);
    switch (quantity) {
      case PlantQuantity::Displacement:
        state[q] = 1;
        break;
      case PlantQuantity::Velocity:
        state[n + q] = 1;
        break;
      case PlantQuantity::Acceleration:
        for (std::size_t k = 0; k < n; ++k) {
          state[k] = -plant.stiffness()[q * n + k];
          state[n + k] = -plant.damping()[q * n + k];
        }
        for (std::size_t u = 0; u < inputs; ++u) {
          t.sensor_input[s * inputs + u] = plant.by_value()[u][q] + plant.carried()[u][q];
          t.sensor_slope[s * inputs + u] = plant.by_rate()[u][q];
        }

        // The rate of a road that is not known is noise to a tyre with damping.
        for (std::size_t r = 0; r < roads; ++r) {
          t.sensor_road[s * roads + r] = plant.by_value()[inputs + r][q];
          t.sensor_variance.back() +=
              std::pow(plant.by_rate()[inputs + r][q], 2) * road_rate_variance;
        }
        for (std::size_t d = 0; d < dampers; ++d)
          t.sensor_force[s * dampers + d] = -plant.dampers()[d].by_force[q];
        break;
      case PlantQuantity::Deflection:
      case PlantQuantity::DeflectionVelocity: {
        const bool is_rate = quantity == PlantQuantity::DeflectionVelocity;
        const DamperPlace& place = plant.dampers()[strut];
        for (std::size_t k = 0; k < n; ++k) state[(is_rate ? n : 0) + k] = place.row[k];
        for (std::size_t u = 0; u < inputs; ++u)
          (is_rate ? t.sensor_slope : t.sensor_input)[s * inputs + u] = -place.on_ground[u];
        break;
      }
      case PlantQuantity::DamperForce:
        t.sensor_force[s * dampers + strut] = 1;
        break;
    }

    // What the sensors of inputs show beyond these, this sensor does not: value and rate of a
    // sample's noise.
    const double rate = 1 / (t.step * t.steps);
    for (std::size_t u = 0; u < inputs; ++u) {
      const double by_value = t.sensor_input[s * inputs + u],
                   by_rate = t.sensor_slope[s * inputs + u] * rate;
      t.sensor_variance.back() +=
          (std::pow(by_value + by_rate, 2) + by_rate * by_rate) * input_variance[u];
    }
  }
}

}  // namespace

std::vector<std::string> measured_inputs(const InPlantSetup& setup) {
  std::vector<std::string> channels;
  for (const PlantInputChannel& input : in_order(setup))
    if (!input.road) channels.push_back(input.channel);
  return channels;
}

ObserverScale observer_scale(const DamperModel& damper, const Domain& of_data) {
  const bool says_motion = of_data.velocity_max > of_data.velocity_min;
  const Domain domain =
      says_motion ? of_data : usual_domain(of_data.current_min, of_data.current_max);
  ObserverScale scale;
  scale.stroke =
      std::max({std::abs(domain.displacement_min), std::abs(domain.displacement_max), 1e-6});
  scale.speed = std::max({std::abs(domain.velocity_min), std::abs(domain.velocity_max), 1e-6});
  scale.state.assign(damper.state_size(), 0.0);

  // Two sines, one of the whole stroke and one of the whole speed, at the mean drive.
  constexpr int kSteps = 2000;
  std::vector<double> z(damper.state_size());
  const double slow = scale.speed / scale.stroke, quick = 3 * slow, dt = 20 / slow / kSteps;
  const double drive = 0.5 * (domain.current_min + domain.current_max);
  DamperInput last{0, 0, drive};
  damper.rest(last, z);
  for (int k = 1; k < kSteps; ++k) {
    const double t = dt * k;
    const DamperInput now{scale.stroke * (0.7 * std::sin(slow * t) + 0.2 * std::sin(quick * t)),
                          scale.speed * (0.7 * std::cos(slow * t) + 0.6 * std::cos(quick * t)),
                          drive};
    damper.advance(last, now, dt, z);
    scale.force = std::max(scale.force, std::abs(damper.force(now, z)));
    for (std::size_t s = 0; s < z.size(); ++s)
      scale.state[s] = std::max(scale.state[s], std::abs(z[s]));
    last = now;
  }
  for (double& size : scale.state)
    if (!(size > 0) || !std::isfinite(size)) size = 1;
  if (!(scale.force > 0) || !std::isfinite(scale.force))
    throw Error(damper.name(), "gives no finite force within the motions of its data");
  return scale;
}

ObserverScale observer_scale(const ObservedDampers& dampers) {
  ObserverScale all;
  for (const ObservedDamper& one : dampers) {
    const ObserverScale own = observer_scale(*one.model, one.domain);
    all.stroke = std::max(all.stroke, own.stroke);
    all.speed = std::max(all.speed, own.speed);
    all.force = std::max(all.force, own.force);
    all.state.insert(all.state.end(), own.state.begin(), own.state.end());
  }
  return all;
}

ObserverTables observer_tables(const InPlantSetup& setup,
                               const std::vector<std::shared_ptr<const DamperModel>>& dampers,
                               const ObserverNoise& noise, const ObserverScale& scale,
                               double sample_time, int steps) {
  require_known(setup);
  const std::vector<PlantInputChannel> inputs = in_order(setup);
  std::vector<PlantInputPlace> places;
  for (const PlantInputChannel& input : inputs) places.push_back(input.place);
  const Plant plant = make_plant(*setup.model, setup.known);
  const DrivenPlant equations(plant, places);
  const std::size_t n = plant.size(), p = 2 * n, acting = inputs.size() + dampers.size();
  assert(equations.dampers().size() == dampers.size());

  // The plant over a step.
  ObserverTables t{.plant = static_cast<int>(p),
                   .dampers = static_cast<int>(dampers.size()),
                   .errors = static_cast<int>(noise.force.size()),
                   .shifts = noise.shift.deviation > 0 ? 1 : 0,
                   .sensors = static_cast<int>(setup.sensors.size()),
                   .steps = steps,
                   .step = sample_time / steps};
  t.roads = static_cast<int>(std::ranges::count_if(
      inputs, [](const PlantInputChannel& one) { return one.road.has_value(); }));
  t.inputs = static_cast<int>(inputs.size()) - t.roads;
  t.drives = static_cast<int>(setup.drives.size());
  const auto measured = static_cast<std::size_t>(t.inputs), roads = inputs.size() - measured;
  StepMatrices matrices = step_matrices(equations, acting, t.step);
  for (const DamperPlace& place : equations.dampers()) {
    t.deflection.insert(t.deflection.end(), place.row.begin(), place.row.end());
    t.on_ground.insert(t.on_ground.end(), place.on_ground.begin(),
                       place.on_ground.begin() + static_cast<std::ptrdiff_t>(measured));
  }
  for (const auto& damper : dampers) {
    const auto size = static_cast<int>(damper->state_size());
    t.damper.push_back(is_estimated(*damper) ? size : 0);
    t.memory.push_back(is_estimated(*damper) ? 0 : size);
    t.by_way.push_back(damper->needs_displacement() ? 1 : 0);
  }

  // What a sample adds to the uncertainty of the plant and of what moved it, `own`.
  const std::size_t moving = t.moving(), error = p + roads;
  const std::size_t parts = noise.is_straight ? 1 : kParts;
  const double part_time = sample_time / static_cast<double>(parts);
  const StepMatrices part = step_matrices(equations, acting, part_time);
  t.process.resize(moving * moving);
  const auto add = [&](std::size_t input, std::size_t own, std::span<const double> values,
                       double variance) {
    std::vector<double> row = response_to(part, p, acting, input, values);
    row.resize(moving);
    if (own < moving) row[own] = values.back();
    for (std::size_t i = 0; i < moving; ++i)
      for (std::size_t k = 0; k < moving; ++k)
        t.process[i * moving + k] += variance * row[i] * row[k];
  };

  // What goes on at random, as a first-order process, does so between the samples too: in each part
  // of one it changes by chance, and what it was is forgotten from there on.
  const auto add_random = [&](std::size_t input, std::size_t own, double deviation, double memory) {
    const double keep = std::exp(-part_time / memory),
                 variance = deviation * deviation * -std::expm1(-2 * part_time / memory);
    for (std::size_t first = 0; first < parts; ++first) {
      std::vector<double> values(parts + 1);
      values[first + 1] = 1;
      for (std::size_t k = first + 2; k <= parts; ++k) values[k] = values[k - 1] * keep;
      add(input, own, values, variance);
    }
  };
  double road_rate_variance = 0, road_deviation = 0;
  for (std::size_t r = 0; r < roads; ++r) {
    const RoadPrior& road = *inputs[measured + r].road;
    const double density = noise.roughness * std::pow(kTurn * kReferenceWaveNumber, 2) * road.speed;
    const double forgetting = kTurn * kLongestWave * road.speed;
    t.road_keep = std::exp(-forgetting * t.step);
    road_rate_variance = 0.5 * density / sample_time;  // two-sided
    road_deviation = std::sqrt(0.5 * density / (2 * forgetting));
    add_random(measured + r, p + r, road_deviation, 1 / forgetting);
  }
  for (const ForceError& one : noise.force) t.error_keep.push_back(std::exp(-t.step / one.memory));
  const auto shifts = static_cast<std::size_t>(t.shifts), errors = noise.force.size() + shifts;
  for (std::size_t d = 0; d < dampers.size(); ++d)
    for (std::size_t e = 0; e < noise.force.size(); ++e)
      add_random(inputs.size() + d, error + d * errors + e, noise.force[e].deviation,
                 noise.force[e].memory);

  if (shifts > 0) {
    t.error_keep.push_back(std::exp(-t.step / noise.shift.memory));
    t.shift_added = 0.5 * std::pow(noise.shift.deviation, 2) *
                    -std::expm1(-2 * sample_time / noise.shift.memory);
  }

  // What is measured of an input is not quite what it was.
  std::vector<double> input_variance;
  for (std::size_t u = 0; u < measured; ++u) {
    input_variance.push_back(inputs[u].noise * inputs[u].noise);
    if (inputs[u].noise > 0)
      add(u, moving, std::vector<double>(parts + 1, 1.0), input_variance.back());
  }

  // The steps of differences, and a trace of uncertainty so that nothing counts as exact.
  constexpr double kDifference = 1e-3, kTrace = 1e-4, kTraceOfStaying = 1e-3;
  for (std::size_t k = 0; k < p; ++k)
    t.difference.push_back(kDifference * (k < n ? scale.stroke : scale.speed));
  for (std::size_t r = 0; r < roads; ++r) t.difference.push_back(kDifference * scale.stroke);
  for (std::size_t d = 0; d < dampers.size(); ++d) {
    t.difference.insert(t.difference.end(), noise.force.size(), kDifference * scale.force);
    t.difference.insert(t.difference.end(), shifts, kDifference * scale.speed);
  }
  const std::vector<double> of_states = estimated_scale(dampers, scale);
  for (const double size : of_states) t.difference.push_back(kDifference * size);
  t.way = kDifference * scale.stroke;
  t.speed = kDifference * scale.speed;
  std::vector<double> trace;
  for (const double step : t.difference) trace.push_back(kTrace / kDifference * step);
  for (std::size_t d = 0; d < dampers.size(); ++d)
    for (std::size_t e = 0; e < noise.force.size(); ++e)
      if (noise.force[e].memory >= kStayingError)
        trace[error + d * errors + e] = kTraceOfStaying * noise.force[e].deviation;
  for (std::size_t k = 0; k < moving; ++k) t.process[k * moving + k] += trace[k] * trace[k];
  add_sensors(equations, setup, noise, road_rate_variance, input_variance, t);

  // The start: at rest, or anywhere.
  constexpr double kAnywhere = 1;
  const double start = setup.from_rest ? kDifference : kAnywhere;
  for (std::size_t k = 0; k < p; ++k)
    t.first_deviation.push_back(start * (k < n ? scale.stroke : scale.speed));
  for (std::size_t r = 0; r < roads; ++r)
    t.first_deviation.push_back(setup.from_rest ? start * scale.stroke : road_deviation);
  for (std::size_t d = 0; d < dampers.size(); ++d) {
    for (const ForceError& one : noise.force) t.first_deviation.push_back(one.deviation);
    t.first_deviation.insert(t.first_deviation.end(), shifts, noise.shift.deviation);
  }
  for (const double size : of_states)
    t.first_deviation.push_back((setup.from_rest ? kDifference : 1) * size);
  t.first_deviation.insert(t.first_deviation.end(), scale.offset.begin(), scale.offset.end());
  t.transition = std::move(matrices.transition);
  t.by_start = std::move(matrices.by_start);
  t.by_end = std::move(matrices.by_end);
  return t;
}

ObserverNames observer_names(const InPlantSetup& setup, const std::string& damper) {
  ObserverNames names{
      .plant = std::string(setup.model->name), .damper = damper, .drive_unit = setup.drive_unit};
  const Plant plant = make_plant(*setup.model, setup.known);
  for (const Strut& strut : plant.struts) names.struts.push_back(strut.name);
  for (const auto& [suffix, rate] : {std::pair{"", ""}, std::pair{"_velocity", "/s"}})
    for (const Coordinate& coordinate : plant.coordinates) {
      names.states.push_back(coordinate.name + suffix);
      names.state_units.push_back(coordinate.unit + rate);
    }

  // A road that nothing measures is a state, all other inputs are channels; then the sensors.
  for (const PlantInputChannel& input : in_order(setup)) {
    if (input.road) {
      names.states.push_back(input.place.tyre ? plant.tyres[*input.place.tyre].name + "_road"
                                              : "road");
      names.state_units.emplace_back("m");
      continue;
    }
    names.inputs.push_back(input.channel);
    names.input_units.push_back(unit_of(input.place.kind));
  }
  for (const PlantSensor& sensor : setup.sensors) {
    names.sensors.push_back(sensor.channel);
    names.sensor_units.push_back(unit_of(sensor.place, plant));
  }
  return names;
}

}  // namespace dashpot
