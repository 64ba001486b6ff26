#include <cmath>
#include <fstream>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/dataset.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("bench: the files read back as the campaign that was asked for") {
  const Dataset dataset = load_dataset({small_campaign() / "dataset.yaml"});
  REQUIRE(dataset.records.size() == 9);
  CHECK(dataset.drive_unit == DriveUnit::Volt);
  for (const Record& record : dataset.records) {
    CHECK(record.drive_level.has_value());
    CHECK_CLOSE(record.sample_time, 1.0 / 200, 1e-9, 0);
    for (const char* channel : {"displacement", "velocity", "force", "voltage"})
      CHECK(record.find(channel) != nullptr);
  }
}

TEST_CASE("bench: a folder is understood by the dataset file in it") {
  const Dataset dataset = load_dataset({small_campaign()});
  CHECK(dataset.records.size() == 9);
  CHECK(dataset.drive_unit == DriveUnit::Volt);
}

TEST_CASE("bench: the same seed gives the same bytes, another seed others" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto bytes_of = [&](const std::string& name, const std::string& seed) {
    const std::string to = (folder.path() / name).string();
    REQUIRE(run_dashpot("bench --motions 5x2 --levels 1 --seed " + seed + " --output " + to)
                .exit_code == 0);
    return read_file(folder.path() / name / "5_mm_2_Hz_1_V.csv");
  };
  const std::string first = bytes_of("a", "3");
  CHECK(first == bytes_of("b", "3"));
  CHECK(first != bytes_of("c", "4"));
  CHECK(first.starts_with("t_s,x_mm,F_N,voltage_V\n"));
}

TEST_CASE("bench: a level below 0 or none is refused" * doctest::test_suite("long")) {
  const ProgramResult below = run_dashpot("bench --motions 5x2 --levels=1,-1 --output /tmp/never");
  CHECK(below.exit_code == 2);
  CHECK(contains(below.output, "--levels: -1 is below 0, and dampers are driven from 0 up"));
  CHECK(contains(run_dashpot("bench --levels 0,inf --output /tmp/never").output,
                 "--levels: 'inf' is not a number; write them as 0,0.5,1"));
}

TEST_CASE("bench: a level beyond what the damper is known for is said") {
  const TemporaryFolder folder;
  const std::string bench = "bench --motions 5x2 --cycles 1 --output " + folder.path().string();
  CHECK(contains(run_dashpot(bench + " --levels 1,9").output,
                 "a greatest drive of 9 V is beyond what the damper is known for, 2.25 V"));
  CHECK(!contains(run_dashpot(bench + " --levels 1,2").output, "beyond"));
}

TEST_CASE("bench: a motion too fast to be sampled is refused with the limit") {
  const ProgramResult result = run_dashpot("bench --motions 5x90 --levels 1 --output /tmp/never");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "tenth of the sample rate"));
}

TEST_CASE(
    "bench: a sequence under a sequence reads back with its velocity, and inspect tells what it "
    "is") {
  const TemporaryFolder folder;
  const std::string to = (folder.path() / "am").string();
  const ProgramResult made = run_dashpot(
      "bench --damper mr1 --motion AM,duration=3,carrier=5 --drive PRBS --velocity-sensor "
      "--output " +
      to);
  REQUIRE_MESSAGE(made.exit_code == 0, made.output);
  const Record record = load_dataset({to}).records.at(0);
  CHECK(record.name == "AM duration=3 carrier=5, PRBS");
  CHECK_FALSE(record.drive_level);
  CHECK_CLOSE(record.sample_time, 0.002, 1e-9, 0);
  CHECK(record.channel("velocity").origin.starts_with("column v_m/s"));
  const std::string text = run_dashpot("inspect " + to).output;
  CHECK(contains(text, "AM: amplitude 0.025 m, speed_max 1.5 m/s, carrier 5 Hz"));
  CHECK(contains(text, "PRBS: clock 0.05 s, order 9"));
  CHECK(contains(text, "0...2.5 A"));
  CHECK(contains(text, "Velocity derived from displacement, against the measured one"));
  CHECK_FALSE(contains(text, "true force offset"));
}

TEST_CASE("bench: a sequence at the levels, and sines under a sequence") {
  const TemporaryFolder folder;
  const auto records = [&](const std::string& arguments) {
    const ProgramResult made =
        run_dashpot("bench " + arguments + " --output " + (folder.path() / "to").string());
    REQUIRE_MESSAGE(made.exit_code == 0, made.output);
    const Dataset dataset = load_dataset({folder.path() / "to"});
    std::filesystem::remove_all(folder.path() / "to");
    return dataset.records;
  };
  // the two levels are the damper's own
  const std::vector<Record> levels = records("--damper mr2 --motion TPNVS");
  REQUIRE(levels.size() == 2);
  CHECK(levels[0].drive_level == 0);
  CHECK(levels[1].drive_level == 2.5);
  CHECK(levels[0].condition == levels[1].condition);
  CHECK(records("--motions 5x2,5x3 --drive ICPS").size() == 2);
}

