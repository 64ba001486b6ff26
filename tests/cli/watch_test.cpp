#include <algorithm>

#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

const char* const kWatchedMass =
    "plant: oscillator\n"
    "parameters: {mass: {about: 100 kg, from: 50 kg, to: 200 kg}, damping: 0, "
    "stiffness: 40000 N/m}\n"
    "inputs: [{channel: push, kind: force, at: mass}]\n"
    "sensors:\n"
    "  - {channel: x, quantity: displacement, at: mass, noise: 0.1 mm}\n"
    "  - {channel: a, quantity: acceleration, at: mass, noise: 0.05}\n"
    "current: 0 A\n";

/// Days of the mass with a damper that is worn so far.
std::string record_days(const TemporaryFolder& folder, const std::string& plant,
                        const std::string& name, int from, int count, const std::string& wear) {
  const std::string days = (folder.path() / name).string();
  for (int day = from; day < from + count; ++day) {
    const std::string ride = (folder.path() / "ride").string();
    REQUIRE(run_dashpot("bench --in " + plant + " --damper kwok2006 " + wear +
                        " --true mass=103kg --push 800 --duration 4 --sample-rate 200 --seed " +
                        std::to_string(day) + " --output " + ride)
                .exit_code == 0);
    write_file(days + "/day_" + std::to_string(day) + ".csv", read_file(ride + "/ride_1.csv"));
  }
  return days;
}

}  // namespace

TEST_CASE("watch: days teach, a state keeps them, and a weaker damper raises the alarm" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string plant = folder.write("plant.yaml", kWatchedMass).string(),
                    state = (folder.path() / "mass.watch").string(),
                    out = (folder.path() / "out").string(),
                    model = (folder.path() / "model.json").string();
  save_model(to_model_file(load_parameter_set("kwok2006")), model);
  const std::string healthy = record_days(folder, plant, "healthy", 1, 8, "");
  const std::string words = "watch " + model + " --in " + plant + " --tracked force --reference 6" +
                            " --false-alarms 0.01 --state " + state + " --output " + out + ' ';

  const ProgramResult first = stdout_of_dashpot(words + healthy + " --json");
  REQUIRE(first.exit_code == 0);
  const Value told = parse_json(first.output, "stdout");
  CHECK(!told.find("alarm")->as_bool());
  REQUIRE(told.find("days")->items().size() == 8);
  const Value& day = told.find("days")->items()[7];
  CHECK(std::abs(day.find("amounts")->find("force")->find("value")->as_number()) < 0.05);
  CHECK(std::abs(day.find("plant")->find("mass")->as_number() - 103) < 3);
  CHECK(contains(read_file(out + "/report.html"), "watched from day to day"));

  // Nothing is expected before a day is judged.
  const std::string begun = run_dashpot("watch " + model + " --in " + plant + ' ' + healthy +
                                        "/day_1.csv --tracked force --output " + out + "_begun")
                                .output;
  const std::string row = begun.substr(std::min(begun.find("\nforce, %"), begun.size()));
  CHECK_MESSAGE(contains(row.substr(0, row.find("learns")), "-                -    -"), begun);

  CHECK(contains(read_file(out + "/report.csv"), "day,force,force_deviation"));
  CHECK(contains(read_file(out + "/report.csv"), ",mass [kg],remark"));
  CHECK(contains(read_file(out + "/report.md"), "mass, kg"));

  // The file for programs has the units that are asked for, as the page has.
  const std::string inches = (folder.path() / "inches").string();
  REQUIRE(run_dashpot("watch " + model + " --in " + plant + " --tracked force --level x " +
                      "--reference 6 --units lbf,in/s --output " + inches + ' ' + healthy)
              .exit_code == 0);
  CHECK(contains(read_file(inches + "/report.csv"), "x [in],x_deviation [in]"));

  // A quantity that stands twice would share the fade with itself.
  CHECK(contains(run_dashpot("watch " + model + " --in " + plant + " --tracked force,force " +
                             healthy + " --output " + inches)
                     .output,
                 "tracked: 'force' is named twice; each once"));

  // The same folder again: nothing is looked at twice, and the same comes out.
  const ProgramResult again = run_dashpot(words + healthy);
  CHECK(contains(again.output, "8 days, 0 new recordings looked at"));
  CHECK(contains(again.output, "No alarm on 2 days behind 6 reference days."));

  // A file that is none is named in what is read later, too.
  const std::string broken = folder.write("day_9.csv", "").string();
  const ProgramResult without = stdout_of_dashpot(words + broken + " --json");
  CHECK(without.exit_code == 4);
  const Value rest = parse_json(without.output, "stdout");
  REQUIRE(rest.find("left_out")->items().size() == 1);
  CHECK(contains(rest.find("left_out")->items()[0].as_string(), "day_9.csv: is empty"));
  CHECK(rest.find("odd_days")->items().empty());
  CHECK(contains(read_file(out + "/report.md"), "Left out: "));
  CHECK(contains(read_file(out + "/report.md"), "One recording was left out"));

  // A damper that has lost a third of its force: the days before are not looked at again.
  const std::string weak = record_days(folder, plant, "weak", 20, 3, "--wear force=-0.3");
  const ProgramResult faded = stdout_of_dashpot(words + weak + " --json");
  REQUIRE(faded.exit_code == 0);
  INFO(faded.output);
  const Value alarmed = parse_json(faded.output, "stdout");
  CHECK(alarmed.find("days")->items().size() == 11);
  REQUIRE(alarmed.find("alarm")->as_bool());
  const Value& chart = alarmed.find("charts")->items()[0];
  CHECK(chart.find("since")->as_string() == "day_20.csv");
  CHECK(std::abs(chart.find("fall")->as_number() - 0.3) < 0.06);
  CHECK(contains(run_dashpot(words).output, "ALARM: the damper's whole force has fallen by"));

  // Another plant is no plant of this state.
  const std::string other =
      folder.write("other.yaml", std::string(kWatchedMass) + "skip: 1 s\n").string();
  CHECK(contains(run_dashpot("watch " + model + " --in " + other + " --tracked force --state " +
                             state + ' ' + weak)
                     .output,
                 "plant"));
}

