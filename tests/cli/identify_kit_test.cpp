#include <cmath>
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// One campaign judged at a current of its own and on a second campaign, with all that a researcher
/// takes along; made once.
struct Kit {
  TemporaryFolder folder;
  std::string further = (folder.path() / "further").string();
  fs::path results = folder.path() / "results";
};
const Kit& kit() {
  static const Kit all;
  static const bool is_made = [] {
    const ProgramResult bench = run_dashpot(
        "bench --motions 12x1.5 --levels 0.5,1.5 --cycles 2 --sample-rate 200 --seed 9 --output " +
        all.further);
    REQUIRE_MESSAGE(bench.exit_code == 0, bench.output);
    const ProgramResult fit = run_dashpot(
        "identify " + small_campaign().string() +
        " --models bingham,tanh_kwok --starts 2 --leave-out current=1 --validate " + all.further +
        " --traces csv --covariance csv --output " + all.results.string());
    REQUIRE_MESSAGE(fit.exit_code == 0, fit.output);
    return true;
  }();
  REQUIRE(is_made);
  return all;
}

Value report_of(const fs::path& results) {
  return parse_json(read_file(results / "report.json"), "report.json");
}

/// The numbers of a line of CSV; words and empty fields as 0.
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  for (const std::string& field : split(line, ','))
    numbers.push_back(parse_number(field).value_or(0));
  return numbers;
}

}  // namespace

TEST_CASE("identify --traces: every record once, apart by what the fit knows of it") {
  const fs::path traces = kit().results / "traces" / "tanh_kwok";
  const auto files = [&](const char* part) {
    return std::distance(fs::directory_iterator(traces / part), fs::directory_iterator());
  };
  CHECK(files("left-out") == 3);
  CHECK(files("training") == 6);
  CHECK(files("validation") == 2);

  // What is left over is what was measured less what was modelled.
  const std::string text = read_file(traces / "left-out" / "001_5_mm_3_Hz__1_V.csv");
  const std::vector<std::string> lines = split(text, '\n');
  CHECK(lines.front() ==
        "time [s],displacement [m],velocity [m/s],voltage [V],measured [N],modelled [N],residual "
        "[N]");
  const std::vector<double> row = numbers_of(lines.at(100));
  CHECK_CLOSE(row.at(6), row.at(4) - row.at(5), 1e-6, 1e-6);
}

TEST_CASE("identify --covariance: the matrix belongs to the intervals, in CSV, MAT and JSON" *
          doctest::test_suite("long")) {
  const std::vector<std::string> lines =
      split(read_file(kit().results / "parameters" / "bingham.csv"), '\n');
  const std::vector<double> c0 = numbers_of(lines.at(1)), c1 = numbers_of(lines.at(2));
  CHECK(lines.at(1).starts_with("c0_a,N*s/m,"));
  CHECK_CLOSE(c0.at(9), c0.at(3) * c0.at(3), 1e-12, 0);
  CHECK_CLOSE(c0.at(5) - c0.at(2), 1.959963984540054 * c0.at(3), 1e-9, 0);
  CHECK(c0.at(10) == c1.at(9));
  CHECK(std::abs(c0.at(10)) <= c0.at(3) * c1.at(3));

  // The same matrix in the report; other formats from the kept fits.
  const Value report = report_of(kit().results);
  for (const Value& model : report.find("models")->items()) {
    if (model.find("name")->as_string() != "bingham") continue;
    const Value& matrix = *model.find("fit")->find("covariance");
    CHECK(matrix.items().at(0).items().at(1).as_number() == c0.at(10));
  }
  for (const std::string format : {"mat", "json"}) {
    const ProgramResult again =
        run_dashpot("identify " + small_campaign().string() +
                    " --models bingham --starts 2 --leave-out current=1 --no-report --covariance " +
                    format + " --output " + kit().results.string());
    CHECK(again.exit_code == 0);
    CHECK(contains(again.output, "Numbers  "));
    CHECK(fs::file_size(kit().results / "parameters" / ("bingham." + format)) > 500);
  }
}

