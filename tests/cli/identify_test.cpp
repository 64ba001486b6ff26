#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// Two quick models on the small campaign, once for all tests here.
const fs::path& small_results() {
  static const TemporaryFolder folder;
  static const fs::path path = [] {
    const fs::path results = folder.path() / "results";
    const ProgramResult made =
        run_dashpot("identify " + small_campaign().string() +
                    " --models bingham,tanh_kwok --output " + results.string());
    REQUIRE_MESSAGE(made.exit_code == 0, made.output);
    return results;
  }();
  return path;
}

/// What a model file says but for its date.
std::string fitted(const fs::path& results, const std::string& model) {
  const std::string file = (results / "models" / (model + ".json")).string();
  const Value document = parse_json(read_file(file), file);
  return format_json(*document.find("model")) + format_json(*document.find("quality"));
}

int kills_of_identify() {
  const char* stated = std::getenv("DASHPOT_KILLS");
  return stated ? std::atoi(stated) : 3;
}

}  // namespace

TEST_CASE("identify: a folder of recordings becomes a ranking, model files and a report") {
  for (const char* file : {"report.html", "report.json", "report.md", "report.csv",
                           "models/bingham.json", "models/tanh_kwok.json"}) {
    CAPTURE(file);
    CHECK(fs::exists(small_results() / file));
  }
  const Value report = parse_json(read_file(small_results() / "report.json"), "report.json");
  CHECK(report.kind() == Value::Kind::Object);
}

TEST_CASE("identify prints the ranking on stdout and progress on stderr") {
  const TemporaryFolder folder;
  const std::string arguments = "identify " + small_campaign().string() +
                                " --models bingham --no-report --output " + folder.path().string();
  const ProgramResult out = stdout_of_dashpot(arguments);
  CHECK(out.exit_code == 0);
  CHECK(contains(out.output, "bingham"));
  CHECK(contains(out.output, "Models "));
  CHECK(!contains(out.output, "note:"));
  CHECK(!fs::exists(folder.path() / "report.html"));
  CHECK(fs::exists(folder.path() / "models/bingham.json"));
}

TEST_CASE("identify says what the budget left untried, on the terminal, in JSON and on the page" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string asked = "identify " + small_campaign().string() + " --output " +
                            folder.path().string() + " --starts 1 --budget 0.02";
  const ProgramResult out = stdout_of_dashpot(asked);
  CHECK(out.exit_code == 0);
  const std::string untried = "Not tried within 0.02 min on two cores: ";
  CHECK(contains(out.output, untried));
  CHECK(contains(out.output, "passive_network (about "));
  CHECK(contains(read_file(folder.path() / "report.html"), untried));

  // Its figures for programs; and a model that is named needs no budget.
  const Value report = parse_json(read_file(folder.path() / "report.json"), "report.json");
  const Value& budget = *report.find("budget");
  CHECK(budget.find("minutes")->as_number() == 0.02);
  CHECK(budget.find("expected_minutes")->as_number() < 0.02);
  CHECK(!budget.find("untried")->items().empty());
  CHECK(contains(budget.find("note")->as_string(), untried));
  CHECK(!contains(stdout_of_dashpot(asked + " --models bingham").output, "Not tried"));
}

TEST_CASE("identify: what the user knows of parameters shapes the fit and stands in its table") {
  const TemporaryFolder folder;
  const ProgramResult out = stdout_of_dashpot(
      "identify " + small_campaign().string() +
      " --models bingham --fix c0=50N*s/cm --form f_c=exponential --no-report --output " +
      folder.path().string());
  CHECK(out.exit_code == 0);
  const std::string model = read_file(folder.path() / "models/bingham.json");
  const Value file = parse_json(model, "bingham.json");
  ObjectReader reader(file, "a model file");
  const Value& parameters =
      *ObjectReader(reader.required("model"), "a model").optional("parameters");
  ObjectReader rows(parameters, "parameters");
  ObjectReader c0(rows.required("c0"), "c0"), f_c(rows.required("f_c"), "f_c");
  CHECK(c0.required("coefficients").as_numbers() == std::vector<double>{5000});
  CHECK(f_c.string("form") == "exponential");
}

