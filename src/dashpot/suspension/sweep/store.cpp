#include "dashpot/suspension/sweep/store.h"

#include <algorithm>
#include <limits>
#include <map>

#include <SQLiteCpp/SQLiteCpp.h>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

/// A text, and what is in the files that it names.
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
  // What is told to one controller's law tells that controller's rides from others.
  return input.target == SweepInput::Target::Controller
             ? text + key_of(request.controllers[input.controller].words)
             : text;
}

NamedTexts basis_of(const SweepRequest& request, const std::string& program) {
  std::vector<std::string> inputs;
  for (const SweepInput& input : request.inputs) inputs.push_back(input_text(input, request));
  const VehicleWords& words = request.controllers.front().words;
  return {{"program", program},
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

ResultKind kind() {
  std::string tables = "CREATE TABLE ride (controller TEXT NOT NULL, vehicle INTEGER NOT NULL";
  for (const SweepMeasure& measure : sweep_measures())
    tables += ", " + std::string(measure.name) + " REAL";
  return {"sweep", 1, tables + ", PRIMARY KEY (vehicle, controller)) STRICT, WITHOUT ROWID;"};
}

}  // namespace

SweepStore::SweepStore(const std::filesystem::path& path, const SweepRequest& request,
                       const std::string& program)
    : vehicles_(request.vehicles()), file_(path, kind(), basis_of(request, program)) {
  for (const SweepController& controller : request.controllers)
    keys_.push_back(key_of(controller.words));
}

void SweepStore::remove(const std::filesystem::path& path) { ResultFile::remove(path, kind()); }

std::vector<SweepStore::Ride> SweepStore::load() const {
  std::vector<Ride> rides;
  file_.with([&](SQLite::Database& database) {
    SQLite::Statement select(database, "SELECT * FROM ride WHERE vehicle < ? ORDER BY vehicle");
    select.bind(1, static_cast<std::int64_t>(vehicles_));
    while (select.executeStep()) {
      const std::string key = select.getColumn(0).getString();
      Ride ride{.vehicle = static_cast<std::size_t>(select.getColumn(1).getInt64())};
      int column = 2;
      for (const SweepMeasure& measure : sweep_measures()) {
        const SQLite::Column value =
            select.getColumn(column++);  // SQLite keeps not-a-number as null
        ride.measures.*measure.field =
            value.isNull() ? std::numeric_limits<double>::quiet_NaN() : value.getDouble();
      }
      // Controllers of two names may be alike.
      for (ride.controller = 0; ride.controller < keys_.size(); ++ride.controller)
        if (keys_[ride.controller] == key) rides.push_back(ride);
    }
  });
  return rides;
}

void SweepStore::save(const std::vector<Ride>& rides) {
  file_.with([&](SQLite::Database& database) {
    std::string marks = "?, ?";
    for (std::size_t k = 0; k < sweep_measures().size(); ++k) marks += ", ?";
    SQLite::Transaction transaction(database);
    SQLite::Statement insert(database, "INSERT OR IGNORE INTO ride VALUES (" + marks + ")");
    for (const Ride& ride : rides) {
      int column = 1;
      insert.bind(column++, keys_[ride.controller]);
      insert.bind(column++, static_cast<std::int64_t>(ride.vehicle));
      for (const SweepMeasure& measure : sweep_measures())
        insert.bind(column++, ride.measures.*measure.field);
      insert.exec();
      insert.reset();
    }
    transaction.commit();
  });
}

}  // namespace dashpot
