#include <cmath>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

/// A mass of 2 kg on 5 N/mm, a dashpot of 30 N*s/m and friction of 4 N, pushed; 1 kHz, integrated
/// by a method of the test's own.
std::string pushed_mass() {
  constexpr double kStep = 1e-5;
  std::string text = "time [s],push [N],x [mm]\n";
  double x = 0, v = 0;
  for (int k = 0; k < 300000; ++k) {
    const double t = kStep * k;
    double push = 0;
    for (int n = 1; n < 9; ++n) push += 12 * std::cos(6.0 * n * t + n * n);
    if (k % 200 == 0)
      text +=
          format_exact(t) + ',' + format_number(push, 9) + ',' + format_number(1000 * x, 9) + '\n';
    v += kStep / 2 * (push - 5000 * x - 30 * v - 4 * std::tanh(v / 0.01));
    x += kStep * v;
  }
  return text;
}

}  // namespace

TEST_CASE("identify --in: a damper inside an oscillator becomes a report and a model file") {
  const TemporaryFolder folder;
  folder.write("pushed.csv", pushed_mass());
  const TemporaryFolder elsewhere;
  const std::string results = elsewhere.path().string();
  const std::string command =
      "identify " + folder.path().string() +
      " --in oscillator,mass=unknown,stiffness=5N/mm,force=push,displacement=x "
      "--models tanh_guo,viscous_dahl --output " +
      results;
  const ProgramResult result = stdout_of_dashpot(command + " --json");
  REQUIRE(result.exit_code == 0);
  const Value report = parse_json(result.output, "stdout");
  const std::vector<Value>& fits = report.find("fits")->items();
  REQUIRE(fits.size() == 2);
  const Value& mass = fits[0].find("plant")->items()[0];
  CHECK(mass.find("name")->as_string() == "mass");
  CHECK_CLOSE(mass.find("value")->as_number(), 2, 0.03, 0);
  const Value& sensor = fits[0].find("sensors")->items()[0];
  CHECK(sensor.find("error_held_back")->as_number() < 0.05 * sensor.find("rms")->as_number());

  // Its files: the page, and a model that others read.
  CHECK(contains(read_file(results + "/report.html"), "A damper identified in its plant"));
  const ModelFile model = load_model(results + "/models/tanh_guo.json");
  CHECK(contains(model.provenance.command, "--in oscillator"));
  REQUIRE(model.provenance.files.size() == 1);
  CHECK(contains(model.provenance.files[0].path, "pushed.csv"));
  CHECK_CLOSE(model.model->force({0, 1, 0}, {}), 34, 0.2, 0);

  // Once more it takes what it has, for one law and for both.
  const ProgramResult one =
      run_dashpot("identify " + folder.path().string() +
                  " --in oscillator,mass=unknown,stiffness=5N/mm,force=push,displacement=x "
                  "--models viscous_dahl --output " +
                  results);
  CHECK(contains(one.output, "1 fit kept from before; with --fresh"));
  // People see the sensor in mm, as of every command; JSON has m.
  CHECK_MESSAGE(contains(one.output, " x       mm "), one.output);
  CHECK(sensor.find("unit")->as_string() == "m");
  CHECK(stdout_of_dashpot(command + " --json").output == result.output);
}

TEST_CASE("identify --in: what speaks against a result stands in its files too" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  folder.write("pushed.csv", pushed_mass());
  const TemporaryFolder elsewhere;
  const std::string results = elsewhere.path().string();
  const ProgramResult result = run_dashpot(
      "identify " + folder.path().string() +
      " --in oscillator,mass=2,damping=unknown,stiffness=5N/mm,force=push,displacement=x "
      "--models tanh_guo --starts 3 --output " +
      results);
  const std::string doubt = "tanh_guo: damping and A2 cannot be told apart by these sensors";
  CHECK(contains(result.output, doubt));
  for (const char* page : {"/report.html", "/report.md"})
    CHECK(contains(read_file(results + page), doubt));
}

TEST_CASE("identify --in: a result that cannot be relied on is none for a script") {
  const TemporaryFolder folder;
  std::vector<std::string> lines = split(pushed_mass(), '\n');
  for (std::size_t k = 1; k + 1 < lines.size(); ++k)  // another push than the one that moved it
    lines[k] = lines[k].substr(0, lines[k].find(',')) + ',' +
               split(lines[lines.size() - 1 - k], ',')[1] + lines[k].substr(lines[k].rfind(','));
  folder.write("pushed.csv", join(lines, "\n"));
  const TemporaryFolder elsewhere;
  const std::string results = elsewhere.path().string();
  const ProgramResult result = run_dashpot(
      "identify " + folder.path().string() +
      " --in oscillator,mass=unknown,stiffness=5N/mm,force=push,displacement=x --starts 1 "
      "--models tanh_guo --quiet --output " +
      results);
  CHECK_MESSAGE(result.exit_code == 3, result.output);
  CHECK(contains(result.output, "neither numbers nor intervals can be relied on"));
  CHECK(contains(result.output, "no model comes near any sensor"));
  CHECK(contains(read_file(results + "/report.html"), "A damper identified in its plant"));
}

