#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/model_file.h"
#include "identify/small_campaign.h"
#include "program.h"

using namespace dashpot;

// Recordings as public sets often are: velocity and force alone, of a damper whose current nobody
// has written down. They come from the virtual bench, at one current, of a published damper with
// hysteresis and a knee.

namespace {

/// Time, velocity and force of a record as CSV, with a current where one is given.
std::string csv_of(const Record& record, const char* current = nullptr) {
  const std::vector<double>& v = record.channel("velocity").samples;
  const std::vector<double>& force = record.channel("force").samples;
  std::string text = current ? "t_s,v_m_s,F_N,i_A\n" : "t_s,v_m_s,F_N\n";
  for (std::size_t k = 0; k < record.size(); ++k)
    text += format_number(record.time[k], 9) + "," + format_exact(v[k]) + "," +
            format_exact(force[k]) + (current ? std::string(",") + current : "") + "\n";
  return text;
}

const Dataset& bench() {
  static const Dataset dataset = [] {
    BenchOptions options;
    options.motions = {{0.015, 1}, {0.01, 2}, {0.005, 4}};
    options.drive_levels = {1};
    options.sample_rate = 200;
    options.cycles = 4;
    return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options);
  }();
  return dataset;
}

/// The public set: one file per motion.
const std::filesystem::path& public_set() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    int number = 0;
    for (const Record& record : bench().records)
      folder.write("test" + std::to_string(++number) + ".csv", csv_of(record));
    return folder.path();
  }();
  return path;
}

/// What `identify` made of it: the folder of its results.
const std::filesystem::path& results() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    const std::filesystem::path to = folder.path() / "results";
    const ProgramResult made = run_dashpot(
        "identify " + public_set().string() +
        " --models bingham,tanh_kwok,mlp_one_sensor --network epochs=20 --output " + to.string());
    REQUIRE_MESSAGE(made.exit_code == 0, made.output);
    CHECK(contains(made.output, "one constant, unknown drive"));
    CHECK(contains(made.output, "no drive channel: taken as one constant, unknown drive"));
    CHECK(!contains(made.output, "varies"));
    return to;
  }();
  return path;
}

std::string model_of(const std::string& name) {
  return (results() / "models" / (name + ".json")).string();
}

}  // namespace

TEST_CASE("velocity and force alone are identified, and predict what was left out" *
          doctest::test_suite("long")) {
  const ModelFile file = load_model(model_of("tanh_kwok"));
  CHECK(file.drive_unit == DriveUnit::None);
  CHECK(file.domain.current_min == 0);
  CHECK(file.domain.current_max == 0);
  // The law is not the bench's damper alone: its displacement had to be integrated.
  CHECK(file.domain.displacement_max > 0.012);
  CHECK(file.quality.find("left_out")->find("esr_percent")->as_number() < 2);

  const std::string page = read_file(results() / "report.html");
  CHECK(contains(page, "constant drive"));
  CHECK(!contains(page, "the drive varies"));
  CHECK(read_file(results() / "report.csv").starts_with("model,record,condition,drive_none,"));
}

TEST_CASE("a model without a drive is evaluated on such recordings again, with the same errors" *
          doctest::test_suite("long")) {
  const ProgramResult result = stdout_of_dashpot("evaluate " + model_of("bingham") + " " +
                                                 public_set().string() + " --json");
  CHECK(result.exit_code == 0);
  const Value value = parse_json(result.output, "evaluate --json");
  const double again = value.find("pooled")->find("esr_percent")->as_number();
  const ModelFile file = load_model(model_of("bingham"));
  CHECK_CLOSE(again, file.quality.find("training")->find("esr_percent")->as_number(), 1e-6, 0);
}

