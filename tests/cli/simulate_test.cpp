#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("simulate: measures against passive, a page and both traces") {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const ProgramResult result =
      run_dashpot("simulate --controller mix1 --duration 3 --road bump --output " + out);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.output, "Against viscous, 1500 N*s/m: "));
  CHECK(contains(result.output, "the numbers of savaresi_spelta are an example"));
  CHECK(read_file(out + "/trace.csv").starts_with("time [s],body [m],body_velocity [m/s],"));
  CHECK(contains(read_file(out + "/report.html"), "Quarter car of Savaresi and Spelta"));
  CHECK(std::filesystem::exists(out + "/against.csv"));
}

TEST_CASE("simulate: a car on a road of one track is said not to roll" *
          doctest::test_suite("long")) {
  const std::string car = "simulate --plant ikenaga2000 --duration 1 --road iso8608_fft,length=50";
  CHECK(contains(run_dashpot(car).output, "the car does not roll"));
  CHECK(!contains(run_dashpot(car + ",track_width=1.5m").output, "the car does not roll"));
  CHECK(!contains(run_dashpot("simulate --duration 1 --road iso8608_fft,length=50").output,
                  "does not roll"));
}

TEST_CASE("simulate: a seat is said to have no vehicle below it") {
  const std::string run = "simulate --damper viscous --duration 1 --road bump --plant ";
  CHECK(
      contains(run_dashpot(run + "seated_driver").output, "the seat stands on the ground itself"));
  CHECK(!contains(run_dashpot(run + "quarter_car").output, "stands on the ground"));
}

TEST_CASE("simulate: what a short run and fixed steps cannot tell is said") {
  // 15 s and more leave out their start, and a bump is all start.
  const std::string road = "simulate --against none --road iso8608_fft,length=50 --duration ";
  CHECK(contains(run_dashpot(road + "2").output, "too short a run to leave out its start"));
  CHECK(!contains(run_dashpot(road + "15").output, "too short a run"));
  CHECK(!contains(run_dashpot("simulate --road bump --duration 2").output, "too short a run"));

  // Fixed steps of 1 ms let a strut leave hard stops of 10 mm by 60 mm (stop_stiffness=1e9).
  const std::string stops =
      "simulate --damper viscous,damping=500 --road sine,amplitude=2cm,frequency=2 --duration 2 "
      "--plant quarter_car --set extension_stop=0.01,compression_stop=0.01";
  CHECK(contains(run_dashpot(stops).output, "a stop is met in"));
  CHECK(!contains(run_dashpot(stops).output, "steps that are fixed"));
  CHECK(contains(run_dashpot(stops + " --max-step 1").output, "steps that are fixed"));
}

TEST_CASE("simulate: JSON, MATLAB traces, no comparison") {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const ProgramResult result = stdout_of_dashpot(
      "simulate --json --controller skyhook --road step --duration 1 --against none --mat "
      "--output " +
      out);
  REQUIRE(result.exit_code == 0);
  const Value data = parse_json(result.output, "stdout");
  CHECK(data.find("plant")->as_string() == "savaresi_spelta");
  CHECK(data.find("against")->is_null());
  CHECK(contains(data.find("remarks")->items().back().as_string(), "are an example"));
  CHECK(data.find("run")->find("damping_max")->as_number() == 3900);
  CHECK(std::filesystem::exists(out + "/trace.mat"));
}

TEST_CASE("simulate: a damper of a model file on a lever, asked beyond its data, is told of") {
  const TemporaryFolder folder;
  const std::string results = (folder.path() / "fit").string();
  REQUIRE(run_dashpot("identify " + small_campaign().string() +
                      " --models bingham --no-report --output " + results)
              .exit_code == 0);
  const ProgramResult result = run_dashpot(
      "simulate --damper " + results +
      "/models/bingham.json,motion_ratio=0.8 --controller skyhook --inverse polynomial --road "
      "iso8608,class=E --duration 3");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.output,
                 "bingham.json, motion ratio 0.8 is asked beyond its data: velocity "));
  CHECK(contains(result.output, "N*s/m between 0 and 2 V at the strut"));
}

TEST_CASE("simulate: what there is to choose from" * doctest::test_suite("long")) {
  CHECK(contains(run_dashpot("simulate --list plants").output, "dyke_spencer1996"));
  CHECK(contains(run_dashpot("simulate --list controllers").output, "sh_add"));
  CHECK(contains(run_dashpot("simulate --list roads").output, "earthquake"));
  CHECK(contains(run_dashpot("simulate --list dampers").output, "suv_front"));
  const ProgramResult json = stdout_of_dashpot("simulate --list controllers --json");
  CHECK(parse_json(json.output, "stdout").items().size() >= 13);
}

