#include "dashpot/vehicle.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/error.h"
#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/dampers/damper_words.h"

namespace dashpot {
namespace {

PlantSet load_plant(const std::string& plant, const NamedValues& values) {
  if (plant.find_first_of("./") == std::string::npos) return load_plant_set(plant, values);
  return parse_plant_set(read_file(plant), plant, std::filesystem::path(plant).stem().string(),
                         values);
}

}  // namespace

PlantSet load_plant(const VehicleWords& words) {
  PlantSet set = load_plant(words.plant, {});
  if (words.values.empty()) return set;
  if (set.kind.empty())
    throw Error(words.where,
                set.name + " has matrices, no parameter '" + words.values.front() + "'");

  // A plant that is made from parameters takes other values for some of them.
  const PlantModel& model = find_plant_model(set.kind);
  NamedValues values;
  for (const std::string& text : words.values) {
    const std::size_t equals = text.find('=');
    const std::string name(trim(text.substr(0, equals)));
    if (equals == std::string::npos)
      throw Error(words.where, "'" + text + "' sets nothing", "name=value");
    const ParameterRow& row =
        model.parameters[row_named(model.parameters, name, model.name, words.where)];
    values.emplace_back(name, parse_value(row, text.substr(equals + 1), words.where));
  }
  return load_plant(words.plant, values);
}

namespace {

std::vector<ChosenDamper> choose_dampers(const VehicleWords& words, const PlantSet& set) {
  std::vector<std::string> texts = words.dampers;
  if (texts.empty()) {
    if (!set.damping)
      throw Error(words.where, set.name + " states no damper of its own", "name one");
    const auto& [least, nominal, greatest] = *set.damping;
    texts = {least < greatest ? "ideal,damping_min=" + format_exact(least) +
                                    ",damping_max=" + format_exact(greatest)
                              : "viscous,damping=" + format_exact(nominal)};
  }

  // One text for all struts, or one per strut.
  const std::size_t places = set.plant.struts.size();
  if (texts.size() != 1 && texts.size() != places)
    throw Error(words.where,
                std::to_string(texts.size()) + " dampers for the " + std::to_string(places) +
                    " struts of " + set.name,
                "one for all, or one for each");
  std::vector<ChosenDamper> chosen;
  for (const std::string& text : texts) chosen.push_back(choose_damper(text, words.where));
  while (chosen.size() < places) chosen.push_back(chosen.front());
  return chosen;
}

/// The range over which the dampers are driven, the same for all that are not passive.
struct DriveRange {
  DriveUnit unit = DriveUnit::None;
  double low = 0, high = 0;  ///< equal: all are passive

