// Models as JavaScript, run by Node beside the library and beside a C compiler.
#include "dashpot/export/js/js.h"

#include <fmt/format.h>

#include "conformance/c_compile.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/export_run.h"
#include "dashpot/export/js/js_code.h"
#include "dashpot/physics/plate_flow.h"
#include "dashpot/value.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr std::size_t kJsSteps = 300;
constexpr double kJsStep = 1e-3;  // s

bool has_node() {
  if (is_there("node")) return true;
  MESSAGE("SKIPPED: node is missing");
  return false;
}

/// NAME.mjs of a model, and what `known` gives along a run, with `parameters` set in the module.
void write_js_case(const TemporaryFolder& folder, const std::string& name, const DamperModel& model,
                   const DamperModel& known, const Value& parameters = Value::object()) {
  for (const ExportedFile& file : write_js(
           exported(model), {.name = name, .sample_time = kJsStep, .command = "", .version = "1"}))
    folder.write(file.name, file.content);
  const std::vector<DamperInput> run = export_run(exported(model).domain, kJsStep, kJsSteps);
  Value inputs = Value::array();
  for (const DamperInput& input : run)
    inputs.push_back(
        Value::array(std::vector<double>{input.displacement, input.velocity, input.current}));
  folder.write(
      name + ".json",
      format_json(Value::object({{"inputs", std::move(inputs)},
                                 {"forces", Value::array(force_along(known, run, kJsStep))},
                                 {"parameters", parameters}})));
}

void check_js(const TemporaryFolder& folder) {
  const ProgramResult result = run_program("node '" + project_file("tests/export/js.mjs") + "' '" +
                                           folder.path().string() + "'");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}

/// What `double f(double x)` of a C text gives for 0 ... 9, by Node.
std::string by_node(const std::string& text) {
  constexpr std::array<std::string_view, 1> kRoots{"f"};
  const TemporaryFolder folder;
  const auto path = folder.write(
      "f.mjs", js_code(parse_c(text), kRoots, 0).text +
                   "for (let x = 0; x < 10; ++x) console.log(f(x).toPrecision(17));\n");
  return run_program("node '" + path.string() + "'").output;
}

std::string by_compiler(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("f.c", "#include <math.h>\n#include <stdio.h>\n" + text +
                          "int main(void) { int x; for (x = 0; x < 10; ++x) printf(\"%.17g\\n\", "
                          "f(x)); return 0; }\n");
  return run_program("cd '" + folder.path().string() +
                     "' && cc -std=c99 -w -ffp-contract=off f.c -lm -o f && ./f")
      .output;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& line : split(text, '\n'))
    if (const auto number = parse_number(trim(line)))
      numbers.push_back(*number);
    else if (contains(line, "nan") || contains(line, "NaN"))
      numbers.push_back(kNaN);
  return numbers;
}

std::string refusal_of(const std::string& text) {
  constexpr std::array<std::string_view, 1> kRoots{"f"};
  return message_of([&] { js_code(parse_c(text), kRoots, 0); });
}

}  // namespace

TEST_CASE("JavaScript: every kind of model gives the library's force within 1e-12 of its span" *
          doctest::test_suite("long")) {
  if (!has_node()) return;
  const TemporaryFolder folder;
  for (const ExampleModel& one : example_models())
    write_js_case(folder, one.name, *one.model, *one.model);
  check_js(folder);
}

TEST_CASE("JavaScript: a law whose parameters are set gives the force of a law that has them") {
  if (!has_node()) return;
  const TemporaryFolder folder;
  for (const char* name : {"bouc_wen", "modified_bouc_wen", "tanh_kwok", "bingham"}) {
    const LawModel law = example_law(find_law(name));
    Dependence changed = law.parameters();
    Value parameters = Value::object();
    for (std::size_t k = 0; k < changed.coefficients.size(); ++k)
      for (std::size_t index = 0; index < changed.coefficients[k].size(); ++index) {
        changed.coefficients[k][index] *= 1.25;
        parameters.add(coefficient_name(law.law().params[k].name, changed.forms[k], index),
                       changed.coefficients[k][index]);
      }
    parameters.add("lag_rate", 50.0);
    write_js_case(folder, name, law, LawModel(law.law(), changed, law.drive_unit(), 50),
                  parameters);
  }
  check_js(folder);
}