TEST_CASE("identify --validate: further records beside the left-out ones, and all on the page") {
  const Value report = report_of(kit().results);
  const Value& best = report.find("models")->items().front();
  CHECK(best.find("validation")->find("records")->items().size() == 2);
  CHECK(best.find("left_out")->find("records")->items().size() == 3);
  CHECK(best.find("validation")->find("pooled")->find("esr_percent")->as_number() < 5);
  const std::string page = read_file(kit().results / "report.html");
  CHECK(contains(page, "12 mm 1.5 Hz, 1.5 V (validation)"));
  CHECK(contains(page, "5 mm 3 Hz, 2 V (training)"));
  CHECK(contains(page, "Valid. %"));
  CHECK(contains(read_file(kit().results / "report.csv"), ",validation,"));

  // What a fit sees proves nothing.
  const TemporaryFolder folder;
  const ProgramResult same =
      run_dashpot("identify " + small_campaign().string() + " --models bingham --validate " +
                  small_campaign().string() + " --output " + folder.path().string());
  CHECK(same.exit_code == 1);
  CHECK(contains(same.output, "is among the recordings that the models are fitted on"));
}

TEST_CASE("identify: residuals of each model are tested, and laws have information criteria") {
  const Value report = report_of(kit().results);
  double independent = 0;
  for (const Value& model : report.find("models")->items()) {
    CHECK(model.find("residual_tests")->find("records")->items().size() == 3);
    const Value& criteria = *model.find("information");
    const double n = criteria.find("independent_samples")->as_number(),
                 k = criteria.find("parameters")->as_number(),
                 l = criteria.find("log_likelihood")->as_number();
    CHECK_CLOSE(criteria.find("aic")->as_number(), 2 * k - 2 * l, 1e-12, 0);
    CHECK_CLOSE(criteria.find("bic")->as_number(), std::log(n) * k - 2 * l, 1e-12, 0);
    CHECK(n < criteria.find("samples")->as_number());
    if (independent > 0) CHECK(n == independent);
    independent = n;
  }
  CHECK(contains(read_file(kit().results / "report.html"), "AIC behind"));
}

TEST_CASE("identify --from: a fit that starts where another one ended, and files that do not do") {
  const std::string bingham = (kit().results / "models" / "bingham.json").string(),
                    kwok = (kit().results / "models" / "tanh_kwok.json").string();
  const std::string asked = "identify " + small_campaign().string() +
                            " --no-report --fresh --starts 1 --leave-out current=1 ";
  const auto iterations = [](const ProgramResult& result) {
    const Value report = parse_json(result.output, "identify --json");
    return report.find("models")->items().front().find("fit")->find("iterations")->as_number();
  };
  const TemporaryFolder folder;
  const std::string models = " --models tanh_kwok --json --output " + folder.path().string();
  const ProgramResult warm = stdout_of_dashpot(asked + "--from " + kwok + models),
                      cold = stdout_of_dashpot(asked + models);
  CHECK(warm.exit_code == 0);
  CHECK(iterations(warm) < iterations(cold));

  // Another law, no law, another drive, a plant instead of a bench.
  const std::string output = " --output " + folder.path().string();
  const ProgramResult other = run_dashpot(asked + "--models tanh_kwok --from " + bingham + output);
  CHECK(other.exit_code == 1);
  CHECK(contains(other.output, "is a bingham, which is not among the models to fit"));
  const ProgramResult twice =
      run_dashpot(asked + "--models bingham --from " + bingham + "," + bingham + output);
  CHECK(twice.exit_code == 1);
  CHECK(contains(twice.output, "as another of the files to start from is"));
  const ProgramResult plant = run_dashpot("identify x.csv --in y.yaml --from " + bingham + output);
  CHECK(plant.exit_code == 2);
  CHECK(contains(plant.output, "has no effect with --in"));
}