TEST_CASE("a model without a drive is ranked, exported and driven as a passive damper is" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string to = (folder.path() / "out").string();
  const auto works = [](const std::string& arguments) {
    const ProgramResult result = run_dashpot(arguments);
    CAPTURE(arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK(!contains(result.output, "varies"));
    return result.output;
  };
  works("rank " + public_set().string() + " --models bingham,lookup_map --output " + to);
  for (const std::string format : {"c", "fmu2", "modelica", "onnx"})
    for (const std::string model : {"tanh_kwok", "mlp_one_sensor"})
      works("export " + model_of(model) + " --to " + format + " --output " + to + format);
  const std::string ride =
      works("simulate --damper " + model_of("tanh_kwok") + " --road step,height=1cm --duration 1");
  CHECK(contains(ride, "tanh_kwok"));
}

TEST_CASE("recordings with and without a drive are not one dataset, and it is said which" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder, out;
  const std::vector<Record>& records = bench().records;
  folder.write("a_1A.csv", csv_of(records[0]));
  folder.write("b.csv", csv_of(records[1], "1"));
  folder.write("unknown.csv", csv_of(records[2]));
  const std::string fit =
      "identify " + folder.path().string() + " --models bingham --output " + out.path().string();
  const ProgramResult mixed = run_dashpot(fit);
  CAPTURE(mixed.output);
  CHECK(mixed.exit_code == 1);
  CHECK(contains(mixed.output, "unknown: has no known current; 2 of 3 records have one"));
  CHECK(contains(mixed.output, "drive: none"));

  // Two ways out: the level of each, or nothing as the drive of all.
  const std::string all = "files: [{match: \"*.csv\"";
  folder.write("dataset.yaml", all + ", level: 1}]\n");
  CHECK(contains(run_dashpot(fit).output, "1 current, 1 A"));
  folder.write("dataset.yaml", "drive: none\n" + all + "}]\n");
  const ProgramResult none = run_dashpot(fit);
  CHECK(none.exit_code == 0);
  CHECK(contains(none.output, "'drive: none' in dataset.yaml"));
}

TEST_CASE("a model and recordings of different kinds of drive are refused with the remedy" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  folder.write("driven_1A.csv", csv_of(bench().records.front()));
  const ProgramResult driven =
      run_dashpot("evaluate " + model_of("bingham") + " " + folder.path().string());
  CHECK(driven.exit_code == 1);
  CHECK(contains(driven.output, "fitted at one constant, unknown drive"));
}

TEST_CASE("leaving out by current says that there is none") {
  const ProgramResult result =
      run_dashpot("identify " + public_set().string() + " --models bingham --leave-out current");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "its one drive is constant and unknown"));
}

TEST_CASE("a level is not written where the drive has no unit, and says what to do") {
  const TemporaryFolder folder;
  std::string text = "t_s,x_mm,F_N\n";
  for (int k = 0; k < 400; ++k) {
    const double t = 0.005 * k, phase = 6.283185307179586 * t;
    text += std::to_string(t) + ',' + std::to_string(10 * std::sin(phase)) + ',' +
            std::to_string(300 * std::cos(phase)) + '\n';
  }
  folder.write("run.csv", text);
  const std::string correct =
      "inspect '" + folder.path().string() + "' --correct run.csv --set 'level=0.5'";

  // Nothing tells the drive; then the dataset file says that there is none.
  const ProgramResult unknown = run_dashpot(correct);
  CAPTURE(unknown.output);
  CHECK(unknown.exit_code == 1);
  CHECK(contains(unknown.output, "level: has no effect"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "dataset.yaml"));
  const std::string entry = "files:\n  - match: run.csv\n";
  folder.write("dataset.yaml", "drive: none\n" + entry);
  const ProgramResult none = run_dashpot(correct);
  CAPTURE(none.output);
  CHECK(none.exit_code == 1);
  CHECK(contains(none.output, "beside 'drive: none' in dataset.yaml"));

  // With a unit it has its effect.
  folder.write("dataset.yaml", "drive: A\n" + entry);
  const ProgramResult driven = run_dashpot(correct);
  CAPTURE(driven.output);
  CHECK(driven.exit_code == 0);
  CHECK(contains(run_dashpot("inspect '" + folder.path().string() + "'").output, "0.5 A"));
}