TEST_CASE("bench: an experiment of the one-sensor paper, at its rate or another") {
  const TemporaryFolder folder;
  const auto sample_time = [&](const std::string& name, const std::string& arguments) {
    const std::string to = (folder.path() / name).string();
    const ProgramResult made =
        run_dashpot("bench --damper mr2 --experiment one-sensor-1 --output " + to + arguments);
    REQUIRE_MESSAGE(made.exit_code == 0, made.output);
    const Record record = load_dataset({to}).records.at(0);
    CHECK(record.find("velocity"));
    CHECK(record.name == "TPNVS repeats=2, SC levels=2");
    return record.sample_time;
  };
  CHECK_CLOSE(sample_time("paper", ""), 1 / 1650.0, 1e-9, 0);
  CHECK_CLOSE(sample_time("slow", " --sample-rate 200"), 1 / 200.0, 1e-9, 0);
}

TEST_CASE("bench: the list of sequences, for people and programs") {
  const std::string text = run_dashpot("bench --sequences").output;
  for (const char* name : {"\nAM ", "\nFM ", "\nRP ", "\nSFS ", "\nTPNVS ", "\nAPRBS ", "\nICPS ",
                           "\nPRBS ", "\nSC ", "\none-sensor-5 "})
    CHECK(contains(text, name));
  const Value json = parse_json(stdout_of_dashpot("bench --sequences --json").output, "stdout");
  CHECK(json.find("motions")->items().size() == 5);
  CHECK(json.find("drives")->items().size() == 4);
  CHECK(json.find("experiments")->items().size() == 5);
}

TEST_CASE("bench: sequences that cannot be run are refused" * doctest::test_suite("long")) {
  const auto refused = [](const std::string& arguments, int code, const std::string& what) {
    const ProgramResult result = run_dashpot("bench " + arguments + " --output /tmp/never");
    CHECK(result.exit_code == code);
    CAPTURE(result.output);
    CHECK(contains(result.output, what));
  };
  refused("--motion AN", 1, "--motion: unknown sequence 'AN'; did you mean 'AM'?");
  refused("--drive PRBS,clock=1mm", 1, "clock: 'mm' is not a unit of it");
  refused("--experiment one-sensor-9", 2, "one-sensor-1");
  refused("--experiment one-sensor-1 --drive SC", 2, "leave --motion and --drive out");
  refused("--motion AM --motions 5x2", 2, "--motions");
  refused("--drive SC --levels 1", 2, "--levels");
}

