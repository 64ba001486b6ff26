#include <cmath>

#include "dashpot/physics/damper_physics.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("physics: every step with its unit, as text and as JSON") {
  const ProgramResult result = run_dashpot("physics passenger_car --current 2 --velocity 0.3");
  CHECK(result.exit_code == 0);
  for (const PhysicsQuantity& quantity : physics_quantities())
    CHECK(contains(result.output, std::string(quantity.name)));
  const Value json = parse_json(
      stdout_of_dashpot("physics family_prototype --current 0.25 --velocity 34mm/s --json").output,
      "json");
  CHECK(json.find("quantities")->items().size() == physics_quantities().size());
  CHECK(json.find("velocity")->as_number() == 0.034);

  // At rest: Carlson's 9.574 kPa over poles of 24 mm in a gap of 1 mm, and 50 N of friction.
  CHECK(contains(run_dashpot("physics passenger_car --velocity 0").output,
                 "and not the 696.8 N up to which the damper holds"));
  CHECK(!contains(result.output, "at rest nothing flows"));
}

TEST_CASE("physics: a damper that is neither known nor a file is told with the known ones") {
  const ProgramResult result = run_dashpot("physics pasenger_car");
  CHECK(result.exit_code == 1);
  CHECK_MESSAGE(contains(result.output,
                         "unknown damper 'pasenger_car'; did you mean 'passenger_car'? known: "),
                result.output);
  CHECK(
      contains(run_dashpot("physics nothere.yaml").output, "nothere.yaml: there is no such file"));
}

TEST_CASE("physics: fields can be changed, listed, and are refused with their names" *
          doctest::test_suite("long")) {
  const std::string wide = run_dashpot("physics passenger_car --set gap=2mm").output;
  CHECK(wide != run_dashpot("physics passenger_car").output);
  CHECK(contains(run_dashpot("physics --fields").output, "passive_length"));
  CHECK(contains(run_dashpot("physics passenger_car --set gpa=2mm").output, "did you mean 'gap'"));
  CHECK(contains(run_dashpot("physics passenger_car --set gap=2kg").output, "not a unit of it"));
  CHECK(contains(run_dashpot("physics passenger_car --current much").output, "is not a number"));
  const ProgramResult twice = run_dashpot("physics passenger_car --set gap=2mm,turns=90,gap=1mm");
  CHECK(twice.exit_code == 2);
  CHECK(contains(twice.output, "--set: gap is stated twice; one value of each name"));
  CHECK(contains(run_dashpot("physics passenger_car --set fluid=122EG").output,
                 "--set: 'fluid' is no number; --fluid"));
  CHECK(contains(run_dashpot("physics passenger_car --displacement 20").output,
                 "a displacement of 20 m is beyond the stroke, 0.15 m from end to end"));
  CHECK(!contains(run_dashpot("physics passenger_car --displacement 20mm").output, "stroke"));
  CHECK(run_dashpot("physics no_such.yaml").exit_code == 1);
  CHECK(run_dashpot("physics").exit_code == 2);
}

TEST_CASE("physics: a fluid and a steel of one's own, and overrides that no current changes" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string fluid =
      folder
          .write("mine.yaml",
                 "name: mine\ndensity: 3000\nviscosity: 0.1\nlaws: {measured: {field: "
                 "{volume_fraction: 0.3}, yield_stress: {points: [[0, 100], [2e+5, 4e+4]]}}}\n"
                 "uncertainty: {yield_stress: 10 %}\n")
          .string();
  const ProgramResult own = run_dashpot("physics passenger_car --steel 1010 --fluid " + fluid);
  CHECK(own.exit_code == 0);
  CHECK(contains(own.output, "with mine"));
  CHECK(contains(own.output, "flux density of 1010"));
  CHECK(contains(own.output, "force ±"));
  CHECK(run_dashpot("physics passenger_car --steel soft_knee").output ==
        run_dashpot("physics passenger_car").output);
  const ProgramResult fixed = run_dashpot("physics passenger_car --set yield_stress=20kPa");
  CHECK(fixed.exit_code == 1);
  CHECK(contains(fixed.output, "that no current changes"));
  const ProgramResult beside =
      run_dashpot("physics passenger_car --steel 1010 --set saturation=1T");
  CHECK(beside.exit_code == 2);
  CHECK(contains(beside.output, "--set: saturation stands beside the steel 1010"));
  CHECK(contains(run_dashpot("physics passenger_car --fluid 122EF").output, "did you mean"));
  CHECK(run_dashpot("physics passenger_car -o x.yaml").exit_code == 2);
}

TEST_CASE("physics: recordings of a drawn damper calibrate it, and the drawing is read again") {
  const TemporaryFolder folder;
  const std::string data = small_campaign().string(),
                    made = (folder.path() / "calibrated.yaml").string();
  const ProgramResult done =
      run_dashpot("physics passenger_car --recordings " + data + " -o " + made);
  // The campaign is of a damper in volts, which no coil current tells.
  CHECK(done.exit_code == 1);
  CHECK(contains(done.output, "is driven by V"));

  std::string text = "time [s],displacement [mm],velocity [mm/s],current [A],force [N]\n";
  for (int k = 0; k <= 400; ++k) {
    const double phase = 0.0314159265 * k, speed = std::sin(phase);
    text += std::to_string(0.005 * k) + "," + std::to_string(-16 * std::cos(phase)) + "," +
            std::to_string(100 * speed) + ",1," + std::to_string(900 * std::tanh(8 * speed)) + "\n";
  }
  const std::string one = folder.write("one.csv", text).string();
  const ProgramResult found =
      run_dashpot("physics passenger_car --recordings " + one + " -o " + made);
  CHECK_MESSAGE(found.exit_code == 0, found.output);
  CHECK(contains(found.output, "in series with the flow"));
  CHECK(run_dashpot("physics " + made).exit_code == 0);
}
