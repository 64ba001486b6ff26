#include "dashpot/suspension/ride/simulated_run.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/suspension/ride/domain_use.h"

namespace dashpot {

std::string unusable(const SimulatedRun& run) {
  constexpr double kMost = 1e4;  // m/s^2, a thousand times gravity
  if (run.trace.diverged_at)
    return "It diverged at " + format_number(*run.trace.diverged_at) +
           " s: nothing below can be used.";
  for (const RideMeasure& measure : run.measures)
    if (std::isinf(measure.value) || (measure.unit == "m/s^2" && std::abs(measure.value) > kMost))
      return "It moves as no vehicle does (" + std::string(measure.name) + " " +
             format_number(measure.value, 3) + " " + std::string(measure.unit) +
             "): nothing below can be used. Are the plant's numbers in SI units?";
  return {};
}

std::string name_of(const Vehicle& vehicle) {
  if (vehicle.controller) return vehicle.controller_name;
  std::vector<std::string> names;
  for (const std::string& name : vehicle.damper_names)
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  std::string text = join(names, "; ");
  if (vehicle.limits.current_min < vehicle.limits.current_max) {
    const std::string drive = format_number(vehicle.dampers.front().current);
    text += vehicle.drive_unit == DriveUnit::None
                ? " at drive " + drive
                : " at " + drive + ' ' + to_string(vehicle.drive_unit);
  }
  return text;
}

SimulatedRun run_vehicle(const std::shared_ptr<const Vehicle>& vehicle, const GroundMotion& ground,
                         const RunOptions& options) {
  SimulateOptions settings = vehicle->options(options.duration);
  settings.relative_tolerance = options.relative_tolerance;
  settings.step = options.step;
  settings.monitor = options.monitor;
  settings.discard = usual_discard(ground, options.duration);
  SimulatedRun run{.name = name_of(*vehicle),
                   .vehicle = vehicle,
                   .trace = simulate(vehicle->on(ground), settings),
                   .measures = {},
                   .warnings = {},
                   .notes = {}};

  if (run.trace.record.size() < 2 && !run.trace.diverged_at)
    throw Error(
        "simulation",
        "a duration of " + format_number(options.duration) + " s holds no sample but the first",
        "some seconds");
  run.measures = ride_measures(*vehicle, ground, run.trace, settings.discard);
  run.warnings = vehicle->warnings;
  run.warnings.insert(run.warnings.end(), run.trace.warnings.begin(), run.trace.warnings.end());
  for (std::string& warning :
       domain_warnings(domain_use(*vehicle, run.trace), options.allowed_outside))
    run.warnings.push_back(std::move(warning));
  if (std::string note = road_end_note(ground, options.duration); !note.empty())
    run.notes.push_back(std::move(note));
  return run;
}

VehicleWords passive_words(const VehicleWords& words, const std::string& against) {
  constexpr std::string_view kCurrent = "current=";
  VehicleWords passive = words;
  passive.controller.clear();
  passive.inverse.clear();
  passive.force_loop.clear();

  // The same dampers at a current that is stated, or another damper.
  if (against.starts_with(kCurrent)) {
    const std::optional<double> current = parse_number(against.substr(kCurrent.size()));
    if (!current) throw Error(words.where, "'" + against + "' states no current", "current=0.5");
    passive.current = *current;
    return passive;
  }
  if (!against.empty()) {
    passive.dampers = {against};
    return passive;
  }

  // Nothing stated: nominal damping in place of ideal dampers, half the current of all others.
  const bool all_ideal = std::ranges::all_of(
      words.dampers, [](const std::string& d) { return trim(d).starts_with("ideal"); });
  const Vehicle held = make_vehicle(passive);
  if (all_ideal && held.set.damping)
    passive.dampers = {"viscous,damping=" + format_exact(held.set.damping->nominal)};
  else
    passive.current = 0.5 * (held.limits.current_min + held.limits.current_max);
  return passive;
}

}  // namespace dashpot
