#include "dashpot/suspension/ride/ride_measures.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/suspension/ride/ride.h"
#include "dashpot/suspension/ride/weighting.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

using Samples = std::span<const double>;
constexpr double kBand = 0.05;  // of settling

double greatest(Samples x) {
  double top = 0;
  for (const double value : x) top = std::max(top, std::abs(value));
  return top;
}

/// Reads measures from the channels of a run, from the instant on from which they count.
class Reading {
 public:
  Reading(const Vehicle& vehicle, const GroundMotion& ground, const Trace& trace, double discard)
      : vehicle_(vehicle),
        ground_(ground),
        trace_(trace),
        dt_(trace.record.size() > 1 ? trace.record.time[1] - trace.record.time[0] : 1),
        first_(
            std::min(trace.record.size(), static_cast<std::size_t>(std::lround(discard / dt_)))) {}

  std::vector<RideMeasure> on_tyres() {
    add_comfort();
    add_tyres();
    add_struts();
    add_drive();
    if (ground_.jumps(0).size() == 1) add_step(ground_.jumps(0).front());
    return std::move(measures_);
  }

  std::vector<RideMeasure> of_building() {
    const Plant& plant = vehicle_.set.plant;
    const Samples shaking = samples("ground_acceleration");
    std::vector<double> below(shaking.size(), 0), drift(shaking.size()),
        acceleration(shaking.size());

    // Each floor: its drift against the one below it, its acceleration with the ground's.
    for (const Coordinate& floor : plant.coordinates) {
      const Samples x = samples(floor.name), a = samples(floor.name + "_acceleration");
      for (std::size_t k = 0; k < x.size(); ++k) {
        drift[k] = x[k] - below[k];
        below[k] = x[k];
        acceleration[k] = a[k] + shaking[k];
      }
      add(floor.name, floor.name + ", greatest displacement", "mm", 1000 * greatest(x));
      add(floor.name + "_drift", floor.name + ", greatest drift", "mm", 1000 * greatest(drift));
      add(floor.name + "_acceleration", floor.name + ", greatest acceleration, absolute", "m/s^2",
          greatest(acceleration));
    }
    add_struts();
    add_drive();
    return std::move(measures_);
  }

 private:
  Samples samples(const std::string& channel) const {
    return Samples(trace_.record.channel(channel).samples).subspan(first_);
  }
  void add(std::string name, std::string title, std::string unit, double value) {
    measures_.push_back({std::move(name), std::move(title), std::move(unit), value});
  }

  void add_comfort() {
    const std::string name = vehicle_.set.plant.coordinates.front().name;
    const Samples all = trace_.record.channel(name + "_acceleration").samples;
    const RideComfort comfort =
        ride_comfort(find_weighting("Wk"), all, dt_, dt_ * static_cast<double>(first_));
    add(name + "_acceleration", name + " acceleration, rms", "m/s^2", comfort.rms);
    add("weighted_acceleration", "the same weighted by Wk: a_w", "m/s^2", comfort.weighted_rms);
    add("vdv", "vibration dose, VDV", "m/s^1.75", comfort.vdv);
    add("mtvv", "greatest running rms over 1 s, MTVV", "m/s^2", comfort.mtvv);
  }

  void add_tyres() {
    // The worst of all tyres.
    double load = 0, peak = 0, deflection = 0;
    for (const Tyre& tyre : vehicle_.set.plant.tyres) {
      std::vector<double> dynamic;
      for (const double value : samples(tyre.name + "_load"))
        dynamic.push_back(value - tyre.static_load);
      load = std::max(load, root_mean_square(dynamic) / tyre.static_load);
      peak = std::max(peak, greatest(dynamic) / tyre.static_load);
      deflection = std::max(deflection, greatest(samples(tyre.name + "_deflection")));
    }

    const std::string foot = foot_of(vehicle_.set.plant);
    add("tyre_load", "dynamic over static " + foot + " load, rms", "%", 100 * load);
    add("tyre_load_peak", "dynamic over static " + foot + " load, greatest", "%", 100 * peak);
    add("tyre_deflection", foot + " deflection, greatest", "mm", 1000 * deflection);
    add("contact_lost", foot + " without load, of the time", "%",
        100 * contact_lost(trace_.record, vehicle_.set.plant, first_));
  }

