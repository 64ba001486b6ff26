#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

const char* const kRoadlessCar =
    "plant: quarter_car\n"
    "parameters:\n"
    "  unsprung_mass: 139.5 kg\n"
    "  spring_stiffness: 37300 N/m\n"
    "  sprung_mass: 387 kg\n"
    "  tyre_stiffness: unknown\n"
    "inputs:\n"
    "  - {kind: ground, class: C, speed: 20 m/s}\n"
    "sensors:\n"
    "  - {channel: az_body, quantity: acceleration, at: body}\n"
    "  - {channel: az_wheel, quantity: acceleration, at: wheel}\n"
    "  - {channel: level, quantity: deflection}\n"
    "voltage: coil\n";

}  // namespace

TEST_CASE("bench --in and observe: rides of a car, and the force that no sensor showed" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string car = folder.write("car.yaml", kRoadlessCar).string(),
                    rides = (folder.path() / "rides").string(),
                    seen = (folder.path() / "seen").string();
  const ProgramResult made =
      run_dashpot("bench --in " + car + " --levels 1 --duration 3 --output " + rides);
  REQUIRE(made.exit_code == 0);
  CHECK(contains(made.output, "1 ride of the quarter_car, 3 s each, at 1 V, on iso8608"));
  CHECK(
      contains(made.output, "Unknown     truly tyre_stiffness 295200 N/m (--true states others)"));
  CHECK(contains(read_file(rides + "/ride_1.csv"), "time [s],az_body [m/s^2],az_wheel [m/s^2]"));
  CHECK(contains(read_file(rides + "/truth/plant.json"), "\"tyre_stiffness\": 295200"));

  // The same seed gives the same files.
  const std::string again = (folder.path() / "again").string();
  run_dashpot("bench --in " + car + " --levels 1 --duration 3 --output " + again);
  CHECK(read_file(again + "/ride_1.csv") == read_file(rides + "/ride_1.csv"));

  const std::string model = (folder.path() / "spencer.json").string();
  save_model(to_model_file(load_parameter_set("spencer1997")), model);
  // The folder of the rides stands for them; their truth, deeper in it, is no recording.
  const std::string with = "observe " + model + " --in " + rides + "/truth/plant.json " + rides +
                           " --truth " + rides + "/truth --force-error 5@0.01";
  const ProgramResult result = stdout_of_dashpot(with + " --output " + seen + " --json");
  REQUIRE(result.exit_code == 0);
  const Value report = parse_json(result.output, "stdout");
  const Value& force = report.find("truth")->items()[0];
  CHECK(force.find("quantity")->as_string() == "damper_force");
  CHECK(force.find("error")->as_number() < 0.01 * force.find("span")->as_number());
  CHECK(force.find("inside")->as_number() > 0.6);
  CHECK(contains(read_file(seen + "/report.html"), "A plant observed"));
  CHECK(contains(read_file(seen + "/ride_1_observed.csv"),
                 "time [s],damper_force [N],damper_force_half_band [N]"));

  // The same in other units: the page's alone, and the CSV's.
  const ProgramResult lbf = run_dashpot(with + " --units lbf,in/s --output " + seen);
  CHECK(contains(lbf.output, "lbf"));
  CHECK_FALSE(contains(lbf.output, " mm"));
  CHECK(contains(read_file(seen + "/ride_1_observed.csv"),
                 "time [s],damper_force [lbf],damper_force_half_band [lbf]"));

  // The plant's table does not know what its file expects.
  std::string expected = kRoadlessCar;
  expected.replace(expected.find("unknown"), 7, "{about: 90 kN/m}");
  const ProgramResult far =
      run_dashpot("bench --in " + folder.write("far.yaml", expected).string() +
                  " --levels 1 --duration 1 --output " + again + "_far");
  CHECK(contains(far.output,
                 "tyre_stiffness is truly 295200 N/m, and the plant's file says about "
                 "90000 N/m: if that is not meant, --true tyre_stiffness=90000"));
  CHECK_FALSE(contains(made.output, "if that is not meant"));

  // What cannot be used.
  CHECK(contains(run_dashpot("observe spencer1997 --in " + car + " " + rides).output,
                 "is a published damper, and no file; a model file that 'dashpot identify --in'"));
  CHECK(contains(run_dashpot(with + " --units furlong").output, "--units: "));
  CHECK(contains(
      run_dashpot("bench --in " +
                  folder
                      .write("amperes.yaml",
                             std::string(kRoadlessCar)
                                 .replace(std::string(kRoadlessCar).find("voltage"), 7, "current"))
                      .string() +
                  " --output " + again)
          .output,
      "takes V, and the plant states A; 'voltage' or 'current' of the plant"));
  CHECK(contains(
      run_dashpot("observe " + model + " --in " + car + ' ' + rides + "/ride_1.csv").output,
      "tyre_stiffness: is unknown"));
  CHECK(contains(run_dashpot(with + ",x@1").output, "--force-error: is 'x@1'; newtons @ seconds"));
  CHECK(contains(run_dashpot(with + ",x").output, "--force-error: is 'x'; newtons @ seconds"));
  CHECK(contains(run_dashpot(with + ",20").output, "N, which stay (--force-error 5@0.01,20)"));
  CHECK(contains(run_dashpot(with + " --velocity-shift 4").output,
                 "--velocity-shift: is '4'; m/s @ seconds, as 0.004@0.015"));
  CHECK(contains(run_dashpot(with + " --velocity-shift 0.004@0.02 --output " + seen).output,
                 "The model's force goes by a velocity within 4 mm/s of the damper's, forgotten in "
                 "0.02 s (--velocity-shift 0.004@0.02)."));
  CHECK(contains(run_dashpot("observe " + model + ' ' + rides + "/ride_1.csv").output,
                 "--in: is missing"));

  // The road is not needed to identify a damper either; one sensor alone would need it.
  const std::string found = (folder.path() / "found").string();
  const ProgramResult fitted = run_dashpot("identify " + rides + "/ride_1.csv --in " + car +
                                           " --models tanh_guo --output " + found);
  CHECK(contains(fitted.output, "Sensors, one sample ahead"));
  CHECK(contains(read_file(found + "/plants/tanh_guo.json"), "\"tyre_stiffness\""));
  CHECK(contains(read_file(found + "/models/tanh_guo.json"), "tanh_guo"));

  // The noise that it found goes into both files, and is taken where the plant states none.
  CHECK(contains(fitted.output, "Noise that was not stated was found"));
  CHECK(contains(read_file(found + "/plants/tanh_guo.json"), "\"noise_found\": \"0.0"));
  CHECK(load_model(found + "/models/tanh_guo.json").noise_found.size() >= 2);
  const std::string guo = found + "/models/tanh_guo.json";
  CHECK(contains(run_dashpot("observe " + guo + " --in " + found + "/plants/tanh_guo.json " +
                             rides + "/ride_1.csv --output " + seen)
                     .output,
                 ", as identified (the plant's file)."));
  std::string own = kRoadlessCar;
  own.replace(own.find("unknown"), 7, "295200 N/m");
  const std::string mine = folder.write("own.yaml", own).string();
  const ProgramResult unstated = run_dashpot("observe " + guo + " --in " + mine + ' ' + rides +
                                             "/ride_1.csv --output " + seen);
  CHECK(contains(unstated.output, ", as identified (" + guo + ")."));
  CHECK_FALSE(contains(unstated.output, "neither plant nor model"));
  CHECK(contains(run_dashpot("export " + guo + " --in " + mine +
                             " --force-error 5@0.01 --to c --output " + seen)
                     .output,
                 "Noise not stated, as 'identify --in' found it (" + guo + "): az_body 0.0"));
  own.replace(own.find("body}"), 5, "body, noise: 0.05}");
  CHECK(
      contains(run_dashpot("observe " + guo + " --in " + folder.write("stated.yaml", own).string() +
                           ' ' + rides + "/ride_1.csv --output " + seen)
                   .output,
               ", as stated."));
  std::string alone = kRoadlessCar;
  const std::size_t others = alone.find("  - {channel: az_wheel");
  alone.erase(others, alone.find("voltage:") - others);
  CHECK(contains(run_dashpot("identify " + rides + "/ride_1.csv --in " +
                             folder.write("alone.yaml", alone).string() + " --models tanh_guo")
                     .output,
                 "there is one, and nothing measures the road"));
  CHECK(contains(
      run_dashpot("bench --in " + car + " --true sprung_mass=300kg --output " + again).output,
      "sprung_mass is known"));
  for (const char* option : {"--push 100", "--cycles 3", "--noise 0.5"})
    CHECK(run_dashpot("bench --in " + car + ' ' + option + " --output " + again).exit_code == 2);
  write_file(again + "/ride_7.csv", "");
  CHECK(contains(
      run_dashpot("bench --in " + car + " --levels 1 --duration 3 --output " + again).output,
      "ride_7.csv: is a ride of an earlier campaign"));
  std::filesystem::remove(again + "/ride_7.csv");
  CHECK(contains(run_dashpot("bench --in " + car + " --motions 10x1 --output " + again).output,
                 "a plant is moved by its road or a force"));
  for (const auto& [option, said] :
       {std::pair{"--levels 0,1,2 --hold 99 --duration 2",
                  "--hold: 3 levels of 99 s each do not fit into a ride of 2 s; --duration 297"},
        {"--wear force=-2", "--wear: force is -2, more than the whole; force=-0.1, 10 % less"},
        {"--wear force=-0.1,force=-0.2", "--wear: force is stated twice"},
        {"--duration 1e30", "a ride would have 5e+32 samples; at most 1e+07"},
        {"--hold 1e-30", "--hold: 1e-30 s is less than a sample; 0.002 s or more"}}) {
    const ProgramResult refused =
        run_dashpot("bench --in " + car + ' ' + option + " --output " + again);
    CHECK(contains(refused.output, said));
    CHECK(refused.exit_code != 0);
  }
  CHECK(contains(run_dashpot("bench --grade exact --output " + again).output,
                 "--grade: has no effect without --in"));

  // The same observer as C.
  const std::string c = (folder.path() / "ecu").string();
  const ProgramResult exported =
      run_dashpot("export " + model + " --in " + rides +
                  "/truth/plant.json --force-error 5@0.01 --velocity-shift 0.004@0.02 --to c "
                  "--name cell --output " +
                  c);
  CHECK(exported.exit_code == 0);
  CHECK(contains(read_file(c + "/cell.h"), "Sensors: az_body (m/s^2), az_wheel (m/s^2)"));
  CHECK(contains(read_file(c + "/cell.c"), "kFilter = {4, 0, 1, 1, 1, 1, 1, 3, 1, "));
  CHECK(contains(
      run_dashpot("export " + model + " --in " + rides + "/truth/plant.json --to c --output " + c)
          .output,
      "--force-error: is not stated; what 'dashpot observe' prints"));
}

