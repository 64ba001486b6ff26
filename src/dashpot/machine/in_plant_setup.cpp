#include "dashpot/machine/in_plant_setup.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

std::vector<std::string> InPlantSetup::channels() const {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const PlantInputChannel& input : inputs)
    if (input.follows.empty()) add(input.channel);
  for (const PlantSensor& sensor : sensors) add(sensor.channel);
  for (const DamperDrive& drive : drives) add(drive.channel);
  return names;
}

std::vector<std::string> InPlantSetup::drive_channels() const {
  std::vector<std::string> names;
  for (const DamperDrive& drive : drives)
    if (!drive.channel.empty() && std::ranges::find(names, drive.channel) == names.end())
      names.push_back(drive.channel);
  return names;
}

std::size_t InPlantSetup::dampers() const { return make_plant(*model, known).struts.size(); }

std::vector<std::size_t> DamperKinds::struts(std::size_t kind, std::size_t count) const {
  std::vector<std::size_t> own;
  for (std::size_t strut = 0; strut < count; ++strut)
    if (at(strut) == kind) own.push_back(strut);
  return own;
}

DamperKinds kinds_by_axle(const Plant& plant) {
  DamperKinds kinds{.names = {}};
  for (const Strut& strut : plant.struts) {
    std::string axle = strut.name;
    for (const std::string_view side : {"_left", "_right"})
      if (axle.ends_with(side)) axle.resize(axle.size() - side.size());
    const auto known = std::ranges::find(kinds.names, axle);
    kinds.of.push_back(static_cast<std::size_t>(known - kinds.names.begin()));
    if (known == kinds.names.end()) kinds.names.push_back(axle);
  }
  return kinds;
}

void require_units(const InPlantSetup& setup, const PlantRecording& recording) {
  const auto require = [&](const std::string& name, const std::string& wanted) {
    const Channel& channel = recording.channel(name);
    // Of a recording alone: a simulation's trace counts whatever drives a coil in A.
    const std::optional<Unit> unit = parse_unit(channel.unit);
    if (!channel.origin.starts_with("column ") || !unit ||
        unit->dimension == parse_unit(wanted)->dimension)
      return;
    throw Error(recording.name + ", " + name,
                "is in " + channel.unit + " (" + channel.origin +
                    "), and the plant says that it is in " + wanted,
                "another unit in the recording, or another 'quantity' in the plant's file");
  };

  const Plant plant = make_plant(*setup.model, setup.known);
  for (const PlantInputChannel& input : setup.inputs) {
    const bool turns = input.place.kind == PlantInput::Force &&
                       plant.coordinates[input.place.coordinate].unit != "m";
    if (!input.channel.empty() && input.follows.empty() && !turns)
      require(input.channel, unit_of(input.place.kind));
  }
  for (const PlantSensor& sensor : setup.sensors)
    require(sensor.channel, unit_of(sensor.place, plant));
  if (setup.drive_unit != DriveUnit::None)
    for (const std::string& channel : setup.drive_channels())
      require(channel, to_string(setup.drive_unit));
}

void require_one_damper(const InPlantSetup& setup, const std::string& who) {
  if (const std::size_t dampers = setup.dampers(); dampers > 1)
    throw Error("plant " + std::string(setup.model->name),
                "has " + std::to_string(dampers) + " dampers, and " + who + " knows one",
                "a plant with one strut, as quarter_car");
  require_no_follower(setup, who);
}

void require_known_lags(const InPlantSetup& setup) {
  for (const PlantSensor& sensor : setup.sensors)
    if (sensor.finds_delay || sensor.finds_cutoff)
      throw Error(
          "plant, " + sensor.channel,
          sensor.finds_delay ? "its delay is unknown" : "the cut-off of its filter is unknown",
          "its value: 'dashpot identify --in' writes it into plants/");
}

void require_known(const InPlantSetup& setup) {
  if (!setup.unknown.empty())
    throw Error("plant, " + setup.unknown.front().name, "is unknown",
                "its value: 'dashpot identify --in' writes the plant as it was found into "
                "plants/");
  require_known_lags(setup);
}

void require_alike(const InPlantSetup& setup, const std::string& who) {
  if (setup.kinds.size() > 1)
    throw Error("plant, damper_kinds",
                "are " + std::to_string(setup.kinds.size()) + " (" + join(setup.kinds.names, ", ") +
                    "), and " + who + " knows one",
                "leave 'damper_kinds' out, or 'alike'");
}

