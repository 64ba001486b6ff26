#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("evaluate --in: damper and plant in free run on rides that no fit has seen") {
  const TemporaryFolder folder;
  const auto in_folder = [&](const std::string& name) { return (folder.path() / name).string(); };
  const std::string rig = folder
                              .write("rig.yaml",
                                     "plant: oscillator\n"
                                     "parameters: {mass: 100 kg, stiffness: 30 N/mm}\n"
                                     "inputs: [{channel: push, kind: force}]\n"
                                     "sensors: [{channel: x, quantity: displacement}]\n"
                                     "voltage: coil\n")
                              .string(),
                    model = in_folder("spencer.json"), rides = in_folder("rides");
  save_model(to_model_file(load_parameter_set("spencer1997")), model);
  REQUIRE(run_dashpot("bench --in " + rig + " --damper " + model + " --levels 0,1 --duration 3 " +
                      "--push 800 --output " + rides)
              .exit_code == 0);
  CHECK(contains(run_dashpot("bench --damper " + model).output,
                 "--damper: is a file, and a bench drives published dampers"));

  // The figures, the page, and the force that no sensor showed.
  const std::string with = "evaluate " + model + ' ' + rides + " --in " + rig;
  const ProgramResult told = run_dashpot(with + " --traces csv -o " + in_folder("traces") +
                                         " --report " + in_folder("page.html"));
  CHECK(told.exit_code == 0);
  CHECK(contains(told.output, "all         x"));
  const std::string page = read_file(in_folder("page.html"));
  CHECK(contains(page, "of the worst sensor's rms is left in free run (x in ride_"));
  CHECK(contains(page, "Sensors, in free run of the whole plant"));
  CHECK(contains(read_file(in_folder("traces/001_ride_1.csv")),
                 "time [s],x [m],x_modelled [m],damper_force [N],damper_deflection [m]"));
  const ProgramResult json = stdout_of_dashpot(with + " --json");
  const Value report = parse_json(json.output, "stdout");
  REQUIRE(report.find("sensors")->items().size() == 2);
  for (const Value& sensor : report.find("sensors")->items())
    CHECK(sensor.find("error")->as_number() < 0.2 * sensor.find("rms")->as_number());

  // What a fit has seen is no judgement.
  const std::string results = in_folder("results");
  REQUIRE(run_dashpot("identify " + rides + "/ride_1.csv --in " + rig +
                      " --models viscous_dahl --starts 2 --output " + results)
              .exit_code == 0);
  CHECK(contains(run_dashpot("evaluate " + results + "/models/viscous_dahl.json " + rides +
                             " --in " + results + "/plants/viscous_dahl.json")
                     .output,
                 "the fit of the model has seen " + rides + "/ride_1.csv: these errors are no"));

  // What cannot be used.
  CHECK(contains(run_dashpot(with + ",x").output, "rig.yaml,x"));
  const std::string open = folder
                               .write("open.yaml",
                                      "plant: oscillator\n"
                                      "parameters: {mass: unknown, stiffness: 30 N/mm}\n"
                                      "inputs: [{channel: push, kind: force}]\n"
                                      "sensors: [{channel: x, quantity: displacement}]\n"
                                      "voltage: coil\n")
                               .string();
  CHECK(contains(run_dashpot("evaluate " + model + ' ' + rides + " --in " + open).output,
                 "plant, mass: is unknown; its value: 'dashpot identify --in' writes the plant"));
  CHECK(contains(run_dashpot("evaluate spencer1997 " + rides + " --in " + rig).output,
                 "is a published damper, and no file"));
}
