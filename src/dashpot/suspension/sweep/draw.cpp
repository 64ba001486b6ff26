#include "dashpot/suspension/sweep/draw.h"

#include <algorithm>

#include <boost/random/sobol.hpp>

#include "dashpot/base/random.h"
#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/suspension/ground/ground_sequences.h"

namespace dashpot {
namespace {

using Target = SweepInput::Target;

/// A number that changes with each bit of both (splitmix64's last step).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  return Random(a ^ (b * 0x9e3779b97f4a7c15)).next();
}

std::uint64_t number_of(const std::string& name) {  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
  return hash;
}

/// In the middle of its cell of 2^53, so neither 0 nor 1.
double unit_interval(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1.0p-52;
}

/// A number between 0 and 1 for each drawn input. Each input has random numbers of its own, by its
/// name, so that one more does not move the others.
std::vector<double> drawn_shares(const SweepRequest& request, std::size_t sample) {
  std::vector<const SweepInput*> drawn;
  for (const SweepInput& input : request.inputs)
    if (!input.on_grid) drawn.push_back(&input);
  if (drawn.empty()) return {};

  std::vector<double> shares;
  if (request.drawing == SweepRequest::Drawing::Plain) {
    for (const SweepInput* input : drawn)
      shares.push_back(unit_interval(mixed(mixed(request.seed, sample), number_of(input->name))));
    return shares;
  }

  // Sobol's points, moved as a whole by the seed (a digital shift keeps how evenly they lie).
  boost::random::sobol points(drawn.size());
  points.seed(sample);
  for (const SweepInput* input : drawn)
    shares.push_back(unit_interval(points() ^ mixed(request.seed, number_of(input->name))));
  return shares;
}

/// The road with this setting in place of its own, where a class is a roughness.
std::string with_road_setting(std::string road, const std::string& name, const std::string& value) {
  if (name == "class") road = without_setting(road, "roughness");
  if (name == "roughness") road = without_setting(road, "class");
  return with_setting(road, name, value);
}

/// Makes a random road without a stated length as long as the ride, for the last axle too.
std::string with_length(const std::string& road, const SweepRequest& request) {
  constexpr double kLongestVehicle = 30;  // m
  const std::string name = first_word(road);
  if (!name.starts_with("iso8608") && name != "filtered_noise") return road;

  // The speed that the words give, else that of the road's table.
  const SequenceInfo& info = find_ground_sequence(name).info;
  double speed = info.params[row_named(info.params, "speed", name, request.source)].value;
  for (const std::string& part : split(road, ',')) {
    const std::size_t equals = part.find('=');
    const std::string_view key = trim(std::string_view(part).substr(0, equals));
    if (key == "length") return road;
    if (key == "speed") speed = parse_quantity(part.substr(equals + 1), "m/s", request.source);
  }
  return with_setting(road, "length", format_exact(speed * request.duration + kLongestVehicle));
}

}  // namespace

SweepDraw draw_vehicle(const SweepRequest& request, std::size_t vehicle) {
  const std::size_t places = request.grid_size(), sample = vehicle / places;
  std::size_t place = vehicle % places;
  SweepDraw draw{.vehicle = vehicle};
  draw.road_seed =
      request.road_seed.value_or(mixed(mixed(request.seed, sample), number_of("road")) >> 32);

  // Inputs on the grid take the values of this place, the first running fastest; others are drawn.
  const std::vector<double> shares = drawn_shares(request, sample);
  auto share = shares.begin();
  for (const SweepInput& input : request.inputs) {
    const std::vector<double>& values = input.distribution.values;
    if (input.on_grid) {
      draw.values.push_back(values[place % values.size()]);
      place /= values.size();
    } else {
      draw.values.push_back(input.distribution.at(*share++));
    }
    if (input.target == Target::RoadSeed)
      draw.road_seed = static_cast<std::uint64_t>(draw.values.back());
  }
  return draw;
}

VehicleWords vehicle_words(const SweepRequest& request, std::size_t controller,
                           const SweepDraw& draw) {
  VehicleWords words = request.controllers[controller].words;
  for (std::size_t k = 0; k < request.inputs.size(); ++k) {
    const SweepInput& input = request.inputs[k];

    // What is drawn takes the place of what the words state of it.
    const std::string now = format_exact(draw.values[k]);
    switch (input.target) {
      case Target::Plant:
        words.values.push_back(input.parameter + '=' + now);
        break;
      case Target::Damper:
        for (std::string& damper : words.dampers)
          if (input.applies_to(damper)) damper = with_setting(damper, input.parameter, now);
        break;
      case Target::Controller:
        if (input.controller == controller)
          words.controller = with_setting(words.controller, input.parameter, now);
        break;
      case Target::Current:
        words.current = draw.values[k];
        break;
      case Target::LagRate:
        words.lag_rate = draw.values[k];
        break;
      default:
        break;  // of the road
    }
  }

  words.sensors.seed = draw.road_seed;
  words.where = request.source + ", vehicle " + std::to_string(draw.vehicle);
  return words;
}

std::string road_words(const SweepRequest& request, const SweepDraw& draw) {
  std::string road = request.road;
  for (std::size_t k = 0; k < request.inputs.size(); ++k) {
    const SweepInput& input = request.inputs[k];
    if (input.target == Target::Road)
      road = with_road_setting(road, input.parameter, format_exact(draw.values[k]));
    if (input.target == Target::RoadClass)
      road = with_road_setting(road, "class", input.text_of(draw.values[k]));
  }
  return with_length(road, request);
}

bool varies_dampers(const SweepRequest& request, std::size_t controller) {
  return std::ranges::any_of(request.inputs, [&](const SweepInput& input) {
    return input.target == Target::Current || input.target == Target::LagRate ||
           (input.target == Target::Damper &&
            std::ranges::any_of(
                request.controllers[controller].words.dampers,
                [&](const std::string& damper) { return input.applies_to(damper); }));
  });
}

}  // namespace dashpot