std::vector<std::size_t> dampers_named(const InPlantSetup& setup, const std::string& name) {
  std::vector<std::size_t> places;
  const Plant plant = make_plant(*setup.model, setup.known);
  for (std::size_t d = 0; d < plant.struts.size(); ++d)
    if (name == plant.struts[d].name || name == setup.kinds.names[setup.kinds.at(d)])
      places.push_back(d);
  return places;
}

std::vector<std::string> damper_names(const InPlantSetup& setup) {
  std::vector<std::string> names;
  for (const Strut& strut : make_plant(*setup.model, setup.known).struts)
    names.push_back(strut.name);
  for (const std::string& kind : setup.kinds.names)
    if (!kind.empty() && std::ranges::find(names, kind) == names.end()) names.push_back(kind);
  return names;
}

std::optional<InPlantSetup> with_unlike_dampers(InPlantSetup setup) {
  if (setup.kinds.size() > 1 || setup.kinds.are_stated) return {};
  setup.kinds = kinds_by_axle(make_plant(*setup.model, setup.known));
  return setup.kinds.size() > 1 ? std::optional(std::move(setup)) : std::nullopt;
}

void require_no_follower(const InPlantSetup& setup, const std::string& who) {
  for (const PlantInputChannel& input : setup.inputs)
    if (!input.follows.empty())
      throw Error("plant, " + input.channel, who + " knows no road that follows another one",
                  "a channel with the height of this one");
}

namespace {

/// A road that follows another one: it is measured, and was so before the recording began.
void require_followed(const InPlantSetup& setup, const PlantInputChannel& input,
                      const std::string& where) {
  if (input.place.kind != PlantInput::Ground || !input.place.tyre)
    throw Error(where, "follows another input",
                "only a road does, under a plant that meets it at several places");
  const std::size_t place = followed_by(setup, input);
  const bool is_road = place < setup.inputs.size() && !input.follows.empty() &&
                       setup.inputs[place].place.kind == PlantInput::Ground;
  if (!is_road || !setup.inputs[place].follows.empty())
    throw Error(where, "follows '" + input.follows + "', which is no channel of a road",
                unmeasured_road(setup)
                    ? "class and speed here too: where nothing measures the road, each tyre has "
                      "one of its own"
                    : "follows: the channel of the road under the axle before it");
  if (!(input.later > 0 && std::isfinite(input.later)))
    throw Error(where, "follows by no time", "a delay above 0: wheelbase over speed");
  if (setup.from_rest)
    throw Error(where, "follows another road, so that the plant moved before the recording began",
                "leave 'start: rest' out, or measure this road too");
}

/// Each place where tyres meet the road has a road of its own, or the road does not move at all.
void require_roads(const InPlantSetup& setup, const Plant& plant, const std::string& where) {
  const auto roads_of = [&](std::size_t tyre) {
    return std::ranges::count_if(setup.inputs, [&](const PlantInputChannel& one) {
      return one.place.kind == PlantInput::Ground && one.place.tyre == tyre;
    });
  };
  const bool moves = std::ranges::any_of(setup.inputs, [](const PlantInputChannel& one) {
    return one.place.kind == PlantInput::Ground;
  });
  for (std::size_t w = 0; moves && has_several_roads(plant) && w < plant.tyres.size(); ++w)
    if (const auto roads = roads_of(w); roads != 1)
      throw Error(where + ", inputs",
                  roads == 0 ? "none says what the road does under the " + plant.tyres[w].name
                             : "two say what the road does under the " + plant.tyres[w].name,
                  "an input of kind: ground, at: each place where a tyre meets the road");
}

}  // namespace

