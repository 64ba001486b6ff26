#include <sstream>

#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

double number(const Value& object, std::string_view key) { return object.find(key)->as_number(); }

Value track_json(const std::string& arguments) {
  const ProgramResult result = stdout_of_dashpot("track --json --duration 2 " + arguments);
  REQUIRE(result.exit_code == 0);
  return parse_json(result.output, "stdout");
}

}  // namespace

TEST_CASE("track: every scheme that applies, the numeric one best and within 1 % of the span" *
          doctest::test_suite("long")) {
  const Value result = track_json("--parameters spencer1997");
  const std::vector<Value>& schemes = result.find("schemes")->items();
  CHECK(schemes.size() == 7);  // no closed form is known for this law
  CHECK(contains(result.find("remarks")->items().back().as_string(), "is left out: "));
  CHECK(schemes.front().find("inverse")->as_string() == "numeric");
  CHECK(number(*schemes.front().find("reachable"), "rms_span_percent") < 1);
  CHECK(number(*schemes.back().find("reachable"), "rms_span_percent") > 5);
  CHECK(contains(run_dashpot("track --parameters spencer1997 --duration 1").output,
                 "polynomial is left out"));
}

TEST_CASE("track: a force beyond the damper saturates it, and the table says so") {
  const Value result =
      track_json("--parameters kwok2006 --inverse numeric --wanted sine --force 90000");
  CHECK(contains(result.find("remarks")->items().at(0).as_string(), "are an example"));
  const Value& scheme = result.find("schemes")->items().front();
  CHECK(number(scheme, "reachable_percent") < 2);
  CHECK(number(scheme, "saturated_percent") > 95);
}

TEST_CASE("track: a recording's motion and force, a model file, curves and a picture") {
  const TemporaryFolder folder;
  const std::string results = (folder.path() / "fit").string(),
                    curves = (folder.path() / "curves").string();
  REQUIRE(run_dashpot("identify " + small_campaign().string() +
                      " --models bingham --no-report --output " + results)
              .exit_code == 0);
  const ProgramResult result =
      run_dashpot("track " + results + "/models/bingham.json --recording " +
                  small_campaign().string() + " --inverse polynomial,numeric --output " + curves);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.output, "Wanted force: measured, "));
  CHECK(contains(result.output, " records, "));  // how the recording was understood
  for (const char* name : {"numeric.csv", "polynomial.csv"})
    CHECK(read_file(curves + "/" + name)
              .starts_with("t_s,x_mm,v_m/s,F_wanted_N,F_obtained_N,command_voltage_V,"));
  CHECK(contains(read_file(curves + "/track.svg"), "<svg"));

  // The model's data are slower than this motion. The last column of numbers keeps its title.
  const ProgramResult fast =
      run_program("COLUMNS=50 " + program_path() + " track " + results +
                  "/models/bingham.json --inverse numeric --duration 1 --amplitude 100 "
                  "--current-max 9 --rate-limit 50 --period 0.002");
  CAPTURE(fast.output);
  CHECK(contains(fast.output, "% of the time the velocity is outside the model's range"));
  CHECK(contains(fast.output, "the coil gets up to 9 V, beyond the model's "));
  CHECK(contains(fast.output, ", at most 50 V/s, its command read every 2 ms\n"));
  CHECK(contains(fast.output, "time out  at limit\n"));
}

TEST_CASE("track: wrong command lines" * doctest::test_suite("long")) {
  const struct {
    const char *arguments, *message;
    int exit_code;
  } cases[] = {
      {"track", "needs one damper; give a model file, or --parameters NAME", 2},
      {"track m.json --parameters spencer1997", "needs one damper", 2},
      {"track --parameters spencer", "unknown parameter set 'spencer'; did you mean 'spencer1997'?",
       2},
      {"track --parameters spencer1997 --inverse numerik",
       "unknown inverse 'numerik'; did you mean 'numeric'?", 2},
      {"track --parameters spencer1997 --inverse polynomial", "take the numeric inverse", 1},
      {"track --parameters spencer1997 --duration 0", "must be above 0", 1},
      {"track --parameters spencer1997 --duration 1e9", "at most 1e+07", 1},
      {"track --parameters labcontrol_bouc_wen",
       "its data lie at one current only; state the greatest", 1},
      {"track missing.json", "missing.json", 1},
  };
  for (const auto& c : cases) {
    CAPTURE(c.arguments);
    const ProgramResult result = run_dashpot(c.arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == c.exit_code);
    CHECK(contains(result.output, c.message));
  }
}
