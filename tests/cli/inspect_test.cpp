#include <filesystem>
#include <unistd.h>

#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("inspect says what each column is") {
  const ProgramResult result = run_dashpot("inspect " + small_campaign().string());
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  for (const char* part : {"9 records", "3 conditions", "x_mm", "displacement", "F_N", "voltage"})
    CHECK(contains(result.output, part));
}

TEST_CASE("inspect --json holds columns and records, on stdout alone") {
  const ProgramResult result =
      stdout_of_dashpot("inspect " + small_campaign().string() + " --json");
  const Value value = parse_json(result.output, "inspect --json");
  CHECK(value.find("records")->items().size() == 9);
  CHECK(value.find("drive_unit")->as_string() == "V");
  CHECK(!value.find("columns")->items().empty());
}

TEST_CASE("inspect writes its page") {
  const TemporaryFolder folder;
  const std::string to = (folder.path() / "look").string();
  CHECK(run_dashpot("inspect " + small_campaign().string() + " --output " + to).exit_code == 0);
  CHECK(std::filesystem::file_size(to + "/inspect.html") > 1000);
}

TEST_CASE("inspect compares a measured velocity with the derived one") {
  // x = 10 mm sin(2 pi t) at 500 Hz with its exact velocity: what remains is the filter's own
  // error.
  std::string text = "t_s,x_mm,v_mm_s,F_N,i_A\n";
  for (int k = 0; k < 2000; ++k) {
    const double w = 2 * 3.14159265358979, t = k / 500.0;
    text += std::to_string(t) + "," + std::to_string(10 * std::sin(w * t)) + "," +
            std::to_string(10 * w * std::cos(w * t)) + "," + std::to_string(100 * std::cos(w * t)) +
            ",1\n";
  }
  const TemporaryFolder folder;
  const std::string file = folder.write("run_1.0A.csv", text).string();
  const ProgramResult result = stdout_of_dashpot("inspect " + file + " --json");
  const Value value = parse_json(result.output, "inspect --json");
  const Value& list = *value.find("derived_velocity");
  REQUIRE(list.items().size() == 1);
  CHECK(list.items().front().find("rms_percent")->as_number() < 3);
}

TEST_CASE("what cannot be read exits with 1 and is named") {
  const TemporaryFolder folder;
  const ProgramResult missing = run_dashpot("inspect " + (folder.path() / "nowhere").string());
  CHECK(missing.exit_code == 1);
  CHECK(contains(missing.output, "nowhere"));

  const ProgramResult empty = run_dashpot("inspect " + folder.write("empty.csv", "").string());
  CHECK(empty.exit_code == 1);
  CHECK(contains(empty.output, "empty.csv"));

  const std::string text =
      folder.write("bad.csv", "t_s,x_mm,F_N,i_A\n0,1,2,0\n0.1,1,abc,0\n0.2,1,2,0\n0.3,1,2,0\n");
  const ProgramResult bad = run_dashpot("inspect " + text);
  CHECK(bad.exit_code == 1);
  CHECK(contains(bad.output, "bad.csv:3"));
}

TEST_CASE("a folder that may not be read is an error, not an empty folder") {
  const TemporaryFolder folder;
  const std::filesystem::path closed = folder.path() / "closed";
  std::filesystem::create_directory(closed);
  // Root may read everything: try as nobody.
  const std::string as_nobody = geteuid() == 0 ? "setpriv --reuid=65534 --clear-groups " : "";
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  std::filesystem::permissions(closed, std::filesystem::perms::none);
  if (run_program(as_nobody + program_path() + " version").exit_code != 0) {
    MESSAGE("SKIPPED: no way to run the program as another user");
    return;
  }
  const ProgramResult result =
      run_program(as_nobody + program_path() + " inspect " + closed.string());
  CAPTURE(result.output);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "closed"));
  std::filesystem::permissions(closed, std::filesystem::perms::owner_all);
}

TEST_CASE("inspect --write-dataset writes a file that reads the same, and never over another") {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "stated.yaml").string();
  const std::string data = small_campaign().string();
  const ProgramResult written = run_dashpot("inspect " + data + " --write-dataset " + file);
  CAPTURE(written.output);
  CHECK(written.exit_code == 0);
  const auto records = [](const std::string& source) {
    const ProgramResult said = stdout_of_dashpot("inspect " + source + " --json");
    const Value value = parse_json(said.output, "inspect");
    std::string text;
    for (const Value& record : value.find("records")->items())
      for (const char* key : {"name", "condition", "drive_level", "samples", "channels"})
        text += format_json(*record.find(key));
    return text;
  };
  CHECK(records(file) == records(data));

  const ProgramResult again = run_dashpot("inspect " + data + " --write-dataset " + file);
  CHECK(again.exit_code == 1);
  CHECK(contains(again.output, "is there already, and may hold corrections"));

  // A name alone is a file of the folder that one works in.
  const ProgramResult bare = run_program("cd " + folder.path().string() + " && " + program_path() +
                                         " inspect " + data + " --write-dataset bare.yaml");
  CAPTURE(bare.output);
  CHECK(bare.exit_code == 0);
  CHECK(records((folder.path() / "bare.yaml").string()) == records(data));
}