TEST_CASE("JavaScript: a family's damper whose numbers are set gives the force of that member") {
  if (!has_node()) return;
  const TemporaryFolder folder;
  const FamilyModel model = example_family_physics();
  FamilyMember other = model.member();
  other.gap *= 1.2;
  other.pole_length *= 0.9;
  other.viscosity *= 0.8;
  other.build = -1;
  for (double& stress : other.yield.stresses) stress *= 0.5;
  const double last = other.yield.stresses.back();
  write_js_case(folder, "family_physics", model, *model.with_member(other),
                Value::object({{"gap", other.gap},
                               {"pole_length", other.pole_length},
                               {"viscosity", other.viscosity},
                               {"build", other.build},
                               {"yield_stress", last}}));
  check_js(folder);

  // The plate flow alone, of the same member.
  const auto path = folder.write(
      "flow.mjs",
      fmt::format(
          "import {{create, plate_flow}} from './family_physics.mjs';\n"
          "const state = create({{gap: {}, pole_length: {}, viscosity: {}, yield_stress: {}}});\n"
          "for (const v of [-0.2, -0.01, 0.003, 0.1]) console.log(plate_flow(state, 0, v, 0.3));\n",
          other.gap, other.pole_length, other.viscosity, last));
  const std::vector<double> given = numbers_in(run_program("node '" + path.string() + "'").output);
  REQUIRE(given.size() == 4);
  const PlateGap gap{other.pole_length, other.gap_area / other.gap, other.gap};
  const double yielding = plate_yield_pressure(&gap, other.yield.at(0.3));
  std::size_t k = 0;
  for (const double v : {-0.2, -0.01, 0.003, 0.1}) {
    const double viscous =
        plate_newtonian_pressure(&gap, other.viscosity, other.piston_area * std::abs(v));
    const double force = other.piston_area * plate_bingham_pressure(viscous, yielding);
    CHECK_CLOSE(given[k++], v < 0 ? -force : force, 1e-12, 1e-12);
  }
}

TEST_CASE("JavaScript: the band of a model is as wide in a page as in the library") {
  if (!has_node()) return;
  const TemporaryFolder folder;
  const ForceBand band{.level = 0.9,
                       .records = 6,
                       .speeds = {0.02, 0.1},
                       .drives = {0, 0.5, 2},
                       .half_width = {3, 4, 5, 6, 7, 8, 10, 20, 40},
                       .spread = 1.5};
  const FamilyModel family = example_family_physics();
  ExportedModel model = exported(family);
  model.interval = band;
  for (const ExportedFile& file : write_js(model, {.name = "x", .sample_time = 1e-3}))
    folder.write(file.name, file.content);
  const std::string loops = read_file(project_file("src/dashpot/report/page/loops.js"));
  const auto path = folder.write("band.mjs", loops + R"(
const {model} = await import('./x.mjs');
console.log(model.interval.build_spread);
for (const v of [-0.3, -0.02, 0, 0.05, 0.1]) for (const i of [-1, 0, 0.2, 0.5, 3]) console.log(half_width_of(model.interval, v, i, 2));
)");
  const std::vector<double> given = numbers_in(run_program("node '" + path.string() + "'").output);
  REQUIRE(given.size() == 26);
  CHECK(given[0] == family.family().build_spread);
  std::size_t k = 1;
  for (const double v : {-0.3, -0.02, 0., 0.05, 0.1})
    for (const double i : {-1., 0., 0.2, 0.5, 3.})
      CHECK_CLOSE(given[k++], band.half_width_at({0, v, i}, 2), 1e-12, 1e-12);

  // A mean of networks has a spread that its code does not compute: no band rather than a wrong
  // one.
  const NetworkModel networks("mlp_one_sensor", {"velocity", "current"},
                              {example_mlp(1), example_mlp(2)});
  ExportedModel several = exported(networks);
  several.interval = band;
  folder.write("y.mjs", write_js(several, {.name = "y", .sample_time = 1e-3}).front().content);
  const auto ask = folder.write(
      "ask.mjs", "console.log((await import('./y.mjs')).model.interval === null ? 1 : 0);\n");
  CHECK(numbers_in(run_program("node '" + ask.string() + "'").output) == std::vector<double>{1});
}