TEST_CASE("identify --in: where no model is named some laws are tried, listed by their error" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder, results;
  folder.write("pushed.csv", pushed_mass());
  const ProgramResult result = stdout_of_dashpot(
      "identify " + folder.path().string() +
      " --in oscillator,mass=unknown,stiffness=5N/mm,force=push,displacement=x --starts 1 --json "
      "--output " +
      results.path().string());
  REQUIRE(result.exit_code == 0);
  const Value report = parse_json(result.output, "stdout");
  double before = 0;
  std::vector<std::string> laws;
  for (const Value& fit : report.find("fits")->items()) {
    laws.push_back(fit.find("law")->as_string());
    const Value& sensor = fit.find("sensors")->items()[0];
    CHECK(sensor.find("error_held_back")->as_number() >= before);
    before = sensor.find("error_held_back")->as_number();
  }
  // What speaks against the best alone is on the page.
  const std::string page = read_file(results.path().string() + "/report.md");
  for (std::size_t k = 1; k < laws.size(); ++k) CHECK(!contains(page, "* " + laws[k] + ": "));
  std::ranges::sort(laws);
  CHECK(laws == std::vector<std::string>{"bouc_wen", "hysteretic_biviscous", "modified_bouc_wen",
                                         "tanh_guo", "tanh_kwok"});
}

TEST_CASE("identify --in: beside a network stand the numbers of the law along which it learnt" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder, results;
  folder.write("pushed.csv", pushed_mass());
  const ProgramResult result = run_dashpot(
      "identify " + folder.path().string() +
      " --in oscillator,mass=unknown,stiffness=5N/mm,force=push,displacement=x --models "
      "dahl,hysteresis_network --network members=1,epochs=100 --output " +
      results.path().string());
  REQUIRE(result.exit_code == 0);
  const std::string page = read_file(results.path().string() + "/report.md");
  CAPTURE(page);
  CHECK(contains(page, "learnt along dahl"));  // which has no dashpot, and leaves much more
  CHECK(contains(page, "**Plant**"));          // the network has moved the mass
  CHECK(contains(page, "**Plant, along dahl**"));
  CHECK(contains(page, "**Damper, along dahl**"));
}

TEST_CASE("identify --in: what cannot be used is said before the work" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string data =
      folder.write("a.csv", "time [s],push [N],x [mm]\n0,1,0\n0.01,2,1\n0.02,3,1\n").string();
  const auto output = [&](const std::string& rest) {
    return run_dashpot("identify " + data + ' ' + rest).output;
  };
  const std::string plant = "--in oscillator,mass=2,force=push,displacement=x";
  CHECK(contains(output(plant), "leaves 2 samples to fit"));  // unasked, some laws are tried
  CHECK(contains(output(plant + " --models usual,dahl"), "leaves 2 samples to fit"));
  CHECK(contains(output(plant + " --models all"),
                 "--models: 'all' are models of a bench; with --in, 'usual' or names"));
  CHECK(contains(output(plant + " --models family_gated"),
                 "'family_gated' is a model of many dampers that differ by their drawings"));
  CHECK(contains(output(plant + " --models dahl --leave-out current"),
                 "--leave-out: has no effect with --in; 'held_back'"));
  CHECK(contains(output(plant + " --models dahl --asymmetric"), "--asymmetric: has no meaning"));
  for (const char* option : {"--force-offset none", "--velocity-cutoff 10", "--keep-inertia",
                             "--pdf", "--plant savaresi_spelta"})
    CHECK(contains(output(plant + " --models dahl " + option), "has no effect with --in"));
  CHECK(contains(output(plant + " --models dahl"), "leaves 2 samples to fit"));
  CHECK(contains(output("--in oscillator,mass=2,force=psh,displacement=x --models dahl"),
                 "has no column 'psh'; it has 'time [s]', 'push [N]', 'x [mm]'"));

  // A car of two axles: where, and the road under each.
  const std::string car =
      "--models dahl --in half_car,mass=690,inertia=1222,front_wheel_mass=40,rear_wheel_mass=45,"
      "front_stiffness=17e3,rear_stiffness=22e3,front_tyre_stiffness=2e5,rear_tyre_stiffness=2e5,"
      "front_distance=1.3,rear_distance=1.5,deflection=x@rear,ground=push";
  CHECK(contains(output(car), "--in, ground: says not where; at: one of front, rear"));
  CHECK(contains(output(car + "@front"),
                 "plant, inputs: none says what the road does under the rear_tyre; an input of "
                 "kind: ground, at: each place where a tyre meets the road"));
}