  std::string text(double value) const {
    return unit == DriveUnit::None ? format_number(value)
                                   : format_number(value) + ' ' + to_string(unit);
  }
};

DriveRange drive_range(const std::vector<ChosenDamper>& dampers, const VehicleWords& words) {
  DriveRange range;
  const ChosenDamper* first = nullptr;
  for (const ChosenDamper& damper : dampers) {
    if (damper.is_passive()) continue;
    const bool alike =
        !first || (damper.drive_unit == range.unit && damper.drive_min == range.low &&
                   (words.current_max > 0 || damper.drive_max == range.high));
    if (!alike)
      throw Error(words.where,
                  first->name + " and " + damper.name + " are not driven over the same range",
                  "dampers that one current suits; a common greatest one may be stated");
    if (!first) range = {damper.drive_unit, damper.drive_min, damper.drive_max};
    first = first ? first : &damper;
  }

  // A greatest current that is stated takes the place of the data's.
  if (words.current_max > 0 && first) range.high = words.current_max;
  if (first && !(range.low < range.high))
    throw Error(words.where, "a greatest drive of " + range.text(range.high) +
                                 " is not above the least, " + range.text(range.low));
  return range;
}

std::string damping_note(const ChosenDamper& damper, const DampingRange& damping,
                         const DriveRange& drive) {
  const auto [amplitude, speed] = reference_stroke(damper);
  std::string text = damper.name + ": ";
  if (damper.is_passive())
    text += format_number(damping.nominal) + " N*s/m";
  else
    text += format_number(damping.least) + " to " + format_number(damping.greatest) +
            " N*s/m between " + format_number(drive.low) + " and " + drive.text(drive.high);
  return text + " at the strut, equivalent over a sine of " + format_number(1000 * amplitude) +
         " mm at " + format_number(speed) + " m/s of the damper";
}

/// The dampers' limits as the controller knows them: the mean over those that it drives.
ControlLimits control_limits(const std::vector<ChosenDamper>& dampers, const DriveRange& drive,
                             const VehicleWords& words, std::vector<std::string>& notes) {
  ControlLimits limits{0, 0, drive.low, drive.high, words.sample_time};
  constexpr double kShortest = 1e-5, kLongest = 1;  // s
  if (!(words.sample_time >= kShortest && words.sample_time <= kLongest))
    throw Error(words.where,
                "the controller's sample time is " + format_number(words.sample_time) + " s",
                "between 10 us and 1 s");

  // The mean over those that are driven, with a note for each damping that is not stated.
  double driven = 0;
  std::vector<std::string> noted;
  for (const ChosenDamper& damper : dampers) {
    const bool is_known = std::ranges::find(noted, damper.name) != noted.end();
    const DampingRange damping = damping_between(damper, drive.low, drive.high);
    if (!damper.damping && !is_known) notes.push_back(damping_note(damper, damping, drive));
    noted.push_back(damper.name);
    if (damper.is_passive() && drive.low < drive.high) continue;
    limits.damping_min += damping.least;
    limits.damping_max += damping.greatest;
    ++driven;
  }

  limits.damping_min /= driven;
  limits.damping_max /= driven;
  return limits;
}

std::shared_ptr<const InverseModel> make_inverse(const ChosenDamper& damper,
                                                 const DriverOptions& driver,
                                                 const VehicleWords& words) {
  const InverseLimits limits{driver.current_min, driver.current_max, words.sample_time,
                             driver.lag_rate};
  if (words.inverse.find_first_of("./") == std::string::npos)
    return find_inverse(words.inverse, words.where).make(*damper.model, limits);
  InverseFile file = load_inverse(words.inverse);
  require_drive(file, damper.drive_unit, words.inverse);
  return std::make_shared<HistoryNetwork>(std::move(file.network), limits);
}

/// A, that a damper has before anything moves.
double starting_current(const ChosenDamper& damper, const DriveRange& drive,
                        const VehicleWords& words) {
  if (damper.is_passive()) return 0;
  return words.controller.empty() ? std::max(words.current, drive.low) : drive.low;
}

/// Takes off the force that the damper has at rest in its middle (gas, offset): the plant's
/// coordinates count from where the vehicle stands with its dampers in, so the springs bear that
/// force already, and nothing moves before the road does. The note tells the current where the
/// force depends on it, since a vehicle that is compared with this one may have another.
ChosenDamper in_equilibrium(ChosenDamper damper, double current, const DriveRange& drive) {
  const double force = force_at_rest(*damper.model, current);
  const bool depends =
      force_at_rest(*damper.model, drive.low) != force_at_rest(*damper.model, drive.high);
  if (force == 0 || !std::isfinite(force)) return damper;
  damper.model = damper.model->with_offset(-force);

  constexpr double kTold = 0.1;  // N
  if (std::abs(force) >= kTold)
    damper.notes.push_back(
        damper.name + ": its force at rest" + (depends ? " at " + drive.text(current) : "") + ", " +
        format_number(force, 3) + " N, is borne by the springs: the vehicle starts in equilibrium");
  return damper;
}

MountedDamper mount(const ChosenDamper& damper, const DriveRange& drive,
                    const VehicleWords& words) {
  MountedDamper mounted{.model = damper.model,
                        .motion_ratio = damper.motion_ratio,
                        .force_factor = damper.force_factor};
  if (damper.is_passive()) return mounted;

  // A driven one has a coil and, perhaps, an inverse with a force loop.
  mounted.driver = {.current_min = drive.low,
                    .current_max = drive.high,
                    .lag_rate = words.lag_rate >= 0 ? words.lag_rate : damper.lag_rate};
  if (!words.inverse.empty()) mounted.inverse = make_inverse(damper, mounted.driver, words);
  if (!words.force_loop.empty()) {
    if (words.inverse.empty())
      throw Error(words.where,
                  "a force loop needs an inverse, which turns its force into a current", "numeric");
    const std::vector<double> gains =
        parse_values(force_loop_settings(), split_words(words.force_loop, words.where),
                     "the force loop", words.where);
    mounted.loop = {gains[0], gains[1], gains[2]};
  }

  mounted.current = starting_current(damper, drive, words);
  return mounted;
}

void add_controller(Vehicle& vehicle, const DriveRange& drive, const VehicleWords& words) {
  if (words.controller.empty()) return;
  if (!(drive.low < drive.high))
    throw Error(words.where,
                "'" + words.controller + "' has nothing to control: every damper is passive",
                "a damper that a current drives");
  vehicle.controller =
      make_controller(words.controller, {vehicle.limits, vehicle.set.plant}, words.where);
  vehicle.controller_name = words.controller;
  if (words.sensors.in_car && needs_plant_state(words.controller))
    throw Error(words.where,
                "'" + words.controller + "' feeds back what no sensor of a car measures",
                "ideal sensors, or another controller");
}

}  // namespace

SimulateOptions Vehicle::options(double duration) const {
  // The weighting of accelerations reaches to 100 Hz: every millisecond, or an even part of a
  // sample.
  const double parts = std::max(1.0, std::ceil(limits.sample_time / 1e-3 - 1e-9));
  return {.duration = duration,
          .output_step = limits.sample_time / parts,
          .sensors = sensors,
          .limits = limits};
}

namespace {

/// The vehicle with these dampers, one per strut.
Vehicle vehicle_with(const std::vector<ChosenDamper>& named, PlantSet set,
                     const VehicleWords& words) {
  if (words.sensors.delay > 0 && !words.sensors.in_car)
    throw Error(words.where, "a delay of the sensors, but ideal sensors, which have none",
                "sensors as in a car (in_car), or no delay");
  Vehicle vehicle{.set = std::move(set), .sensors = words.sensors};
  if (!vehicle.set.verified)
    vehicle.notes.push_back("the numbers of " + vehicle.set.name +
                            " are an example: " + vehicle.set.reason);

  // Dampers, and the range over which all that are driven are driven.
  const DriveRange drive = drive_range(named, words);
  std::vector<ChosenDamper> chosen;
  for (const ChosenDamper& damper : named)
    chosen.push_back(in_equilibrium(damper, starting_current(damper, drive, words), drive));
  if (drive.low < drive.high && !(words.current <= drive.high))
    throw Error(words.where, "a drive of " + drive.text(words.current) +
                                 " is beyond the greatest, " + drive.text(drive.high));

  // Each in its strut; a note that several have stands once.
  const auto add = [](const std::vector<std::string>& some, std::vector<std::string>& all) {
    for (const std::string& text : some)
      if (std::ranges::find(all, text) == all.end()) all.push_back(text);
  };
  vehicle.drive_unit = drive.unit;
  for (const ChosenDamper& damper : chosen) {
    add(damper.notes, vehicle.notes);
    add(damper.warnings, vehicle.warnings);
    if (!damper.is_passive() && drive.unit != DriveUnit::None)
      if (const std::string text = beyond_known_text(drive.high, damper.drive_max, drive.unit);
          !text.empty())
        add({damper.name + ": " + text}, vehicle.notes);
    vehicle.dampers.push_back(mount(damper, drive, words));
    vehicle.damper_names.push_back(damper.name);
    vehicle.domains.push_back(damper.domain);
  }

  vehicle.limits = control_limits(named, drive, words, vehicle.notes);
  add_controller(vehicle, drive, words);
  return vehicle;
}

}  // namespace

std::vector<IdleWord> idle_words(const VehicleWords& words) {
  std::vector<IdleWord> idle;
  if (!words.controller.empty()) {
    if (words.current != 0)
      idle.push_back(
          {"current", "is where there is no controller, which chooses its own", "leave it out"});
    return idle;
  }
  for (const auto& [key, is_said] : {std::pair{"inverse", !words.inverse.empty()},
                                     {"force_loop", !words.force_loop.empty()},
                                     {"in_car", words.sensors.in_car},
                                     {"delay", words.sensors.delay > 0}})
    if (is_said)
      idle.push_back({key, "serves a controller, and there is none",
                      "name one as 'controller', or leave it out"});
  return idle;
}

Vehicle make_vehicle(const VehicleWords& words) {
  PlantSet set = load_plant(words);
  const std::vector<ChosenDamper> dampers = choose_dampers(words, set);
  return vehicle_with(dampers, std::move(set), words);
}

Vehicle make_vehicle(const VehicleWords& words, const ModelFile& damper) {
  PlantSet set = load_plant(words);
  const std::vector<ChosenDamper> dampers(set.plant.struts.size(), choose_damper(damper));
  return vehicle_with(dampers, std::move(set), words);
}

}  // namespace dashpot
