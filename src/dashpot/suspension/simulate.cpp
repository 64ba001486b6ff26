#include "dashpot/simulate.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/suspension/control/sensors.h"
#include "dashpot/suspension/steps/integrator.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

double output_step_of(const Setting& setting, const SimulateOptions& options) {
  if (options.output_step > 0) return options.output_step;
  return setting.controller ? options.limits.sample_time : 1e-3;
}

/// Whether a controller may look at the plant's state: it is one of those that say so, or none of
/// those that are known by name.
bool may_need_plant_state(const ControlDescription& controller) {
  const auto& choices = controller.choices;
  if (!choices.empty()) return std::ranges::any_of(choices, may_need_plant_state);
  const auto laws = control_laws();
  const auto law = std::ranges::find(laws, controller.law, &ControlLaw::name);
  return law == laws.end() || (*law)->needs_plant_state;
}

/// Instants k dt, without the sum of their rounding.
class Clock {
 public:
  explicit Clock(double dt) : dt_(dt) {}
  double next() const { return next_; }
  /// Whether this is its instant, to a rounding; then it goes on.
  bool strikes(double t) {
    if (!(t >= next_ - 1e-9 * dt_)) return false;
    next_ = dt_ * static_cast<double>(++ticks_);
    return true;
  }

 private:
  double dt_;
  std::size_t ticks_ = 0;
  double next_ = dt_ > 0 ? 0 : INFINITY;
};

class Simulation {
 public:
  Simulation(const Setting& setting, const SimulateOptions& options)
      : setting_(setting),
        options_(options),
        output_step_(output_step(setting, options)),
        forces_(setting.plant, setting.ground),
        state_(PlantState::at_rest(setting.plant, setting.dampers, options.limits)),
        integrator_(forces_,
                    {options.relative_tolerance, options.absolute_tolerance,
                     options.step.value_or(0), !options.step},
                    state_),
        sensors_(options.sensors, setting.plant.struts.size(), options.limits.sample_time),
        writer_(setting, forces_, static_cast<std::size_t>(options.duration / output_step_) + 2),
        signals_(setting.plant.struts.size()),
        demands_(signals_.size()),
        road_(setting.plant.tyres.size()),
        motions_(signals_.size()),
        controller_state_(setting.controller ? setting.controller->state_size() : 0) {
    if (setting.controller) {
      setting.controller->reset(controller_state_);
      needs_plant_state_ = may_need_plant_state(setting.controller->description());
    }

    // Instants at which the road jumps under some tyre.
    for (const Tyre& tyre : setting.plant.tyres)
      for (const double jump : setting.ground.jumps(tyre.behind)) jumps_.push_back(jump);
    std::sort(jumps_.begin(), jumps_.end());
  }

  Trace run() {
    Clock output(output_step_), samples(setting_.controller ? options_.limits.sample_time : 0);
    const double end = options_.duration;
    Trace trace;
    integrator_.refresh(state_);

    // Jumps, samples and outputs at this instant, then on to the next of them.
    while (true) {
      meet_jumps();
      const bool samples_now = samples.strikes(state_.time);
      const bool writes_now = output.strikes(state_.time);
      if (samples_now || writes_now) look();
      if (samples_now) control();
      if (writes_now) write();
      if (state_.time >= end * (1 - 1e-12)) break;
      const double next = std::min({output.next(), samples.next(), next_jump(), end});
      if (!integrator_.advance(state_, next)) {
        trace.diverged_at = state_.time;
        break;
      }
    }
    finish(trace);
    return trace;
  }

 private:
  static double output_step(const Setting& setting, const SimulateOptions& options) {
    require_fitting(setting, options);
    return output_step_of(setting, options);
  }

  double next_jump() const { return jump_ < jumps_.size() ? jumps_[jump_] : INFINITY; }
  void meet_jumps() {
    const std::size_t before = jump_;
    while (next_jump() <= state_.time) ++jump_;
    if (jump_ != before) integrator_.refresh(state_);
  }

  /// The road and the struts' motions as samples and outputs at this instant have them.
  void look() {
    const bool known = state_.road_time == state_.time;
    forces_.with_sizes([&](auto sizes) {
      for (std::size_t w = 0; w < sizes.tyres; ++w)
        road_[w] = known ? state_.road[w] : forces_.foot(w, state_.time);
      for (std::size_t s = 0; s < sizes.struts; ++s)
        motions_[s] = forces_.strut_motion(sizes, s, state_.time, state_.x.data(),
                                           state_.dampers[s].current());
    });
  }

  void control() {
    const std::size_t n = setting_.plant.size();

    // Signals as the sensors see them; ideal ones give the plant's state as well.
    forces_.with_sizes([&](auto sizes) {
      for (std::size_t s = 0; s < sizes.struts; ++s) signals_[s] = signals_of(sizes, s);
    });
    sensors_.measure(signals_);
    std::vector<double>& x = plant_state_;
    x.clear();
    if (sensors_.ideal() && needs_plant_state_) {
      x = state_.x;
      resting_.resize(n);
      forces_.resting_place(road_, resting_);
      for (std::size_t k = 0; k < n; ++k) x[k] -= resting_[k];
    }

    // Each demand on its way to a current; forces are others where one has changed.
    setting_.controller->step(signals_, x, controller_state_, demands_);
    bool changed = false;
    forces_.with_sizes([&](auto sizes) {
      for (std::size_t s = 0; s < sizes.struts; ++s)
        changed |= state_.dampers[s].demand(
            demands_[s],
            {signals_[s].deflection, signals_[s].deflection_velocity, state_.dampers[s].current()},
            signals_[s].force);
    });
    if (changed) integrator_.refresh(state_);
  }

