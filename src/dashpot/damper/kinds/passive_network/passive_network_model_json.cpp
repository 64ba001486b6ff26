#include <cmath>

#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// The parts of the numbers by their names in files, in their order.
struct Part {
  const char* name;
  std::size_t first, count;
};
std::vector<Part> parts(const PassiveSizes& sizes) {
  const PassiveLayout at(sizes);
  const std::vector<std::pair<const char*, std::size_t>> starts{
      {"neurons", at.weights},
      {"gates", at.gates},
      {"viscous_neurons", at.viscous_weights},
      {"viscous", at.viscous},
      {"levers", at.levers},
      {"stiffness", at.stiffness},
      {"memory_rates", at.memory_rates},
      {"saturation", at.saturation},
      {"potential", at.potential},
      {"drive_rate", at.drive_rate},
      {"inertia", at.inertia},
      {"inertia_rate", at.inertia_rate}};
  std::vector<Part> all;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::size_t end = k + 1 < starts.size() ? starts[k + 1].second : at.count;
    all.push_back({starts[k].first, starts[k].second, end - starts[k].second});
  }
  return all;
}

std::size_t count_of(ObjectReader& reader, const char* key, std::size_t most) {
  const double count = reader.number(key);
  if (!(count >= 0) || count > static_cast<double>(most) || count != std::floor(count))
    throw Error(reader.required(key).where(), "is no count", "0 to " + std::to_string(most));
  return static_cast<std::size_t>(count);
}

PassiveNetwork read_passive_network(const Value& value) {
  ObjectReader reader(value, "a passive network");
  // Earlier ones read the drive in another way, which nothing computes any more.
  if (value.find("levers") && !value.find("drive_fade"))
    throw Error(value.where(), "is a passive network of an earlier Dashpot, without 'drive_fade'",
                "identify it again from its recordings");

  PassiveNetwork n;
  n.sizes = {count_of(reader, "springs", PassiveNetwork::kMaxSprings),
             count_of(reader, "memories", PassiveNetwork::kMaxMemories),
             count_of(reader, "hidden", PassiveNetwork::kMaxNeurons),
             count_of(reader, "viscous_hidden", PassiveNetwork::kMaxNeurons)};
  n.lags = reader.required("lags").as_bool();
  n.inert = reader.required("inert").as_bool();

  // Scales and ranges.
  n.displacement_mean = reader.number("displacement_mean");
  n.displacement_scale = reader.number("displacement_scale");
  read_range(reader, "displacement_range", n.displacement_low, n.displacement_high);
  n.velocity_scale = reader.number("velocity_scale");
  read_range(reader, "velocity_range", n.velocity_low, n.velocity_high);
  n.drive_scale = reader.number("drive_scale");
  read_range(reader, "drive_range", n.drive_low, n.drive_high);
  n.drive_fade = reader.number("drive_fade");
  n.force_scale = reader.number("force_scale");
  n.model_step = reader.number("model_step");

  // The numbers, part by part.
  for (const Part& part : parts(n.sizes)) {
    const std::vector<double> numbers = reader.required(part.name).as_numbers();
    if (numbers.size() != part.count)
      throw Error(reader.required(part.name).where(),
                  "has " + std::to_string(numbers.size()) + " numbers",
                  std::to_string(part.count) + " for a network of this size");
    n.numbers.insert(n.numbers.end(), numbers.begin(), numbers.end());
  }
  reader.finish();
  return n;
}

}  // namespace

Value PassiveNetwork::to_json() const {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  Value out =
      Value::object({{"springs", count(sizes.springs)},
                     {"memories", count(sizes.memories)},
                     {"hidden", count(sizes.neurons)},
                     {"viscous_hidden", count(sizes.viscous_neurons)},
                     {"lags", lags},
                     {"inert", inert},
                     {"displacement_mean", displacement_mean},
                     {"displacement_scale", displacement_scale},
                     {"displacement_range", range_value(displacement_low, displacement_high)},
                     {"velocity_scale", velocity_scale},
                     {"velocity_range", range_value(velocity_low, velocity_high)},
                     {"drive_scale", drive_scale},
                     {"drive_range", range_value(drive_low, drive_high)},
                     {"drive_fade", drive_fade},
                     {"force_scale", force_scale},
                     {"model_step", model_step}});
  for (const Part& part : parts(sizes)) {
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(part.first);
    out.add(part.name, Value::array(std::vector<double>(
                           first, first + static_cast<std::ptrdiff_t>(part.count))));
  }
  return out;
}

std::unique_ptr<PassiveNetworkModel> passive_network_model_from_json(const Value& value) {
  return stateful_ensemble_from_json<PassiveNetworkModel>(value, "a passive network model",
                                                          read_passive_network);
}

}  // namespace dashpot
