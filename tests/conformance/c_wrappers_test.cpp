#include "dashpot/export/c/c_wrappers.h"

#include "c_compile.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/export_run.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kWrapperStep = 1e-3;
constexpr std::size_t kWrapperSteps = 200;

/// Inputs and the library's force, a row a step.
std::vector<std::vector<double>> run_of(const DamperModel& model) {
  const std::vector<DamperInput> inputs =
      export_run(exported(model).domain, kWrapperStep, kWrapperSteps);
  const std::vector<double> force = force_along(model, inputs, kWrapperStep);
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < kWrapperSteps; ++k)
    rows.push_back({inputs[k].displacement, inputs[k].velocity, inputs[k].current, force[k]});
  return rows;
}

std::string run_header(const DamperModel& model) {
  std::string rows;
  for (const std::vector<double>& row : run_of(model)) rows += "  " + c_numbers(row) + ",\n";
  return "#define SAMPLE_TIME " + c_number(kWrapperStep) + "\nstatic const double kRun[][4] = {\n" +
         rows + "};\n";
}

std::string run_csv(const DamperModel& model) {
  std::string text;
  for (const std::vector<double>& row : run_of(model)) {
    for (std::size_t k = 0; k < row.size(); ++k) text += (k > 0 ? "," : "") + format_exact(row[k]);
    text += '\n';
  }
  return text;
}

void write_wrappers(const TemporaryFolder& folder, const std::vector<ExportedFile>& files) {
  for (const ExportedFile& file : files) write_file(folder.path() / file.name, file.content);
}

ProgramResult run_in(const TemporaryFolder& folder, const std::string& commands) {
  return run_program("cd '" + folder.path().string() + "' && " + commands);
}

/// A kind with a lag, one with a grid of its own, one without a state.
const std::vector<std::string> kKinds{"bouc_wen", "narx", "mlp"};

void for_each_kind(const std::function<void(const ExampleModel&)>& check) {
  for (const ExampleModel& example : example_models())
    if (std::ranges::find(kKinds, example.name) != kKinds.end()) check(example);
}

}  // namespace

TEST_CASE("exported S-function: it steps as Simulink steps it, and gives the library's force" *
          doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  for_each_kind([](const ExampleModel& example) {
    CAPTURE(example.name);
    const TemporaryFolder folder;
    write_wrappers(folder, write_sfunction(exported(*example.model),
                                           {.name = "x", .sample_time = kWrapperStep}));
    folder.write("run.h", run_header(*example.model));
    const ProgramResult result = run_in(folder, "cc -std=c99 -Wall -Wextra -Werror -isystem '" +
                                                    project_file("tests/conformance/simulink") +
                                                    "' -I. x_sfun.c x.c -lm -o x && ./x");
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
  });
}

TEST_CASE(
    "exported Modelica package: its library builds as it says, its C part gives the library's "
    "force" *
    doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  for_each_kind([](const ExampleModel& example) {
    CAPTURE(example.name);
    const TemporaryFolder folder;
    write_wrappers(folder, write_modelica(exported(*example.model),
                                          {.name = "x", .sample_time = kWrapperStep}));
    folder.write("run.h", run_header(*example.model));
    folder.write("main.c", R"(#include <math.h>
#include "run.h"
#include "x_modelica.h"
int main(void) {
  void* damper = x_create();
  double largest = 0, low = kRun[0][3], high = low;
  for (unsigned k = 0; k < sizeof kRun / sizeof kRun[0]; ++k) {
    largest = fmax(largest, fabs(x_sample(damper, kRun[k][0], kRun[k][1], kRun[k][2]) - kRun[k][3]));
    low = fmin(low, kRun[k][3]);
    high = fmax(high, kRun[k][3]);
  }
  x_destroy(damper);
  return largest <= 1e-12 * (high - low) ? 0 : 1;
}
)");
    const std::string package = read_file(folder.path() / "x/package.mo");
    const std::size_t from = package.find("<pre>") + 5, to = package.find("</pre>");
    const ProgramResult result = run_in(
        folder, "(cd x && " + package.substr(from, to - from) +
                    ") && cc -std=c99 -Wall -Wextra -Werror -I. -Ix/Resources/Include main.c "
                    "-Lx/Resources/Library/linux64 -lx -lm -o check && ./check");
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
  });
}

TEST_CASE("exported Modelica package: what begins ends, and what is called is there") {
  const LawModel model = example_law(find_law("bouc_wen"));
  ExportedModel said = exported(model);
  said.origin = "two \"lines\"\nof it";
  const std::vector<ExportedFile> files = write_modelica(
      said, {.name = "front", .sample_time = kWrapperStep, .command = "dashpot export \"<x>\""});
  REQUIRE(files.back().name == "front/package.mo");
  const std::string& text = files.back().content;
  for (const char* name :
       {"package front", "class Damper", "function constructor", "function destructor",
        "impure function sample_force", "block ForceBlock", "model ForceElement"}) {
    CAPTURE(name);
    CHECK(text.find(name) != std::string::npos);
    const std::string last = split(name, ' ').back();
    CHECK(text.find("end " + last + ";") != std::string::npos);
  }
  for (const char* function : {"front_create", "front_destroy", "front_sample"}) {
    CHECK(text.find(std::string(function) + "(") != std::string::npos);
    CHECK(files[2].content.find(std::string(function) + "(") != std::string::npos);
  }
  CHECK(std::ranges::count(text, '(') == std::ranges::count(text, ')'));
  CHECK(text.find('@') == std::string::npos);
  CHECK(text.find("&lt;x&gt;") != std::string::npos);
}

TEST_CASE("exported MEX: Octave builds it and gets the library's force" *
          doctest::test_suite("long")) {
  if (!is_there("mkoctfile") || !is_there("octave-cli")) return;
  const TemporaryFolder folder;
  std::string commands, checks;
  for_each_kind([&](const ExampleModel& example) {
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const bool single = precision == CPrecision::Single;
      const std::string name = example.name + (single ? "_s" : "_d");
      write_wrappers(
          folder, write_mex(exported(*example.model),
                            {.name = name, .precision = precision, .sample_time = kWrapperStep}));
      folder.write(name + ".csv", run_csv(*example.model));
      commands += "mkoctfile --mex " + name + "_mex.c " + name + ".c && ";
      checks += "run = csvread('" + name + ".csv'); f = " + name +
                "_mex(run(:, 1:3)); e = max(abs(f - run(:, 4))) / (max(run(:, 4)) - min(run(:, "
                "4))); printf('" +
                name + " %g\\n', e); assert(e <= " + (single ? "1e-5" : "1e-12") + ");\n";
    }
  });
  checks +=
      "try\n mlp_d_mex(1); error('a scalar was taken');\ncatch e\n "
      "assert(!isempty(strfind(e.message, 'one "
      "matrix')));\nend\n"
      "try\n mlp_d_mex(sparse(zeros(2, 3))); error('was taken');\ncatch e\n "
      "assert(!isempty(strfind(e.message, 'not a sparse one')));\nend\n";
  folder.write("check.m", checks);
  const ProgramResult result = run_in(folder, commands + "octave-cli --norc --quiet check.m");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}
