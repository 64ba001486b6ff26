#include "dashpot/suspension/sweep/sweep.h"

#include <atomic>
#include <cstring>

#include <SQLiteCpp/SQLiteCpp.h>

#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ride/ride.h"
#include "dashpot/suspension/ride/weighting.h"
#include "dashpot/suspension/sweep/request_file.h"
#include "dashpot/suspension/trace.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

SweepRequest example(std::size_t samples, const std::string& more = {}) {
  return parse_sweep(
      "plant: savaresi_spelta\n"
      "dampers: \"ideal,damping_min=300,damping_max=3900\"\n"
      "controllers:\n"
      "  passive: {dampers: \"viscous,damping=1500\"}\n"
      "  skyhook: {controller: skyhook}\n"
      "road: \"iso8608_fft,class=C\"\n"
      "duration: 1 s\ndiscard: 0.2 s\nsamples: " +
          std::to_string(samples) +
          "\nvary:\n  sprung_mass: {uniform: [300 kg, 500 kg]}\n"
          "  road.speed: {uniform: [10 m/s, 30 m/s]}\n" +
          more,
      "test.yaml");
}

Sweep run(const SweepRequest& request, const fs::path& file,
          SweepOptions options = {.threads = 1}) {
  SweepStore store(file, request, "this program");
  return sweep(request, store, options);
}

bool same_bits(const Sweep& a, const Sweep& b) {
  for (std::size_t c = 0; c < a.rides.size(); ++c)
    if (std::memcmp(a.rides[c].data(), b.rides[c].data(),
                    a.rides[c].size() * sizeof(RideMeasures)) != 0)
      return false;
  return a.rides.size() == b.rides.size();
}

}  // namespace

TEST_CASE("sweep: a measured road that ends before the rides do is said") {
  const TemporaryFolder folder;
  SweepRequest request = example(1);
  request.inputs.pop_back();  // the speed
  request.road = "measured,speed=10,file=" +
                 folder.write("road.csv", "s [m],z [mm]\n0,0\n1,5\n2,3\n4,0\n").string();
  const std::string note = "the road ends after 0.4 s of 1 s";
  CHECK(run(request, folder.path() / "a.sqlite").notes.back().find(note) == 0);
  request.duration = 0.4;
  CHECK(run(request, folder.path() / "b.sqlite").notes.back().find(note) == std::string::npos);
}

TEST_CASE("a sweep tells what drives its dampers, where that is one thing") {
  const auto drive = [](const std::string& dampers, const std::string& other) {
    const TemporaryFolder folder;
    return run(parse_sweep("plant: savaresi_spelta\nroad: iso8608_fft\nduration: 1 s\n"
                           "discard: 0.2 s\nsamples: 1\ncontrollers:\n"
                           "  passive: {dampers: viscous}\n  one: {controller: skyhook, dampers: " +
                               dampers + "}\n  other: {controller: skyhook, dampers: " + other +
                               "}\n",
                           "test.yaml"),
               folder.path() / "sweep.sqlite")
        .drive;
  };
  CHECK(drive("ideal", "ideal") == DriveUnit::None);
  CHECK(drive("spencer1997", "spencer1997") == DriveUnit::Volt);
  CHECK(drive("ideal", "spencer1997") == std::nullopt);
  CHECK(drive("mr1", "mr1") == DriveUnit::Ampere);
}

TEST_CASE("a sweep tells what its vehicles stand on") {
  const TemporaryFolder folder;
  CHECK(run(example(1), folder.path() / "car.sqlite").foot == "tyre");
  const SweepRequest seated = parse_sweep(
      "plant: seated_driver\nroad: \"iso8608_fft,class=C\"\nduration: 1 s\ndiscard: 0.2 "
      "s\nsamples: 1\n"
      "controllers: {passive: {dampers: \"viscous,damping=400\"}}\n"
      "vary: {thigh_mass: {uniform: [10 kg, 15 kg]}}\n",
      "test.yaml");
  CHECK(run(seated, folder.path() / "seat.sqlite").foot == "seat");
}

TEST_CASE("a sweep's measures are those of simulate() and of the ride's own functions") {
  const TemporaryFolder folder;
  const SweepRequest request = example(3);
  const Sweep result = run(request, folder.path() / "sweep.sqlite");
  for (std::size_t c = 0; c < 2; ++c) {
    CAPTURE(c);
    const SweepDraw& draw = result.vehicles[2];
    const Vehicle vehicle = make_vehicle(vehicle_words(request, c, draw));
    const GroundPointer road = make_ground(road_words(request, draw), draw.road_seed);
    SimulateOptions options = vehicle.options(1);
    options.output_step = 1e-3;
    const Record record = simulate(vehicle.on(*road), options).record;
    const RideComfort comfort =
        ride_comfort(find_weighting("Wk"), record.channel("body_acceleration").samples, 1e-3, 0.2);
    const RideMeasures& ride = result.rides[c][2];
    CHECK_CLOSE(ride.body_acceleration, comfort.rms, 1e-4, 0);
    CHECK_CLOSE(ride.weighted_acceleration, comfort.weighted_rms, 1e-4, 0);
    CHECK_CLOSE(ride.vibration_dose, comfort.vdv, 1e-4, 0);
    double greatest = 0, squares = 0;
    const auto& travel = record.channel("suspension_deflection").samples;
    const auto& load = record.channel("tyre_load").samples;
    const double rest = vehicle.set.plant.tyres[0].static_load;
    for (std::size_t k = 200; k < travel.size(); ++k) {
      greatest = std::max(greatest, std::abs(travel[k]));
      squares += (load[k] - rest) * (load[k] - rest);
    }
    CHECK_CLOSE(ride.greatest_travel, greatest, 1e-4, 0);
    CHECK_CLOSE(ride.tyre_load_index,
                std::sqrt(squares / static_cast<double>(travel.size() - 200)) / rest, 1e-4, 0);
    CHECK_CLOSE(ride.energy, damper_energy(record, vehicle.set.plant.struts[0], 200), 1e-5, 0);
    CHECK(ride.stops_met == 0);
    CHECK(!ride.has_diverged());
  }
}

