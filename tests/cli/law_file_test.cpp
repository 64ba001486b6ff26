#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

/// The first block of YAML on a page.
std::string yaml_of(const std::string& page) {
  const std::string fence = "```yaml\n";
  const std::size_t begin = page.find(fence) + fence.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

}  // namespace

TEST_CASE("docs/laws-from-a-file.md: its law and its commands work as they stand" *
          doctest::test_suite("long")) {
  const std::string page = read_file(project_file("docs/laws-from-a-file.md"));
  TemporaryFolder folder;
  const std::string law = yaml_of(page);
  folder.write("my_law.yaml", law);
  check_commands_run(shell_commands(page), folder);

  // The message that it shows is the one that comes.
  std::string wrong = law;
  wrong.replace(wrong.find("abs(v)*w"), 8, "abs(v)*q");
  folder.write("my_law.yaml", wrong);
  const ProgramResult refused =
      run_program("cd " + folder.path().string() + " && " + program_path() +
                  " identify no-such-recordings --models my_law.yaml");
  CHECK(refused.exit_code == 1);
  const std::size_t shown = page.find("    my_law.yaml:") + 4;
  CHECK(contains(refused.output, page.substr(shown, page.find('\n', shown) - shown)));
}

TEST_CASE("bouc_wen as a file is fitted and ranked beside bouc_wen with the same numbers" *
          doctest::test_suite("long")) {
  TemporaryFolder folder;
  const std::string here = folder.path().string();
  const ProgramResult bench = run_dashpot(
      "bench --damper spencer1997_bouc_wen --motions 15x1,5x3 --levels 0,1,2 --cycles 2 "
      "--sample-rate 200 --output " +
      here + "/recordings");
  REQUIRE_MESSAGE(bench.exit_code == 0, bench.output);
  const std::string identify = "identify " + here + "/recordings --models " +
                               project_file("examples/laws/my_bouc_wen.yaml") +
                               ",bouc_wen,bingham --starts 1 --output " + here + "/results";
  const ProgramResult made = run_dashpot(identify);
  REQUIRE_MESSAGE(made.exit_code == 0, made.output);
  CHECK(contains(made.output, "cannot be told apart"));

  // The same coefficients and errors to the last bit: the operations are the same.
  const auto model = [&](const std::string& name) {
    return parse_json(read_file(here + "/results/models/" + name + ".json"), name);
  };
  const Value mine = model("my_bouc_wen"), own = model("bouc_wen");
  CHECK(format_json(*mine.find("model")->find("parameters")) ==
        format_json(*own.find("model")->find("parameters")));
  CHECK(format_json(*mine.find("quality")->find("left_out")) ==
        format_json(*own.find("quality")->find("left_out")));

  // The model works where the law's file is not, and its kept fits are those of its text.
  const ProgramResult evaluated = run_dashpot(
      "evaluate " + here + "/results/models/my_bouc_wen.json " + here + "/recordings --json");
  CHECK(evaluated.exit_code == 0);
  std::string changed = read_file(project_file("examples/laws/my_bouc_wen.yaml"));
  changed.replace(changed.find("alpha*z"), 7, "alpha*z + 0*z^3");
  const std::string path = folder.write("changed.yaml", changed).string();
  const auto kept = [&](const std::string& models) {
    return run_dashpot("identify " + here + "/recordings --models " + models +
                       " --starts 1 --output " + here + "/results")
        .output;
  };
  const std::string again = kept(project_file("examples/laws/my_bouc_wen.yaml")),
                    other = kept(path);
  CHECK(contains(again, "fits kept from before"));
  CHECK_FALSE(contains(other, "fits kept from before"));
}

TEST_CASE("the file of a law is no damper to ride, and is called what it is") {
  const std::string file = project_file("examples/laws/my_tanh.yaml");
  CHECK(contains(run_dashpot("simulate --damper " + file).output,
                 "my_tanh.yaml: is the file of a law, not the model of a damper; a model file"));
}

TEST_CASE(
    "models LAW.yaml shows a law from a file as it shows any other, and refuses what is none") {
  const std::string file = project_file("examples/laws/my_tanh.yaml");
  const ProgramResult shown = run_dashpot("models " + file);
  CHECK(shown.exit_code == 0);
  for (const char* part : {"my_tanh (law): Hyperbolic tangent from a file", "no state",
                           "height of the hysteresis", "inverse: search", "Source: Kwok"})
    CHECK(contains(shown.output, part));
  CHECK(contains(run_dashpot("models " + file + " --markdown").output, "## `my_tanh`"));
  const Value sheet = parse_json(run_dashpot("models " + file + " --json").output, "sheet");
  CHECK(sheet.find("parameters")->items().size() == 6);

  CHECK(contains(run_dashpot("models no.yaml").output, "no.yaml: there is no such file"));
  CHECK(contains(run_dashpot("models my_law.txt").output,
                 "is neither a model nor the file of a law; such a file's name ends in .yaml"));
  CHECK(contains(run_dashpot("models " + project_file("data/datasets/utfsm.yaml")).output,
                 "is a dataset file, not the file of a law; docs/laws-from-a-file.md"));
}