TEST_CASE("watch: days whose names tell another order are warned of" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string plant = folder.write("plant.yaml", kWatchedMass).string(),
                    model = (folder.path() / "model.json").string();
  save_model(to_model_file(load_parameter_set("kwok2006")), model);
  const auto said = [&](const std::vector<std::string>& names) {
    std::string words = "watch " + model + " --in " + plant;
    for (const std::string& name : names)
      words += ' ' + folder.write(name, "time [s],push [N],x [m],a\n0,0,0," + name + "\n").string();
    return run_dashpot(words).output;
  };
  CHECK(contains(said({"day_1.csv", "day_10.csv", "day_2.csv"}),
                 "day_2.csv comes behind day_10.csv, and its name says before"));
  CHECK(contains(said({"2026-12-01_a.csv", "2026-11-30_a.csv"}), "and its name says before"));
  for (const auto& names : {std::vector<std::string>{"day_1.csv", "day_2.csv", "day_10.csv"},
                            {"30.11.2026.csv", "01.12.2026.csv"},
                            {"monday_2.csv", "tuesday_1.csv"}})
    CHECK(!contains(said(names), "and its name says before"));
}

TEST_CASE("watch: what cannot be is said before the work" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string plant = folder.write("plant.yaml", kWatchedMass).string(),
                    model = (folder.path() / "model.json").string();
  save_model(to_model_file(load_parameter_set("kwok2006")), model);
  const std::string day = folder.write("day.csv", "time [s],push [N],x [m],a\n0,0,0,0\n").string();
  const std::string words = "watch " + model + " " + day + " ";
  const auto refusal = [&](const std::string& more) { return run_dashpot(words + more).output; };
  CHECK(contains(refusal(""), "--in: is missing"));
  CHECK(contains(refusal("--in " + plant + " --tracked forse"), "forse"));
  CHECK(contains(refusal("--in " + plant + " --false-alarms 2"), "--false-alarms: must lie"));
  CHECK(contains(refusal("--in " + plant + " --level y"), "'y' is no sensor of the plant; "));
  CHECK(contains(refusal("--in " + plant + " --reference 2"), "is 2 days; 5 or more"));
  CHECK(contains(refusal("--in " + plant + " " + day), "is the same file as"));
  CHECK(contains(refusal("--in " + plant + " --state " + model),
                 "is no file of watch results; give another --state"));
  CHECK(contains(run_dashpot("bench --in " + plant +
                             " --damper kwok2006 --true mass=103kg "
                             "--road iso8608")
                     .output,
                 "--road: moves a plant by its ground, and forces alone move this one; --push"));
}