TEST_CASE("simulate: wrong command lines" * doctest::test_suite("long")) {
  const struct {
    const char *arguments, *message;
    int exit_code;
  } cases[] = {
      {"--set sprung_mass=-5", "vehicle: sprung_mass is -5 kg; between 1 and 1e+06 kg", 1},
      {"--controller skyhok", "vehicle: unknown controller 'skyhok'; did you mean 'skyhook'?", 1},
      {"--damper viscos", "vehicle: unknown damper 'viscos'; did you mean 'viscous'?", 1},
      {"--plant quartercar", "unknown plant 'quartercar'; did you mean 'quarter_car'?", 1},
      {"--road isso8608",
       "--road: unknown motion of the ground 'isso8608'; did you mean 'iso8608'?", 1},
      {"--road iso8608,class=A,class=E", "--road: class is stated twice", 1},
      {"--damper viscous,damping=1,damping=2", "vehicle: damping is stated twice", 1},
      {"--damper spencer1997,x0=0,x0=1", "vehicle: x0 is stated twice", 1},
      {"--controller mix1,crossover=1Hz,crossover=2Hz", "vehicle: crossover is stated twice", 1},
      {"--duration 1e-9", "holds no sample but the first", 1},
      {"--controller mix1 --sample-time 0",
       "vehicle: the controller's sample time is 0 s; between 10 us and 1 s", 1},
      {"--controller mix1 --max-step 5",
       "simulation: its step is longer than the controller's sample time; at most 0.001 s", 1},
      {"--duration -1", "--duration: -1 is too small", 2},
      {"--duration 0", "--duration: 0 is no value of it; another one, or leave it out: 20 on", 2},
      {"--current-max 0", "--current-max: 0 is no value of it", 2},
      {"--max-step 0", "--max-step: 0 is no value of it", 2},
      {"--list cars", "unknown list 'cars'", 2},
      {"--plant dyke_spencer1996 --damper spencer1997 --road step",
       "--road: 'step' moves no building; earthquake,file=...", 1},
      {"--inverse numerik --damper spencer1997 --controller skyhook",
       "unknown inverse 'numerik'; did you mean 'numeric'?", 1},
      {"--tolerance 0", "simulation: a tolerance is not above 0", 1},
      {"--inverse numeric --damper spencer1997",
       "--inverse: serves a controller, and there is none; name one with --controller", 2},
      {"--in-car", "--in-car: serves a controller, and there is none", 2},
      {"--delay 2", "--delay: serves a controller, and there is none", 2},
      {"--controller skyhook --delay 2", "--delay: is of the sensors of a car", 2},
      {"--controller mix1 --current 0.5",
       "--current: is where there is no controller, which chooses its own; leave it out", 2},
  };
  for (const auto& c : cases) {
    CAPTURE(c.arguments);
    const ProgramResult result = run_dashpot(std::string("simulate ") + c.arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == c.exit_code);
    CHECK(contains(result.output, c.message));
  }
}

TEST_CASE("simulate: both traces as plain samples, for programs that draw") {
  const TemporaryFolder folder;
  const std::string samples = (folder.path() / "samples").string();
  REQUIRE(run_dashpot("simulate --controller mix1 --duration 1 --road bump --samples " + samples)
              .exit_code == 0);
  const Value index = parse_json(read_file(samples + "/samples.json"), "samples.json");
  const std::vector<Value>& runs = index.find("records")->items();
  REQUIRE(runs.size() == 2);  // the run, and the passive one
  std::size_t columns = 0;
  for (const Value& run : runs) {
    CHECK(run.find("samples")->as_number() == 1001);
    columns += run.find("columns")->items().size();
  }
  CHECK(std::filesystem::file_size(samples + "/samples.f64") == columns * 1001 * sizeof(double));
}

TEST_CASE(
    "simulate: a road that ends before the ride does is said, and so is an inverse of another "
    "drive") {
  const TemporaryFolder folder;
  const std::string road =
      "simulate --road measured,file=" +
      folder.write("road.csv", "s [m],z [mm]\n0,0\n1,5\n2,3\n20,0\n").string() + ",speed=10";
  CHECK(contains(run_dashpot(road + " --duration 4").output,
                 "the road ends after 2 s of 4 s: from there on it is level"));
  CHECK(!contains(run_dashpot(road).output, "the road ends"));

  const std::string inverse = (folder.path() / "inverse.json").string();
  REQUIRE(run_dashpot("invert --recordings " + small_campaign().string() +
                      " --network history --output " + inverse)
              .exit_code == 0);
  const ProgramResult wrong =
      run_dashpot("simulate --controller skyhook --duration 1 --inverse " + inverse);
  CHECK(wrong.exit_code == 1);
  CHECK(contains(wrong.output, "gives V, but the damper takes a number without a unit"));
}

TEST_CASE("simulate: the same bits on a processor without AVX-512" * doctest::test_suite("long")) {
  if (run_program("command -v qemu-x86_64").exit_code != 0) {
    MESSAGE("SKIPPED: no qemu-x86_64 is here");
    return;
  }
  const std::string arguments =
      " simulate --controller mix1 --road iso8608,class=C --duration 0.5 --json";
  const std::string here = "DASHPOT_SIMD=avx2 ", there = here + "qemu-x86_64 -cpu Haswell ";
  const auto printed = [&](const std::string& how) {
    return run_program("( " + how + program_path() + arguments + " 2>/dev/null )");
  };
  const ProgramResult native = printed(here), emulated = printed(there);
  REQUIRE(native.exit_code == 0);
  CHECK(native.output == emulated.output);
}