TEST_CASE(
    "bench --family: drawings become a campaign that a family is ranked on in three commands" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string drawings = (folder.path() / "drawings").string(),
                    campaign = (folder.path() / "campaign").string(),
                    ranked = (folder.path() / "ranked").string();
  for (const int gap : {10, 14})
    for (const int length : {6, 10})
      folder.write("drawings/g" + std::to_string(gap) + "_l" + std::to_string(length) + ".yaml",
                   "fluid: 140CG\nbore_diameter: 30 mm\nrod_diameter: 10 mm\ngap: " +
                       std::to_string(0.1 * gap) + " mm\npole_length: " + std::to_string(length) +
                       " mm\npassive_length: 0\ncore_area: 150 mm^2\nfriction: 15 N\n");

  const ProgramResult benched = run_dashpot(
      "bench --family " + drawings +
      " --builds 2 --scatter 0.02 --levels 0,1 --motions 10x1 --cycles 1 --sample-rate 40 "
      "--zero-drift 0 -o " +
      campaign);
  CHECK_MESSAGE(benched.exit_code == 0, benched.output);
  CHECK(contains(benched.output, "4 drawings, 8 dampers, 16 records"));
  CHECK(!contains(benched.output, "stroke"));
  const ProgramResult inspected = run_dashpot("inspect " + campaign);
  CHECK(contains(inspected.output, "as drawn"));

  const ProgramResult ranking = run_dashpot(
      "rank " + campaign +
      " --models family_physics,family_line,bingham --starts 1 --force-offset none --quiet -o " +
      ranked);
  CHECK_MESSAGE(ranking.exit_code == 0, ranking.output);
  const std::size_t physics = ranking.output.find("family_physics"),
                    blind = ranking.output.find("bingham");
  CHECK(physics < blind);

  // A new drawing is a member, at every current by its own coil and fluid.
  const ProgramResult member =
      run_dashpot("member " + ranked + "/models/family_physics.json --damper " + campaign +
                  "/drawings/g14_l6.yaml -o " + (folder.path() / "m.json").string());
  CHECK_MESSAGE(member.exit_code == 0, member.output);
  CHECK(!contains(member.output, "extrapolates"));

  // A short test whose current nobody states makes no member; records without a damper are told.
  std::string rows = "time [s],displacement [mm],force [N]\n";
  for (int k = 0; k < 200; ++k)
    rows += std::to_string(0.01 * k) + ',' + std::to_string(10 * std::sin(0.06 * k)) + ',' +
            std::to_string(50 * std::cos(0.06 * k)) + '\n';
  const std::string bare = folder.write("bare.csv", rows).string();
  const ProgramResult unknown = run_dashpot(
      "member " + ranked + "/models/family_physics.json --damper " + campaign +
      "/drawings/g14_l6.yaml --recording " + bare + " -o " + (folder.path() / "b.json").string());
  CHECK(unknown.exit_code == 1);
  CHECK(contains(unknown.output, "no drive of the recordings is known"));
  std::filesystem::copy_file(bare, folder.path() / "bare_1A.csv");
  const ProgramResult assumed =
      run_dashpot("evaluate " + ranked + "/models/family_physics.json " +
                  (folder.path() / "bare_1A.csv").string() + " --force-offset none");
  CHECK(contains(assumed.output,
                 "the damper is not stated in full by 1 of 1 record: taken from the model's file: "
                 "piston_area"));

  // The next prototypes are drawings that 'physics' takes, with the manifest of their recordings.
  const std::string next = (folder.path() / "next").string();
  const std::string ask =
      " " +
      folder
          .write("ask.yaml",
                 "damper: drawings/g14_l6.yaml\n"
                 "vary: {gap: {from: 1 mm, to: 2 mm}, pole_length: {from: 6 mm, to: 12 mm}}\n")
          .string();
  const ProgramResult chosen =
      run_dashpot("design" + ask + " --next 2 --motions 10x1 --levels 0,1 --model " + ranked +
                  "/models/family_physics.json -o " + next);
  CHECK_MESSAGE(chosen.exit_code == 0, chosen.output);
  CHECK(contains(chosen.output, "next_02"));
  CHECK(contains(chosen.output, "by chance"));
  CHECK(run_dashpot("physics " + next + "/drawings/next_02.yaml").exit_code == 0);
  CHECK(contains(read_file(next + "/manifest.csv"), "next_02_01.csv,drawings/next_02.yaml"));
  CHECK(run_dashpot("design" + ask + " --next 2").exit_code == 2);
  const ProgramResult line = run_dashpot("design" + ask + " --next 2 --model " + ranked +
                                         "/models/family_line.json -o " + next);
  CHECK(line.exit_code == 1);
  CHECK(contains(line.output, "does not know what its recordings have told"));
}

TEST_CASE("bench --family: what cannot be benched is refused" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.yaml", "gap: 1 mm\n").string();
  folder.write("bad.yaml", "gap: 40 mm\n");
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const ProgramResult result =
        run_dashpot("bench " + arguments + " -o " + (folder.path() / "out").string());
    CAPTURE(arguments);
    CHECK_MESSAGE(contains(result.output, words), result.output);
    CHECK(result.exit_code != 0);
  };
  refused("--family " + good + " --fluid 140CH", "unknown fluid '140CH'");
  refused("--family " + (folder.path() / "bad.yaml").string(), "gap is 0.04 m");
  folder.write("fluid.yaml", read_file(data_folder("fluids") / "132DG.yaml"));
  refused("--family " + (folder.path() / "fluid.yaml").string(),
          "fluid.yaml:1: is a fluid, not a damper description");
  refused("--family " + good + "," + good, "two drawings are called good");
  refused("--family " + good + " --drive PRBS", "stated per record");
  refused("--family " + good + " --damper mr1", "beside a family");
  refused("--family " + good + " --asymmetry 2", "between -1 and 1");
  refused("--family " + good + " --scatter 5", "5 % is 0.05");
  CHECK(contains(run_dashpot("bench --family " + good + " --levels 0 --motions 60x0.6 -o " +
                             (folder.path() / "far").string())
                     .output,
                 "good was moved over 120 mm; its stroke is drawn as 50 mm"));
  refused("--fluid 140CG", "--family");
  refused("--family " + (folder.path() / "none").string(), "none");
  CHECK(!std::filesystem::exists(folder.path() / "out"));
}
