#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"
#include "design/resisting_family.h"
#include "program.h"

using namespace dashpot;
namespace fs = std::filesystem;

TEST_CASE("design: a front as descriptions, models that other commands take, and reports") {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const std::string request = folder
                                  .write("r.yaml", R"(
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary: {gap: {from: 0.6 mm, to: 2 mm}, pole_length: {from: 8 mm, to: 40 mm}}
tolerances: {gap: 0.05 mm}
constraints: [{quantity: force, min: 1200 N}]
goals: [{maximise: dynamic_range}, {minimise: mass}]
)")
                                  .string();
  const ProgramResult result =
      run_dashpot("design " + request +
                  " --points 8 --generations 20 --second physics:moving_wall --output " + out);
  CHECK_MESSAGE(result.exit_code == 0, result.output);
  CHECK(contains(result.output, "knee"));
  CHECK(contains(result.output, "Every one holds all constraints"));
  for (const char* name : {"design.html", "design.json", "design.md", "design.csv"})
    CHECK(fs::exists(fs::path(out) / name));
  const Value json = parse_json(read_file(fs::path(out) / "design.json"), "json");
  CHECK(json.find("designs")->items().size() == 8);
  CHECK(run_dashpot("physics " + out + "/designs/design_008.yaml").exit_code == 0);
  const ProgramResult track =
      run_dashpot("track " + out + "/models/design_001.json --inverses numeric");
  CHECK_MESSAGE(track.exit_code != 1, track.output);
  // A run with fewer designs leaves none of the earlier ones.
  run_dashpot("design " + request + " --points 4 --generations 1 --no-report --output " + out);
  CHECK(!fs::exists(fs::path(out) / "designs/design_008.yaml"));
}

TEST_CASE("design: a conflict is told, with code 3; wrong input with 1 and 2") {
  const TemporaryFolder folder;
  const std::string request = folder
                                  .write("r.yaml", R"(
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary: {gap: {from: 0.8 mm, to: 1.5 mm}}
constraints: [{quantity: force, min: 2 kN}, {quantity: off_force, max: 300 N}]
goals: [{minimise: mass}]
)")
                                  .string();
  const std::string out = " --output " + (folder.path() / "out").string();
  const ProgramResult conflict = run_dashpot("design " + request + out);
  CHECK(conflict.exit_code == 3);
  CHECK(contains(conflict.output, "cannot hold together"));
  CHECK(contains(conflict.output, "off_force at most 300 N"));
  CHECK(run_dashpot("design").exit_code == 2);
  CHECK(run_dashpot("design no_such_request" + out).exit_code == 1);
  CHECK(run_dashpot("design passenger_car --second physics:none" + out).exit_code == 2);
  CHECK(contains(run_dashpot("design --quantities").output, "response_time"));
}

TEST_CASE("design --next: more drawings than a search can choose from are refused at once") {
  CHECK(contains(run_dashpot("design passenger_car --next 1000 --model m.json").output,
                 "--next: 1000 is too large; at most 200"));
}

TEST_CASE("design by a family and beside the physics: members that 'member' and 'track' take") {
  const TemporaryFolder folder;
  const std::string family = (folder.path() / "family.json").string();
  const std::string out = (folder.path() / "out").string();
  ModelFile file;
  file.model = resisting_family().with_offset(0);
  file.domain = {-0.02, 0.02, -0.05, 0.05, 0, 1};
  save_model(file, family);
  const std::string request = folder
                                  .write("r.yaml", R"(
damper: family_prototype
at: {current: 0.5 A, velocity: 20 mm/s}
vary: {gap: {from: 1 mm, to: 3 mm}}
follow: {gap_area: {gap: 0.02487}, magnetic_gap: {gap: 2}}
constraints: [{quantity: force, min: 1 N, by: second}]
goals: [{maximise: gap}]
)")
                                  .string();
  const ProgramResult result =
      run_dashpot("design " + request + " --model " + family +
                  " --second physics --outside-family refuse --output " + out);
  CHECK_MESSAGE(result.exit_code == 0, result.output);
  CHECK(contains(result.output, "members of a family"));
  CHECK(contains(result.output, "family_gated and physics differ by"));
  const ProgramResult member = run_dashpot("member " + out + "/models/design_001.json");
  CHECK_MESSAGE(member.exit_code == 0, member.output);
  CHECK(!contains(member.output, "extrapolates"));
  CHECK(fs::exists(fs::path(out) / "models/design_001_second.json"));
  CHECK(run_dashpot("track " + out + "/models/design_001.json --inverses numeric").exit_code != 1);
  CHECK(run_dashpot("design " + request + " --model " + family + "x --output " + out).exit_code ==
        1);
}