TEST_CASE("watch: of two dampers it says which one fades, and by how much" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string plant =
                        folder
                            .write("rig.yaml",
                                   "plant: matrices\ncoordinates: [floor, table]\n"
                                   "mass: [[200 kg, 0], [0, 100 kg]]\n"
                                   "stiffness: [[120 kN/m, -40 kN/m], [-40 kN/m, 40 kN/m]]\n"
                                   "dampers: [{name: low, from: ground, to: floor}, {name: high, "
                                   "from: floor, to: table}]\n"
                                   "inputs: [{channel: push, kind: force, at: floor}]\n"
                                   "sensors:\n"
                                   "  - {channel: a1, quantity: acceleration, at: floor, noise: "
                                   "0.05}\n"
                                   "  - {channel: a2, quantity: acceleration, at: table, noise: "
                                   "0.05}\n"
                                   "  - {channel: x1, quantity: deflection, at: low, noise: 0.1 "
                                   "mm}\n"
                                   "  - {channel: x2, quantity: deflection, at: high, noise: 0.1 "
                                   "mm}\n"
                                   "current: 0 A\n")
                            .string(),
                    model = (folder.path() / "model.json").string(),
                    out = (folder.path() / "out").string(),
                    days = (folder.path() / "days").string();
  save_model(to_model_file(load_parameter_set("kwok2006")), model);
  for (int day = 1; day <= 11; ++day) {
    const std::string ride = (folder.path() / "ride").string();
    REQUIRE(run_dashpot("bench --in " + plant + " --damper kwok2006 --push 1600 --duration 4 " +
                        "--sample-rate 200 --seed " + std::to_string(day) +
                        (day > 8 ? " --wear high_force=-0.3" : "") + " --output " + ride)
                .exit_code == 0);
    write_file(days + "/day_" + std::to_string(day) + ".csv", read_file(ride + "/ride_1.csv"));
  }
  const std::string rest = " --in " + plant + " --reference 6 --false-alarms 0.01 --state " +
                           (folder.path() / "rig.watch").string() + " --output " + out + ' ' + days;

  // What is wrong with the models is said before the work.
  const auto refusal = [&](const std::string& models) {
    const ProgramResult result = run_dashpot("watch " + models + rest);
    CHECK(result.exit_code == 2);
    return result.output;
  };
  CHECK(contains(refusal("low=" + model), "the damper 'high' has no model"));
  CHECK(contains(refusal("low=" + model + ",hihg=" + model), "the plant has no damper 'hihg'"));
  CHECK(contains(refusal("low=" + model + ",low=" + model), "the damper 'low' has two models"));

  // A day without one of the sensors is named and left out.
  std::string table = read_file(days + "/day_7.csv");
  const std::string whole = table;
  table.replace(table.find("x2"), 2, "x3");
  write_file(days + "/day_7.csv", table);
  const std::string words = "watch low=" + model + ",high=" + model + rest + " --json";
  const ProgramResult partly = run_dashpot(words);
  CHECK(partly.exit_code == 4);
  CHECK(contains(partly.output, "left out: "));
  CHECK(contains(partly.output, "has no column 'x2'"));

  const ProgramResult faded = stdout_of_dashpot(words);
  const Value told = parse_json(faded.output, "stdout");
  CHECK(told.find("first_alarm")->as_string() == "high_force");
  CHECK(told.find("dampers")->find("low")->as_string() == "tanh_kwok");
  CHECK(told.find("hardly_apart")->items().empty());
  const auto& charts = told.find("charts")->items();
  REQUIRE(charts.size() == 2);
  CHECK(charts[0].find("damper")->as_string() == "low");
  CHECK(!charts[0].find("alarm"));
  CHECK(charts[1].find("since")->as_string() == "day_9.csv");
  CHECK(std::abs(charts[1].find("fall")->as_number() - 0.3) < 0.06);
  CHECK(contains(read_file(out + "/report.md"), "ALARM: the high damper's whole force has fallen"));
  CHECK(contains(read_file(out + "/report.csv"), "day,low_force,low_force_deviation"));
}