  void add_struts() {
    // The worst of all struts; their energies together.
    double rms = 0, travel = 0, force = 0, energy = 0;
    for (const Strut& strut : vehicle_.set.plant.struts) {
      rms = std::max(rms, root_mean_square(samples(strut.name + "_deflection")));
      travel = std::max(travel, greatest(samples(strut.name + "_deflection")));
      force = std::max(force, greatest(samples(strut.name + "_force")));
      energy += damper_energy(trace_.record, strut, first_);
    }

    add("travel", "travel of the struts, rms", "mm", 1000 * rms);
    add("travel_peak", "travel of the struts, greatest", "mm", 1000 * travel);
    add("damper_force", "damper force, greatest", "N", force);
    add("damper_energy", "energy that the dampers take", "J", energy);
  }

  void add_drive() {
    const double range = vehicle_.limits.current_max - vehicle_.limits.current_min;
    if (!(range > 0)) return;
    double sum = 0;
    std::size_t count = 0;
    for (const Strut& strut : vehicle_.set.plant.struts)
      for (const double value : samples(strut.name + "_current")) {
        sum += (value - vehicle_.limits.current_min) / range;
        ++count;
      }
    add("current", "drive, mean over its range", "%",
        count > 0 ? 100 * sum / static_cast<double>(count) : kNoNumber);
  }

  /// After a step at this instant, s: how the first coordinate's acceleration settles to 5 % of its
  /// peak, and the first tyre to 5 % of the step.
  void add_step(double at) {
    const auto start = static_cast<std::size_t>(std::lround(at / dt_));
    const auto since = [&](const std::string& channel) {
      const Samples all = trace_.record.channel(channel).samples;
      return all.subspan(std::min(start, all.size()));
    };

    // The body, by its acceleration.
    const std::string& body = vehicle_.set.plant.coordinates.front().name;
    const Samples a = since(body + "_acceleration");
    if (greatest(a) > 0) {
      const StepMeasures step = step_measures(a, dt_, 0, kBand * greatest(a));
      add("settling", body + " acceleration, settled to 5 % of its peak", "s",
          settled(step, a.size()));
      add("decay_ratio", body + " acceleration, second over first peak", "1",
          step.decay_ratio.value_or(kNoNumber));
      add("deviation", body + " acceleration, greatest", "m/s^2",
          std::abs(step.greatest_deviation));
    }

    // The first tyre, by its deflection.
    const double height = std::abs(ground_.foot(INFINITY, 0, 0).height);
    const Samples tyre = since(vehicle_.set.plant.tyres.front().name + "_deflection");
    if (!(height > 0)) return;
    const StepMeasures step = step_measures(tyre, dt_, 0, kBand * height);
    const std::string foot = foot_of(vehicle_.set.plant);
    add("tyre_settling", foot + ", settled to 5 % of the step", "s", settled(step, tyre.size()));
    add("tyre_deviation", foot + " deflection after the step, greatest", "mm",
        1000 * std::abs(step.greatest_deviation));
  }

  /// s; no number where it is still outside at the last of so many samples.
  double settled(const StepMeasures& step, std::size_t samples) const {
    const bool is_settled = step.settling_time < dt_ * (static_cast<double>(samples) - 1.5);
    return is_settled ? step.settling_time : kNoNumber;
  }

  const Vehicle& vehicle_;
  const GroundMotion& ground_;
  const Trace& trace_;
  double dt_;
  std::size_t first_;
  std::vector<RideMeasure> measures_;
};

}  // namespace

double usual_discard(const GroundMotion& ground, double duration) {
  return ground.is_steady() && duration >= 15 ? 5 : 0;
}

std::string road_end_note(const GroundMotion& ground, double duration) {
  constexpr double kRounding = 1e-9;
  if (!ground.is_steady() || !(duration > ground.duration() * (1 + kRounding))) return {};
  return "the road ends after " + format_number(ground.duration()) + " s of " +
         format_number(duration) + " s: from there on it is level, and the measures count that too";
}

std::vector<RideMeasure> ride_measures(const Vehicle& vehicle, const GroundMotion& ground,
                                       const Trace& trace, double discard) {
  if (trace.record.size() < 2) return {};
  Reading reading(vehicle, ground, trace, trace.diverged_at ? 0 : discard);
  return vehicle.set.plant.tyres.empty() ? reading.of_building() : reading.on_tyres();
}

double measure_named(std::span<const RideMeasure> measures, std::string_view name) {
  const auto found = std::ranges::find(measures, name, &RideMeasure::name);
  return found != measures.end() ? found->value : kNoNumber;
}

}  // namespace dashpot