TEST_CASE("stops and limits of data are met where they are") {
  const TemporaryFolder folder;
  const Sweep free = run(example(2), folder.path() / "free.sqlite");
  const Sweep stopped = run(example(2, "values: {extension_stop: 5 mm, compression_stop: 5 mm}\n"),
                            folder.path() / "stopped.sqlite");
  CHECK(stopped.rides[0][0].stops_met > 0);
  CHECK(stopped.rides[0][0].greatest_travel < free.rides[0][0].greatest_travel);
  CHECK(free.rides[0][0].stops_met == 0);
}

TEST_CASE("the same bits for any number of threads, and for any interruption" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const SweepRequest request = example(80);
  const Sweep one = run(request, folder.path() / "one.sqlite");
  CHECK(same_bits(one, run(request, folder.path() / "two.sqlite", {.threads = 2})));

  const fs::path file = folder.path() / "stopped.sqlite";
  std::atomic<bool> stop = false;
  SweepOptions options{.threads = 1};
  options.monitor.stop = &stop;
  options.monitor.on_progress = [&](const Progress& progress) { stop = progress.fraction < 1; };
  CHECK_THROWS_AS(run(request, file, options), Interrupted);
  const Sweep resumed = run(request, file);
  CHECK(resumed.kept == 64);  // a block of 32 vehicles
  CHECK(same_bits(one, resumed));
  CHECK(run(request, file).kept == 160);
}

TEST_CASE("more samples and other controllers go on where fewer ended") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "sweep.sqlite";
  run(example(5), file);
  const Sweep more = run(example(40), file);
  CHECK(more.kept == 10);
  CHECK(same_bits(more, run(example(40), folder.path() / "whole.sqlite")));
  SweepRequest third = example(40);
  third.controllers.push_back({"groundhook", third.controllers[1].words});
  third.controllers.back().words.controller = "groundhook";
  const Sweep with_third = run(third, file);
  CHECK(with_third.kept == 80);
  CHECK(with_third.rides.size() == 3);
  const Sweep fewer = run(example(5), file);
  CHECK(fewer.kept == 10);
  CHECK(fewer.rides[0].size() == 5);
}

TEST_CASE("another sweep's file is refused with what differs") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "sweep.sqlite";
  run(example(2), file);
  const auto message = [&](const SweepRequest& request) {
    return message_of([&] { run(request, file); });
  };
  SweepRequest other = example(2);
  other.seed = 2;
  CHECK(message(other).find("holds another sweep (seed: '1' there, '2' here)") !=
        std::string::npos);
  other = example(2);
  other.inputs.pop_back();
  CHECK(message(other).find("holds another sweep (inputs: ") != std::string::npos);
}

TEST_CASE("a sweep that an older version kept is refused with what to do, and stays as it is") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "sweep.sqlite";
  {
    SQLite::Database older(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    older.exec(
        "PRAGMA application_id = 1146114888; PRAGMA user_version = 1;"
        "CREATE TABLE sweep (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;"
        "INSERT INTO sweep VALUES ('seed', '1');"
        "CREATE TABLE ride (controller TEXT NOT NULL, vehicle INTEGER NOT NULL, travel REAL,"
        " PRIMARY KEY (vehicle, controller)) STRICT, WITHOUT ROWID;"
        "INSERT INTO ride VALUES ('skyhook', 0, 0.1);");
  }
  const std::string before = read_file(file);
  CHECK(message_of([&] { run(example(2), file); }) ==
        file.string() +
            ": was written by an older version of Dashpot, which this one cannot read; give "
            "another --output, or begin anew with --fresh");
  CHECK(read_file(file) == before);
}

TEST_CASE("a damaged ride is made again in its place") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "sweep.sqlite";
  const SweepRequest request = example(2);
  const Sweep whole = run(request, file);
  {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec("UPDATE result SET bytes = x'00' WHERE key < '000000000001'");
  }
  const Sweep mended = run(request, file);
  CHECK(mended.kept == 2);
  CHECK(same_bits(whole, mended));
  CHECK(run(request, file).kept == 4);
}

TEST_CASE("what does not fit together is told before anything rides") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& yaml) {
    return message_of([&] { run(parse_sweep(yaml, "test.yaml"), folder.path() / "sweep.sqlite"); });
  };
  CHECK(
      message(
          "plant: savaresi_spelta\nroad: iso8608_fft\ncontrollers: {wild: {controller: skyhok}}\n")
          .find("test.yaml, wild: unknown controller 'skyhok'") != std::string::npos);
  CHECK(message("plant: savaresi_spelta\nroad: iso8608_fft\ndampers: nothing\n")
            .find("unknown damper") != std::string::npos);
}