TEST_CASE("study recovery: a table, and exit code 3 where intervals do not hold what they claim" *
          doctest::test_suite("long")) {
  const ProgramResult out =
      stdout_of_dashpot("study recovery --laws bingham --repetitions 40 --seed 2");
  CHECK(out.exit_code == 0);
  CHECK(contains(out.output, "| bingham | f_c_a | N | 670 | 40 |"));
  const ProgramResult noisy =
      run_dashpot("study recovery --laws bingham --repetitions 5 --noisy-motion --quiet");
  CHECK(noisy.exit_code == 3);
  CHECK(contains(noisy.output, "of the intervals hold the truth: bingham"));
}

TEST_CASE("identify --json: stdout is one JSON document") {
  const TemporaryFolder folder;
  const ProgramResult out =
      stdout_of_dashpot("identify " + small_campaign().string() +
                        " --models bingham --json --output " + folder.path().string());
  CHECK(out.exit_code == 0);
  CHECK(parse_json(out.output, "identify --json").kind() == Value::Kind::Object);
}

TEST_CASE("evaluate: a saved model runs on recordings again, with the error that it had on them") {
  const std::string model = (small_results() / "models/tanh_kwok.json").string();
  const ProgramResult out =
      stdout_of_dashpot("evaluate " + model + " " + small_campaign().string() + " --json");
  REQUIRE(out.exit_code == 0);
  const Value result = parse_json(out.output, "evaluate --json");
  const Value file = parse_json(read_file(model), model);
  CHECK(result.find("records")->items().size() == 9);
  CHECK(result.find("outside_domain")->items().empty());
  // The same model, records and offsets as the fit ended with: its own training error.
  CHECK_CLOSE(result.find("pooled")->find("rmse_N")->as_number(),
              file.find("quality")->find("training")->find("rmse_N")->as_number(), 1e-3, 0);
}

TEST_CASE("identify: its models run in the report's page") {
  const std::string page = read_file(small_results() / "report.html");
  const std::size_t programs =
      page.find("const page_programs = [\n() => (() => {\nconst model = {");
  CHECK(programs != std::string::npos);
  CHECK(page.find("function damper_advance(", programs) != std::string::npos);
  CHECK(contains(page, "\"title\":\"Beyond the records\""));
}

TEST_CASE("evaluate: takes off the inertia that the model's fit took off, says so, or keeps it" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  std::string text = read_file(small_results() / "models/bingham.json");
  const std::size_t at = text.find("\"sample_time\"");
  REQUIRE(at != std::string::npos);
  const fs::path model = folder.write("m.json", text.insert(at, "\"moving_mass_kg\": 20, "));
  const std::string command = "evaluate " + model.string() + " " + small_campaign().string();
  const auto rmse = [](const std::string& words) {
    const Value result = parse_json(stdout_of_dashpot(words + " --json").output, "evaluate --json");
    return result.find("pooled")->find("rmse_N")->as_number();
  };

  CHECK(contains(run_dashpot(command).output, "without the inertia of 20 kg"));
  CHECK_FALSE(contains(run_dashpot(command + " --keep-inertia").output, "inertia of 20 kg"));
  const Value told = parse_json(stdout_of_dashpot(command + " --json").output, "evaluate --json");
  CHECK(told.find("without_inertia")->find("mass_kg")->as_number() == 20);

  // The campaign has no such mass, so that taking it off adds an error.
  const double plain = rmse("evaluate " + (small_results() / "models/bingham.json").string() + " " +
                            small_campaign().string());
  CHECK(rmse(command + " --keep-inertia") == plain);
  CHECK(rmse(command) > 1.01 * plain);
}

TEST_CASE("evaluate: says where recordings leave the model's range") {
  const TemporaryFolder folder;
  const std::string data = (folder.path() / "fast").string();
  REQUIRE(run_dashpot("bench --motions 30x2 --levels 1 --output " + data).exit_code == 0);
  const ProgramResult result =
      run_dashpot("evaluate " + (small_results() / "models/bingham.json").string() + " " + data);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.output, "have a velocity outside the model's range"));
}

TEST_CASE("evaluate: writes a report page") {
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "page.html").string();
  const ProgramResult result =
      run_dashpot("evaluate " + (small_results() / "models/bingham.json").string() + " " +
                  small_campaign().string() + " --report " + page);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);

  // The recordings are those of the fit: the page says so, as the terminal does.
  const std::string text = read_file(page);
  CHECK(contains(result.output, "these errors are no judgement"));
  CHECK(contains(text, "these errors are no judgement"));
  CHECK(contains(text, "RMS error, free run, records of its fit"));
  CHECK(!contains(text, "free run, left-out records"));
  CHECK(!contains(text, "Fitted on all training records"));
}