TEST_CASE("observe: dampers of a half car by the names of their struts" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string car =
      folder
          .write("half.yaml",
                 "plant: half_car\n"
                 "parameters: {mass: 690 kg, inertia: 1222 kg*m^2, front_wheel_mass: 80 kg,\n"
                 "  rear_wheel_mass: 90 kg, front_stiffness: 17 N/mm, rear_stiffness: 22 N/mm,\n"
                 "  front_tyre_stiffness: 200 N/mm, rear_tyre_stiffness: 200 N/mm,\n"
                 "  front_distance: 1.3 m, rear_distance: 1.5 m}\n"
                 "inputs:\n"
                 "  - {channel: road_front, kind: ground, at: front, noise: 0.2 mm}\n"
                 "  - {channel: road_rear, kind: ground, at: rear, noise: 0.2 mm}\n"
                 "sensors:\n"
                 "  - {channel: az_front, quantity: acceleration, at: front_wheel, noise: 0.5}\n"
                 "  - {channel: level_rear, quantity: deflection, at: rear, noise: 0.2 mm}\n"
                 "voltage: coil\n")
          .string();
  for (const char* name : {"spencer1997", "braz_cesar_barros2013"})
    save_model(to_model_file(load_parameter_set(name)),
               folder.path() / (std::string(name) + ".json"));
  const std::string spencer = (folder.path() / "spencer1997.json").string(),
                    rides = (folder.path() / "rides").string();
  REQUIRE(
      run_dashpot("bench --in " + car + " --levels 1 --duration 1 --output " + rides).exit_code ==
      0);

  // One model for both dampers, then one each, of which the order does not matter.
  const std::string with = " --in " + car + ' ' + rides + " --truth " + rides +
                           "/truth --force-error 5@0.01 --steps 1 --json --output " +
                           (folder.path() / "seen").string();
  const auto truth_of = [&](const std::string& model) {
    const ProgramResult result = stdout_of_dashpot("observe " + model + with);
    REQUIRE(result.exit_code == 0);
    return parse_json(result.output, "stdout").find("truth")->items();
  };
  const auto both = truth_of(spencer);
  CHECK(both[0].find("quantity")->as_string() == "front_damper_force");
  CHECK(both[1].find("quantity")->as_string() == "rear_damper_force");
  for (const std::size_t damper : {0u, 1u})
    CHECK(both[damper].find("error")->as_number() < 0.02 * both[damper].find("span")->as_number());
  const auto each = truth_of("rear=" + spencer + ",front=" + spencer);
  CHECK(each[1].find("error")->as_number() == both[1].find("error")->as_number());

  // By the kinds of a plant whose dampers are not alike; one model is then none for all.
  const std::string kinds =
      folder.write("kinds.yaml", read_file(car) + "damper_kinds: {new: rear, old: front}\n")
          .string();
  const auto by_kinds = [&](const std::string& model) {
    return stdout_of_dashpot("observe " + model + " --in " + kinds +
                             with.substr(with.find(rides) - 1));
  };
  const ProgramResult of_kinds = by_kinds("new=" + spencer + ",old=" + spencer);
  REQUIRE(of_kinds.exit_code == 0);
  CHECK(
      parse_json(of_kinds.output, "stdout").find("truth")->items()[1].find("error")->as_number() ==
      both[1].find("error")->as_number());
  CHECK(contains(run_dashpot("observe " + spencer + " --in " + kinds + ' ' + rides).output,
                 "MODEL: is one, and the plant has dampers of 2 kinds; new=FILE,old=FILE"));

  // What cannot be used.
  const auto refusal = [&](const std::string& model) {
    return run_dashpot("observe " + model + with).output;
  };
  CHECK(contains(refusal("front=" + spencer),
                 "MODEL: the damper 'rear' has no model; front=" + spencer +
                     ",rear=FILE, or one FILE for all dampers"));
  CHECK(contains(refusal("fornt=" + spencer + ",rear=" + spencer),
                 "MODEL: the plant has no damper 'fornt'; did you mean 'front'"));
  CHECK(contains(refusal("rear=" + spencer + ",rear=" + spencer), "'rear' has two models"));
  CHECK(contains(refusal("front=" + spencer + ",rear="), "'rear=' is of no damper; NAME=FILE"));
  CHECK(contains(refusal("front=" + spencer + ",rear=" + (folder.path() / "no.json").string()),
                 "no.json"));
  CHECK(contains(refusal("front=" + spencer +
                         ",rear=" + (folder.path() / "braz_cesar_barros2013.json").string()),
                 "takes A, and the plant states V"));

  // The observer of both as C.
  const std::string c = (folder.path() / "ecu").string();
  const ProgramResult exported =
      run_dashpot("export " + spencer + " --in " + car +
                  " --force-error 5@0.01 --to c --name cells --output " + c);
  CHECK(exported.exit_code == 0);
  CHECK(contains(read_file(c + "/cells.h"), "rear_damper_force (N)"));
  CHECK(contains(read_file(c + "/cells.h"), "Of its damper: "));
}
