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
  CHECK(contains(run_dashpot("member " + family + " --set build=9").output,
                 "warning: build is 9 standard deviations"));
  CHECK(contains(run_dashpot("member " + family + " --set gape=9mm").output, "did you mean 'gap'"));
  CHECK(contains(run_dashpot("member " + family + " --set yield_stress=20kPa").output,
                 "the same at any current"));
  CHECK(contains(run_dashpot("member " + family + " --damper family_prototype").output,
                 "yield_stress"));

  // A drawing computes its areas and its field anew; one that states them cannot.
  const std::string set = " --set gap=1.5mm --json";
  const auto number = [](const ProgramResult& result, const char* name) {
    return parse_json(result.output, "stdout").find("member")->find(name)->as_number();
  };
  const std::string wide = folder.write("wide.yaml", "fluid: 132DG\ngap: 1.5 mm\n").string(),
                    narrow = folder.write("narrow.yaml", "fluid: 132DG\ngap: 1 mm\n").string();
  const ProgramResult drawn =
                          stdout_of_dashpot("member " + family + " --damper " + wide + " --json"),
                      changed = stdout_of_dashpot("member " + family + " --damper " + narrow + set);
  CHECK(number(changed, "gap_area") == number(drawn, "gap_area"));
  CHECK(drawn.output == changed.output);
  const std::string stated =
      folder.write("stated.yaml", "fluid: 132DG\ngap: 1 mm\ngap_area: 100 mm^2\n").string();
  CHECK(contains(run_dashpot("member " + family + " --damper " + stated + set).output,
                 "states the gap_area of its own gap"));
  CHECK(contains(run_dashpot("member " + family + " --damper " + wide).output,
                 "friction and passive_length of the drawing do not count"));

  // What the file of its fluid says, and what of it a family does not take.
  const std::string recalled = folder.write("recalled.yaml", "fluid: 122EG\n").string();
  CHECK(contains(run_dashpot("member " + family + " --damper " + recalled).output,
                 "warning: the volume fraction of 122EG is recalled"));
  folder.write("thinning.yaml",
               "name: thinning\ndensity: 3000\nviscosity: 0.1\n"
               "herschel_bulkley: {index: 0.7, shear_rate: 100}\n"
               "laws: {mine: {volume_fraction: 0.3}}\n");
  const std::string thinning = folder.write("drawn.yaml", "fluid: thinning.yaml\n").string();
  CHECK(
      contains(run_dashpot("member " + family + " --damper " + thinning).output,
               "thinning is a Herschel-Bulkley fluid: a family's model takes it by its viscosity"));
  CHECK(contains(run_dashpot("member " + family + set).output,
                 "areas and yield stress do not follow gap"));
  CHECK(contains(run_dashpot("member " + family + " --set gap=1.2").output,
                 "--set: gap is 1.2 m; 5e-05 ... 0.01 m"));

  // A drive of a plant needs a recording, and a family that knows its builds before that is read.
  const std::string plant =
      " --in oscillator,mass=2kg,stiffness=4N/mm,force=push,displacement=x,current=0.5A";
  CHECK(contains(run_dashpot("member " + family + plant).output, "--recording"));
  CHECK(contains(run_dashpot("member " + family + " --recording none.csv" + plant).output,
                 "does not know how builds of a drawing differ"));

  // Only a family that knows how builds differ can take a recording of one.
  const std::string recording =
      folder
          .write("r.csv",
                 "time [s],displacement [m],velocity [m/s],current [A],force [N]\n"
                 "0,0,0.01,0,5\n0.01,0.0001,0.01,0,5\n0.02,0.0002,0.01,0,5\n"
                 "0.03,0.0003,0.01,0,5\n")
          .string();
  CHECK(run_dashpot("member " + family + " --recording " + recording).exit_code == 1);
  CHECK(contains(
      run_dashpot("member " + family + " --recording none.csv --recording " + recording).output,
      "none.csv"));
}