TEST_CASE("JavaScript: C means there what a compiler takes it for" * doctest::test_suite("long")) {
  if (!has_node() || !is_there("cc")) return;
  for (
      const char* text :
      {// Whole numbers: division, remainder, cuts, truths as numbers.
       R"(double f(double x) { int k = (int)(x * 1.7), j = k / 3, n = -k / 2; int cut = x * 0.9;
           k *= 2; k /= 3; return k + 10 * j + 100 * (k % 4) + n + (x > 3) + 1000 * cut + (k == j) * 0.5 + !(k > 2); })",
       // What is no number: in conditions, fmin, fmax, pow, comparisons.
       R"(double f(double x) { const double none = (x - x) / (x - x); double sum = none ? 1 : 2;
           sum += fmin(none, x) + 10 * fmax(x, none) + pow(1, none) + (isnan(none) != 0) + (isfinite(x) != 0);
           if (none == none) sum = 7; if (none != none && !(none < 1)) { sum += 0.25; } return sum; })",
       // Structs, arrays and pointers, in each other and to each other.
       R"(typedef struct Pair { double a; double b[3]; } Pair;
          typedef struct Two { Pair first, second; const double* to; int count; } Two;
          static const double kRow[] = {1.5, -2, 3e-3};
          static const Pair kPairs[2] = {{1, {2, 3}}, {4, {5, 6, 7}}};
          static const Two kTwo = {{1, {2, 3, 4}}, {5, {6, 7, 8}}, kRow, 3};
          static void swap(double* a, double* b) { const double kept = *a; *a = *b; *b = kept; }
          static Pair made(double x) { Pair p = {0}; p.a = x; p.b[1] = 2 * x; if (x > 5) return kPairs[1]; return p; }
          double f(double x) { Two two = kTwo; Pair* p = &two.second; const Pair pair = made(x); double sum = 0; int k;
            const double* row = two.to; double* at = p->b + 1; two.first = pair; swap(&p->a, &two.first.b[1]); *at += x; ++at;
            for (k = 0; k < two.count; ++k, ++row) { sum += *row * (p->b[k] + two.first.b[k]); }
            at -= 2; return sum + p->a + *at + kPairs[1].b[2] + pair.b[1] + (&kPairs[1])->a; })",
       // Order, signs and brackets.
       R"(double f(double x) { double a = x - (2 - x), b = -(-x), c = x / (2 / (x + 1)), d = - x * -2; int k = 0, j;
           j = (++k, k + 1); a = b = c - (a - b); return a + b * (c + d) - -x + (x > 2 ? k : j) + (x < 5 ? x < 2 ? 1 : 2 : 3) + (x <= 3 == (x > 1)); })",
       // Names that JavaScript keeps for itself, variables that hide others, loops that end early.
       R"(static double in(const double* let) { double var = *let; { double var = 2; { double new = var; var = new + 1; } } return var; }
          static const int kMost = 6;
          double f(double x) { double this = x, sum = 0; int k = 0; while (k < 100) { double t = k * this; if (t > 20 || k >= kMost) break; ++k; if (k == 2) ; else sum += t; }
            return sum + in(&this) + copysign(k, -x) + expm1(0.1 * x) + log1p(x) + atan2(x, 3) + floor(-0.5 * x); })",
       // The words of the laws: pointers to pointers, a state that parameters lie behind.
       R"(typedef struct Law { double gain, rate; } Law;
          static const Law kLaw = {3, 4};
          static void start(double* state) { Law* law = (Law*)(void*)(state + 2); *law = kLaw; }
          static double of(const Law* const* laws, const double* state) { return laws[0]->gain * state[0] + laws[1]->rate * state[1] + ((const Law*)(const void*)(state + 2))->rate; }
          double f(double x) { double state[4] = {x, 2}; Law own; const Law* laws[2]; start(state); own.gain = 7; own.rate = x; laws[0] = &own; laws[1] = &kLaw; return of(laws, state); })"}) {
    CAPTURE(text);
    const std::string given = by_node(text), right = by_compiler(text);
    CAPTURE(given);
    CAPTURE(right);
    const std::vector<double> js = numbers_in(given), c = numbers_in(right);
    REQUIRE(c.size() == 10);
    REQUIRE(js.size() == 10);
    for (std::size_t k = 0; k < c.size(); ++k) CHECK_CLOSE(js[k], c[k], 1e-15, 1e-15);
  }
}

