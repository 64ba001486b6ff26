#include "dashpot/suspension/sweep/store.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"

namespace dashpot {
namespace {

// A key: the vehicle's number in decimal digits, then a hash of its controller.
constexpr std::size_t kVehicleDigits = 12, kControllerDigits = 16;

/// A text, and the hashes of the files that it names.
std::string with_files(const std::string& text) {
  std::string result = text;
  for (const std::string& part : split(text, ',')) {
    const std::string path(trim(part.substr(part.find('=') + 1)));  // also "measured,file=road.txt"
    if (std::filesystem::is_regular_file(path)) result += " " + sha256_of_file(path);
  }
  return result;
}

std::string sensor_text(const SensorOptions& s) {
  if (!s.in_car) return "ideal";
  std::string text = "in a car";
  for (const double figure :
       {s.acceleration_noise, s.acceleration_resolution, s.deflection_noise,
        s.deflection_resolution, s.delay, s.integration_corner, s.derivative_corner})
    text += ' ' + format_exact(figure);
  return text;
}

std::string key_of(const VehicleWords& words) {
  std::vector<std::string> parts;
  for (const std::string& damper : words.dampers) parts.push_back(with_files(damper));
  parts.push_back("controller " + words.controller);
  parts.push_back("inverse " + with_files(words.inverse));
  if (!words.force_loop.empty()) parts.push_back("force loop " + words.force_loop);
  for (const double figure : {words.current, words.current_max, words.lag_rate, words.sample_time})
    parts.push_back(format_exact(figure));
  parts.push_back(sensor_text(words.sensors));
  return join(parts, "; ");
}

std::string input_text(const SweepInput& input, const SweepRequest& request) {
  const Distribution& d = input.distribution;
  std::string text =
      input.name + (input.on_grid ? " grid" : "") + ' ' + std::to_string(static_cast<int>(d.kind));
  for (const double figure : {d.centre, d.spread, d.from, d.to}) text += ' ' + format_exact(figure);
  for (const double value : d.values) text += ' ' + format_exact(value);
  text += ' ' + join(input.words, " ");
  // A parameter of one controller changes the rides of that controller only: its key belongs here.
  return input.target == SweepInput::Target::Controller
             ? text + key_of(request.controllers[input.controller].words)
             : text;
}

NamedTexts basis_of(const SweepRequest& request, const std::string& program) {
  std::vector<std::string> inputs;
  for (const SweepInput& input : request.inputs) inputs.push_back(input_text(input, request));
  const VehicleWords& words = request.controllers.front().words;
  return {{"program", program},
          {"processor", "SIMD level " + std::string(name_of(simd_levels().back()))},
          {"plant", with_files(words.plant)},
          {"values", join(words.values, ", ")},
          {"road", with_files(request.road)},
          {"road_seed", request.road_seed ? std::to_string(*request.road_seed) : ""},
          {"inputs", join(inputs, "; ")},
          {"seed", std::to_string(request.seed)},
          {"drawing", request.drawing == SweepRequest::Drawing::Sobol ? "sobol" : "plain"},
          {"duration", format_exact(request.duration)},
          {"discard", format_exact(request.discard)},
          {"tolerance", format_exact(request.relative_tolerance)}};
}

/// With leading zeros, so that keys stand in the order of vehicles.
std::string vehicle_text(std::size_t vehicle) {
  std::string digits = std::to_string(vehicle);
  digits.insert(0, kVehicleDigits - std::min(digits.size(), kVehicleDigits), '0');
  return digits;
}

/// Nothing when the key does not open with a vehicle.
std::optional<std::size_t> vehicle_in(std::string_view key) {
  std::optional<std::size_t> vehicle;
  if (key.size() != kVehicleDigits + kControllerDigits) return vehicle;
  std::size_t number = 0;
  const char* end = key.data() + kVehicleDigits;
  const auto [stop, error] = std::from_chars(key.data(), end, number);
  if (stop == end && error == std::errc()) vehicle = number;
  return vehicle;
}

// The bytes of a ride: its measures, in their order. They are read on the machine that wrote them,
// or on another of its kind.
static_assert(std::endian::native == std::endian::little);

std::string bytes_of(const RideMeasures& measures) {
  std::string bytes;
  for (const SweepMeasure& measure : sweep_measures())
    bytes.append(reinterpret_cast<const char*>(&(measures.*measure.field)), sizeof(double));
  return bytes;
}

/// Nothing when these bytes are no ride.
std::optional<RideMeasures> measures_in(std::string_view bytes) {
  if (bytes.size() != sweep_measures().size() * sizeof(double)) return std::nullopt;
  RideMeasures measures;
  for (const SweepMeasure& measure : sweep_measures()) {
    std::memcpy(&(measures.*measure.field), bytes.data(), sizeof(double));
    bytes.remove_prefix(sizeof(double));
  }
  return measures;
}

}  // namespace

SweepStore::SweepStore(const std::filesystem::path& path, const SweepRequest& request,
                       const std::string& program)
    : vehicles_(request.vehicles()), store_(path, kFormat, basis_of(request, program)) {
  for (const SweepController& controller : request.controllers)
    keys_.push_back(sha256(key_of(controller.words)).substr(0, kControllerDigits));
}

std::vector<SweepStore::Ride> SweepStore::load() const {
  std::vector<Ride> rides;
  store_.for_each(
      [&](std::string_view key, std::string_view bytes) {
        const std::optional<std::size_t> vehicle = vehicle_in(key);
        const std::optional<RideMeasures> measures = measures_in(bytes);
        if (!vehicle || !measures) return;

        // Two controllers of different names may be the same: the ride is that of both.
        for (std::size_t c = 0; c < keys_.size(); ++c)
          if (key.ends_with(keys_[c])) rides.push_back({c, *vehicle, *measures});
      },
      vehicle_text(vehicles_));
  return rides;
}

void SweepStore::save(const std::vector<Ride>& rides) {
  std::vector<Store::Result> results;
  for (const Ride& ride : rides)
    results.push_back(
        {vehicle_text(ride.vehicle) + keys_[ride.controller], bytes_of(ride.measures)});
  store_.save(results);
}

}  // namespace dashpot