TEST_CASE("evaluate: a model file with an unknown key, of another drive, or none at all") {
  const TemporaryFolder folder;
  std::string text = read_file(small_results() / "models/bingham.json");
  text.insert(text.find('{') + 1, "\"colour\": \"red\",");
  const ProgramResult key = run_dashpot("evaluate " + folder.write("odd.json", text).string() +
                                        " " + small_campaign().string());
  CHECK(key.exit_code == 1);
  CHECK(contains(key.output, "odd.json"));
  CHECK(contains(key.output, "colour"));

  const ProgramResult none = run_dashpot("evaluate nowhere.json " + small_campaign().string());
  CHECK(none.exit_code == 1);
  CHECK(contains(none.output, "nowhere.json"));

  const std::string amperes = (folder.path() / "amperes").string();
  REQUIRE(run_dashpot("bench --damper kwok2006 --motions 5x2 --levels 0,1 --output " + amperes)
              .exit_code == 0);
  const ProgramResult drive =
      run_dashpot("evaluate " + (small_results() / "models/bingham.json").string() + " " + amperes);
  CHECK(drive.exit_code == 1);
  CHECK(contains(drive.output, "driven in V"));
}

TEST_CASE("identify: killed at random moments, it goes on and fits the same to the last bit" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const fs::path whole = folder.path() / "whole", resumed = folder.path() / "resumed";
  const std::string request = "identify " + small_campaign().string() +
                              " --models bingham,modified_bouc_wen,passive_network --network "
                              "hidden=4,members=1,epochs=20 --no-report --output ";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(run_dashpot(request + whole.string()).exit_code == 0);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  // Whenever a run came to its end, the next one begins anew.
  Random random(
      static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()));
  int kills = 0, resumptions = 0;
  for (int runs = 0; kills < kills_of_identify() && runs < 20 * kills_of_identify(); ++runs) {
    const std::string moment = format_exact(random.uniform(0.05, 0.8) * seconds);
    const ProgramResult run = run_program("timeout -s KILL " + moment + " " + program_path() + " " +
                                          request + resumed.string());
    resumptions += contains(run.output, "kept from before");
    kills += run.exit_code == 137;
    if (run.exit_code == 0) fs::remove_all(resumed);
  }
  CHECK(kills == kills_of_identify());
  MESSAGE(kills << " kills, " << resumptions << " runs that came to an end went on from kept fits");

  const ProgramResult last = run_dashpot(request + resumed.string());
  CAPTURE(last.output);
  CHECK(last.exit_code == 0);
  for (const char* model : {"bingham", "modified_bouc_wen", "passive_network"})
    CHECK_MESSAGE(fitted(resumed, model) == fitted(whole, model), model);
}

TEST_CASE("identify: a model that the records cannot serve is a row with its reason") {
  const TemporaryFolder folder;
  const std::string output = " --no-report --output " + folder.path().string();
  const ProgramResult two = run_dashpot("identify " + small_campaign().string() +
                                        " --models bingham,family_gated" + output);
  CAPTURE(two.output);
  CHECK(contains(two.output, "fit failed"));
  CHECK(contains(two.output, "which a model of a family needs"));
  CHECK(fs::exists(folder.path() / "models/bingham.json"));

  // Where no model can be fitted, the reason is the error.
  const ProgramResult none =
      run_dashpot("identify " + small_campaign().string() + " --models family_gated" + output);
  CHECK(none.exit_code == 1);
  CHECK(contains(none.output, "error: "));
  CHECK(contains(none.output, "which a model of a family needs"));
}

TEST_CASE("identify: a second call goes on from kept fits, and --fresh makes them again") {
  const TemporaryFolder folder;
  const std::string asked = "identify " + small_campaign().string() +
                            " --models bingham --no-report --output " + folder.path().string();
  CHECK(!contains(run_dashpot(asked).output, "kept from before"));
  CHECK(contains(run_dashpot(asked).output, "kept from before; with --fresh"));
  CHECK(!contains(run_dashpot(asked + " --fresh").output, "kept from before"));
}