TEST_CASE("JavaScript: what it cannot be is refused, with the name of the function") {
  CHECK(contains(refusal_of("static double g(double x) { return x > 0 ? g(x - 1) : 0; }\n"
                            "double f(double x) { return g(x); }"),
                 "C function g: calls itself"));
  CHECK(contains(refusal_of("double f(double x) { return lgamma(x); }"),
                 "C function f: calls 'lgamma', which JavaScript has not"));
  CHECK(contains(refusal_of("typedef struct P { double a; } P;\n"
                            "static double g(P p) { return p.a; }\n"
                            "double f(double x) { P p; p.a = x; return g(p); }"),
                 "C function g: takes the struct 'p' by value"));
  const LawModel law = example_law(find_law("bingham"));
  CHECK(contains(message_of([&] { write_js(exported(law), {.precision = CPrecision::Single}); }),
                 "cannot be JavaScript in single precision"));
}

TEST_CASE("JavaScript: the module says what the model is, and takes no parameter it has not") {
  if (!has_node()) return;
  const TemporaryFolder folder;
  const LawModel law = example_law(find_law("bingham"));
  ExportedModel model = exported(law);
  model.origin = "</script> \xE2\x80\xA8 \xF0\x9F\x98\x80 \xE2\x80\xAE";
  for (const ExportedFile& file : write_js(model, {.name = "x", .sample_time = 2e-3})) {
    folder.write(file.name, file.content);
    CHECK(!contains(file.content, "</"));
    CHECK(std::ranges::all_of(file.content, [](char c) { return c >= 0; }));
  }
  const auto path = folder.write("ask.mjs", R"(import * as damper from './x.mjs';
const {model} = damper, of = (name) => model.parameters.find((one) => one.name === name);
console.log(Object.keys(damper).sort().join(), model.name, model.kind, model.sample_time, model.state_size === damper.create().length);
console.log(model.inputs.map(({name, unit, low, high}) => [name, unit, low, high].join()).join(' '));
console.log(model.origin === '</script> \u2028 \u{1F600} \u202e', of('lag_rate').value, of('lag_rate').unit);
try { damper.create({gain: 1}); } catch (error) { console.log(error.message); }
try { damper.create({lag_rate: '1e2 Hz'}); } catch (error) { console.log(error.message); }
try { damper.step(new Float64Array(2), 0, 0, 0); } catch (error) { console.log(error.message); }
)");
  const std::string output = run_program("node '" + path.string() + "'").output;
  CAPTURE(output);
  CHECK(contains(output, "advance,create,force,model,reset,step bingham law 0.002 true\n"));
  CHECK(contains(output,
                 "displacement,m,-0.02,0.02 velocity,m/s,-0.3,0.3 current,A,0,2\ntrue 100 1/s\n"));
  CHECK(contains(
      output, "gain is no parameter of bingham\nlag_rate is 1e2 Hz, not a number\na state has "));
}
