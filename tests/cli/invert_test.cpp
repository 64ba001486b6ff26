#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("invert: a file that track follows with, near the search on the model" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "mine.json").string();
  const ProgramResult made = stdout_of_dashpot(
      "invert --parameters kwok2006 --network static,one_sensor --json "
      "--threads 1 --output " +
      file);
  REQUIRE(made.exit_code == 0);
  const Value result = parse_json(made.output, "stdout");
  CHECK(result.find("networks")->members().size() == 2);
  const Value saved = parse_json(read_file(file), file);
  CHECK(saved.find("network")->find("name")->as_string() == result.find("saved")->as_string());

  const ProgramResult tracked = stdout_of_dashpot(
      "track --parameters kwok2006 --duration 3 --json --inverse " + file + ",numeric,heaviside");
  REQUIRE(tracked.exit_code == 0);
  const Value followed = parse_json(tracked.output, "stdout");
  const std::vector<Value>& schemes = followed.find("schemes")->items();
  REQUIRE(schemes.size() == 3);
  CHECK(schemes[1].find("inverse")->as_string() == "mine");
  CHECK(schemes[1].find("reachable")->find("rms_span_percent")->as_number() < 5);

  // Motions beyond what it was taught are said.
  CHECK(contains(
      run_dashpot("track --parameters kwok2006 --duration 3 --amplitude 100 --inverse " + file)
          .output,
      "the displacement is outside " + file + "'s range"));
}

TEST_CASE("invert: recordings teach it, and what was not measured is said" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "mine.json").string();
  const ProgramResult made = run_dashpot("invert --recordings " + small_campaign().string() +
                                         " --network history --output " + file);
  CAPTURE(made.output);
  CHECK(made.exit_code == 0);
  CHECK(contains(made.output, "Taught by 9 records"));
  CHECK(contains(made.output, "how the force follows was not measured"));
  const ProgramResult wrong = run_dashpot("track --parameters kwok2006 --inverse " + file);
  CHECK(wrong.exit_code == 1);
  CHECK(contains(wrong.output, "gives V, but the damper takes A"));
}

TEST_CASE("invert: wrong command lines" * doctest::test_suite("long")) {
  const struct {
    const char *arguments, *message;
    int exit_code;
  } cases[] = {
      {"invert", "needs one damper; give a model file, or --parameters NAME", 2},
      {"invert --parameters mr1 --network meterd", "did you mean 'metered'?", 2},
      {"invert --parameters mr1 --step 3.3", "looks back in steps of 3.3 ms", 1},
      {"invert --parameters labcontrol_bouc_wen", "its data lie at one current only", 1},
      {"invert missing.json", "missing.json", 1},
      {"track --parameters mr1 --inverse missing.json", "missing.json", 1},
  };
  for (const auto& c : cases) {
    CAPTURE(c.arguments);
    const ProgramResult result = run_dashpot(c.arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == c.exit_code);
    CHECK(contains(result.output, c.message));
  }
}
