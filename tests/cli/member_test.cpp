#include "damper/kinds/family/example_family.h"
#include "dashpot/model_file.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("a member of a family becomes a model of its own, marked or refused outside") {
  const TemporaryFolder folder;
  const std::string family = (folder.path() / "family.json").string();
  const std::string member = (folder.path() / "member.json").string();
  ModelFile file;
  file.model = example_family().with_offset(0);
  save_model(file, family);

  const ProgramResult inside =
      run_dashpot("member " + family + " --set gap=1.5mm,build=1 -o " + member);
  CHECK_MESSAGE(inside.exit_code == 0, inside.output);
  const ModelFile made = load_model(member);
  const auto wanted = example_family().specialised({{"gap", 1.5e-3}, {"build", 1}});
  const std::vector<double> state(3);
  CHECK(made.model->force({0, 0.02, 0.5}, state) == wanted->force({0, 0.02, 0.5}, state));

  CHECK(contains(run_dashpot("member " + family + " --set gap=9mm").output, "extrapolates"));
  CHECK(run_dashpot("member " + family + " --set gap=9mm --outside-family refuse").exit_code == 1);
  CHECK(contains(run_dashpot("member " + family + " --set gape=9mm").output, "did you mean 'gap'"));
  CHECK(contains(run_dashpot("member " + family + " --set yield_stress=20kPa").output,
                 "the same at any current"));
  CHECK(contains(run_dashpot("member " + family + " --damper family_prototype").output,
                 "yield_stress"));

  // Only a family that knows how builds differ can take a recording of one.
  const std::string recording =
      folder
          .write("r.csv",
                 "time [s],displacement [m],velocity [m/s],current [A],force [N]\n"
                 "0,0,0.01,0,5\n0.01,0.0001,0.01,0,5\n0.02,0.0002,0.01,0,5\n"
                 "0.03,0.0003,0.01,0,5\n")
          .string();
  CHECK(run_dashpot("member " + family + " --recording " + recording).exit_code == 1);
}