  template <class Sizes>
  StrutSignals signals_of(Sizes sizes, std::size_t s) const {
    const std::vector<double>& row = setting_.plant.struts[s].body_row;
    const double body_velocity = along(sizes, row, state_.x.data() + sizes.coordinates);
    return {.body_velocity = body_velocity,
            .body_acceleration = along(sizes, row, state_.acceleration.data()),
            .wheel_velocity = body_velocity - motions_[s].velocity,
            .deflection = motions_[s].displacement,
            .deflection_velocity = motions_[s].velocity,
            .force = state_.damper_forces[s],
            .current = motions_[s].current};
  }

  void write() {
    options_.monitor.check();
    writer_.write(state_, road_, motions_);
  }

  void finish(Trace& trace) {
    const Plant& plant = setting_.plant;
    const auto share = [](double of) { return format_number(100 * of, 3) + " % of the time"; };
    trace.record = writer_.take();
    trace.steps = integrator_.counts().steps;
    trace.evaluations = integrator_.counts().evaluations;

    // Shares of the time, after the start that does not count.
    const auto first = trace.diverged_at
                           ? 0
                           : std::ranges::lower_bound(trace.record.time, options_.discard) -
                                 trace.record.time.begin();
    trace.contact_lost = contact_lost(trace.record, plant, static_cast<std::size_t>(first));
    const double stopped = stops_met(trace.record, plant, static_cast<std::size_t>(first));

    // Warnings.
    const std::string foot = foot_of(plant);
    if (trace.contact_lost > 0)
      trace.warnings.push_back("a " + foot +
                               (plant.tyres_may_lift ? " has no contact in "
                                : foot == "tyre"     ? " pulls at the road, which none can, in "
                                                     : " pulls, which none can, in ") +
                               share(trace.contact_lost));
    if (stopped > 0)
      trace.warnings.push_back("a stop is met in " + share(stopped) +
                               (options_.step ? ", in steps that are fixed, so that nothing "
                                                "controls the error of its blows"
                                              : ""));
    if (integrator_.counts().missed > 0)
      trace.warnings.push_back("the tolerance could not be met in " +
                               std::to_string(integrator_.counts().missed) + " of " +
                               std::to_string(trace.steps) + " steps, short as they were");
    if (trace.diverged_at)
      trace.warnings.push_back("diverged at " + format_number(*trace.diverged_at) + " s");
  }

  const Setting& setting_;
  const SimulateOptions& options_;
  double output_step_;
  PlantForces forces_;
  PlantState state_;
  Integrator integrator_;
  Sensors sensors_;
  TraceWriter writer_;
  std::vector<StrutSignals> signals_;
  std::vector<DamperDemand> demands_;
  std::vector<FootMotion> road_;      ///< under each tyre, at the last sample or output
  std::vector<DamperInput> motions_;  ///< of each strut there
  std::vector<double> controller_state_, plant_state_, resting_, jumps_;
  std::size_t jump_ = 0;
  bool needs_plant_state_ = false;
};

/// Refuses before it begins what would take hours, or more memory than there is.
void require_affordable(const Setting& setting, const SimulateOptions& options) {
  constexpr double kMostSteps = 1e8, kMostSamples = 2e7;
  const double samples = options.duration / output_step_of(setting, options);
  if (!(samples <= kMostSamples))
    throw Error("simulation",
                "would keep " + format_number(samples, 2) + " samples, more than a memory holds",
                "a duration of at most " +
                    format_number(options.duration * (kMostSamples / samples)) + " s");
  const double steps = options.step ? options.duration / *options.step : 0;
  if (!(steps <= kMostSteps))
    throw Error("simulation", "would take " + format_number(steps, 2) + " steps, hours of work",
                "a step of at least " + format_number(options.duration / kMostSteps) + " s");
}

}  // namespace

void require_fitting(const Setting& setting, const SimulateOptions& options) {
  const Plant& plant = setting.plant;
  if (setting.dampers.size() != plant.struts.size())
    throw Error(plant.name, "has " + std::to_string(plant.struts.size()) +
                                " places for dampers, not " +
                                std::to_string(setting.dampers.size()));
  for (const MountedDamper& damper : setting.dampers)
    if (!damper.model) throw Error(plant.name, "a damper has no model");

  if (!(options.duration > 0))
    throw Error("simulation", "a duration of " + format_number(options.duration) + " s", "above 0");
  if (options.step && !(*options.step > 0)) throw Error("simulation", "its step is not above 0");
  require_affordable(setting, options);
  if (options.step && setting.controller && *options.step > options.limits.sample_time * (1 + 1e-9))
    throw Error("simulation", "its step is longer than the controller's sample time",
                "at most " + format_number(options.limits.sample_time) + " s");
  constexpr double kLeastTolerance = 1e-14;  // rounding alone is near it
  if (!(options.relative_tolerance >= kLeastTolerance && options.absolute_tolerance > 0))
    throw Error("simulation", "a tolerance is not above 0",
                "a relative one of at least " + format_number(kLeastTolerance));
}

Trace simulate(const Setting& setting, const SimulateOptions& options) {
  return Simulation(setting, options).run();
}

}  // namespace dashpot