void require_setup(const InPlantSetup& setup) {
  const std::string where = "plant";
  if (!setup.model)
    throw Error(where, "no kind is stated", "plant: one of " + join(machine_names(), ", "));
  const auto& rows = setup.model->parameters;
  const std::string owner(setup.model->name);

  // Every parameter once, by a name that the plant has.
  std::vector<std::string> seen;
  const auto note = [&](const std::string& name) {
    row_named(rows, name, owner, where);
    if (std::ranges::find(seen, name) != seen.end())
      throw Error(where + ", " + name, "is stated twice", "known or unknown, once");
    seen.push_back(name);
  };
  for (const auto& [name, value] : setup.known) {
    note(name);
    checked(rows[row_named(rows, name, owner, where)], value, where);
  }
  for (const PlantUnknown& unknown : setup.unknown) {
    note(unknown.name);
    const ParameterRow& row = rows[row_named(rows, unknown.name, owner, where)];
    if (row.whole)
      throw Error(where + ", " + unknown.name, "is a count, which cannot be found by a fit",
                  "state it");
    if (!(unknown.lower < unknown.upper) || unknown.lower < row.lower || unknown.upper > row.upper)
      throw Error(where + ", " + unknown.name,
                  "its range " + format_number(unknown.lower) + " ... " +
                      format_number(unknown.upper) + " is none",
                  "from less to more, within " + format_number(row.lower) + " ... " +
                      format_number(row.upper) + " " + std::string(row.unit));
    if (unknown.about && (*unknown.about < unknown.lower || *unknown.about > unknown.upper))
      throw Error(where + ", " + unknown.name, "'about' lies outside its range");
  }

  // Something must move it, something must show that, and a damper must have a place.
  const Plant plant = make_plant(*setup.model, setup.known, where);
  if (plant.struts.empty())
    throw Error(where, owner + " has no place for a damper", "one of the plants with a strut");
  if (setup.inputs.empty())
    throw Error(where, "no input is stated", "a channel of a force, a ground or its acceleration");
  if (setup.sensors.empty())
    throw Error(where, "no sensor is stated", "at least one channel that shows the motion");
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) {
    inputs.push_back(input.place);
    if (!input.follows.empty()) require_followed(setup, input, where + ", " + input.channel);
    if (input.road && *input.road != *unmeasured_road(setup))
      throw Error(where + ", roads", "those that nothing measures differ in class or speed",
                  "one road: the same for each");
    if (input.road && std::ranges::any_of(
                          plant.struts, [](const Strut& strut) { return strut.track.has_value(); }))
      throw Error(where, "the damper stands on a ground that nothing measures",
                  "a channel with the ground's height");
    if (input.place.kind == PlantInput::Force && input.place.coordinate >= plant.size())
      throw Error(where + ", " + input.channel, "pushes a coordinate that is not there");
    for (const PlantSensor& sensor : setup.sensors)
      if (sensor.channel == input.channel)
        throw Error(where + ", " + input.channel, "is both an input and a sensor",
                    "what moves the plant cannot judge the fit");
  }
  for (auto sensor = setup.sensors.begin(); sensor != setup.sensors.end(); ++sensor)
    if (std::find_if(setup.sensors.begin(), sensor, [&](const PlantSensor& other) {
          return other.channel == sensor->channel;
        }) != sensor)
      throw Error(where + ", " + sensor->channel, "is stated as two sensors",
                  "a channel of its own for each");
  for (const PlantSensor& sensor : setup.sensors)
    if (sensor.place.coordinate >= plant.size() || sensor.place.strut >= plant.struts.size())
      throw Error(where + ", " + sensor.channel, "stands where the plant has nothing");
  require_roads(setup, plant, where);
  if (setup.drives.size() != 1 && setup.drives.size() != plant.struts.size())
    throw Error(where + ", " + to_string(setup.drive_unit),
                "has " + std::to_string(setup.drives.size()) + " drives for " +
                    std::to_string(plant.struts.size()) + " dampers",
                "one of all dampers, or one for each strut");
  const DrivenPlant equations(plant, inputs);
  if (!(setup.held_back >= 0 && setup.held_back < 0.9))
    throw Error(where + ", held_back", "is " + format_number(setup.held_back),
                "a share of the time from 0 to below 0.9");
  if (!(setup.skip >= 0))
    throw Error(where + ", skip", "is " + format_number(setup.skip), "0 s or more");
}

std::size_t followed_by(const InPlantSetup& setup, const PlantInputChannel& follower) {
  const auto found = std::ranges::find(setup.inputs, follower.follows, &PlantInputChannel::channel);
  return static_cast<std::size_t>(found - setup.inputs.begin());
}

const RoadPrior* unmeasured_road(const InPlantSetup& setup) {
  for (const PlantInputChannel& input : setup.inputs)
    if (input.road) return &*input.road;
  return nullptr;
}

}  // namespace dashpot
