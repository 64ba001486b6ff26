#include "dashpot/damper/kinds/law/law_text.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "damper/kinds/law/example_law_text.h"
#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/damper/registry.h"
#include "dashpot/model_file.h"
#include "support.h"

using namespace dashpot;

namespace {

std::string my_bouc_wen_file() { return project_file("examples/laws/my_bouc_wen.yaml"); }

/// The law that computes one expression of a and b, as its force.
std::shared_ptr<const LawText> force_law(const std::string& expression) {
  return parse_law_text(
      "law: one\nsource: test\nparameters:\n"
      "  a: {unit: 1, value: 0.6, bounds: [-9, 9]}\n  b: {unit: 1, value: 0.3, bounds: [-9, 9]}\n"
      "equations:\n  - \"sum = a + b\"\n  - \"F = 0*sum + " +
          expression + "\"\n",
      "one.yaml");
}

double value_of(const std::string& expression, double x = 0.2, double v = -0.7) {
  const auto text = force_law(expression);
  const std::array p{0.6, 0.3, 0.0};
  return text->law().force(p.data(), x, v, nullptr);
}

/// The text of the example with one part replaced by another.
std::string with(const std::string& part, const std::string& by) {
  std::string text = kExampleLawText;
  const std::size_t at = text.find(part);
  REQUIRE(at != std::string::npos);
  return text.replace(at, part.size(), by);
}

std::string refusal(const std::string& text) {
  return message_of([&] { parse_law_text(text, "my.yaml"); });
}

std::vector<double> examples(const Law& law) {
  std::vector<double> values;
  for (const ParamInfo& row : law.params) values.push_back(row.value);
  return values;
}

/// A motion with turns and rests, under a current that stays or sweeps.
std::vector<double> forces_along(const LawModel& model, bool sweeps) {
  std::vector<double> state(model.state_size()), forces;
  DamperInput before{0, 0.1, 0.2};
  model.rest(before, state);
  for (int k = 1; k < 4000; ++k) {
    const double t = 1e-3 * k, w = 2 * std::numbers::pi;
    const DamperInput now{0.01 * std::sin(w * t) + 0.002 * std::sin(7.3 * w * t),
                          0.01 * w * std::cos(w * t) + 0.0146 * w * std::cos(7.3 * w * t),
                          sweeps ? 0.2 + 0.2 * t : 0.2};
    model.advance(before, now, 1e-3, state);
    forces.push_back(model.force(now, state));
    before = now;
  }
  return forces;
}

/// Each parameter follows the current as its table says.
LawModel driven(const Law& law) {
  Dependence d;
  for (const ParamInfo& row : law.params) {
    d.forms.push_back(row.form);
    d.coefficients.emplace_back(coefficient_count(row.form), 0.3 * row.value).front() = row.value;
  }
  return LawModel(law, d, DriveUnit::Ampere, 0);
}

/// The largest difference over the largest force.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(a[k] - b[k]));
    size = std::max(size, std::abs(b[k]));
  }
  return largest / size;
}

}  // namespace

TEST_CASE("expressions have the value that they have in print") {
  const double a = 0.6, b = 0.3, x = 0.2, v = -0.7;
  CHECK(value_of("1 + 2*3 - 4/8") == 6.5);
  CHECK(value_of("-2^2") == -4);
  CHECK(value_of("2^3^2") == 512);
  CHECK(value_of("2^-1") == 0.5);
  CHECK(value_of("8/4/2 - 3 - 2") == -4);
  CHECK(value_of("(a + b)*(x - v)") == (a + b) * (x - v));
  CHECK(value_of("a*x + b*v") == a * x + b * v);
  CHECK(value_of("a - b*v + 2.5e-1*a") == a - b * v + 0.25 * a);
  CHECK(value_of("abs(v) + sign(v) + sign(0)") == -v - 1);
  CHECK(value_of("tanh(v) + atan(x) + exp(a) + log(b) + sqrt(a)") ==
        std::tanh(v) + std::atan(x) + std::exp(a) + std::log(b) + std::sqrt(a));
  CHECK(value_of("sin(v) + cos(x) + tan(a) + atanh(b)") ==
        std::sin(v) + std::cos(x) + std::tan(a) + std::atanh(b));
  CHECK(value_of("min(a, b) - max(x, v) + pi") == b - x + std::numbers::pi);
  CHECK(value_of("abs(v)^a") == std::pow(-v, a));
  CHECK(value_of("where(v < 0, a, b)") == a);
  CHECK(value_of("where(v >= 0 or x > 1 and a == a, a, b)") == b);
  CHECK(value_of("where(v > 0, a, where(x <= 0.2, log(b), 1/0))*where(v > 0, 1, 2)") ==
        std::log(b) * 2);
  CHECK(value_of("v*where(v*x < 0, v*x, x/v) + v*x") == v * (v * x) + v * x);
}

TEST_CASE("expressions by chance agree with the same ones by hand, whatever their order") {
  // Pairs of a text and a function; sums and products of them exercise the forms of operations.
  Random random(4);
  struct Part {
    std::string text;
    double value;
  };
  const std::vector<Part> leaves{{"a", 0.6}, {"b", 0.3}, {"x", 0.2}, {"v", -0.7}, {"2", 2}};
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Part> parts = leaves;
    const auto any = [&] {
      return parts[static_cast<std::size_t>(random.uniform() * static_cast<double>(parts.size()))];
    };
    for (int k = 0; k < 12; ++k) {
      const Part l = any(), r = any();
      const std::string open = "(" + l.text, close = r.text + ")";
      switch (static_cast<int>(random.uniform() * 7)) {
        case 0:
          parts.push_back({open + "+" + close, l.value + r.value});
          break;
        case 1:
          parts.push_back({open + "-" + close, l.value - r.value});
          break;
        case 2:
          parts.push_back({open + "*" + close, l.value * r.value});
          break;
        case 3:
          parts.push_back({"abs" + open + "/(2+abs(" + r.text + ")))",
                           std::abs(l.value / (2 + std::abs(r.value)))});
          break;
        case 4:
          parts.push_back({"(-" + l.text + ")", -l.value});
          break;
        case 5:
          parts.push_back({"where(" + l.text + " < " + r.text + ", tanh(" + l.text + "), " +
                               l.text + "*" + r.text + ")",
                           l.value < r.value ? std::tanh(l.value) : l.value * r.value});
          break;
        default:
          parts.push_back({open + "*" + r.text + "+" + l.text + ")", l.value * r.value + l.value});
      }
    }
    const Part& last = parts.back();
    if (last.text.size() > 3500) continue;
    CAPTURE(last.text);
    CHECK(value_of(last.text) == last.value);
  }
}

TEST_CASE("what is wrong in a law's file is refused with its place and what would be right") {
  REQUIRE(refusal(kExampleLawText).empty());

  // In an expression.
  CHECK(contains(refusal(with("(v - v_f)\"", "(v - w_f)\"")),
                 "my.yaml:19: 'r*(v - w_f)' has 'w_f', which is neither a parameter, a state nor "
                 "defined above; did you mean 'v_f'?"));
  CHECK(
      contains(refusal(with("min(u, 3)", "minn(u, 3)")), "unknown function 'minn'; did you mean"));
  CHECK(contains(refusal(with("abs(z)", "abs(z, 2)")), "'abs(z, 2)/z_y' has ',' where ')'"));
  CHECK(contains(refusal(with("abs(z)", "abs z")), "no argument behind abs"));
  CHECK(contains(refusal(with("c*v +", "c v +")), "a product is written with *"));
  CHECK(contains(refusal(with("c*v +", "c(v) +")), "calls 'c', which is no function"));
  CHECK(contains(refusal(with("c*v +", "c**v +")), "a power is written with ^"));
  CHECK(contains(refusal(with("c*v +", "1.2.3*c*v +")), "'1.2.3', which is no number"));
  CHECK(contains(refusal(with("c*v +", "c*v + * ")), "where a number, a name or '(' is expected"));
  CHECK(contains(refusal(with("u < 2 or", "u or")), "where a condition compares"));
  CHECK(contains(refusal(with("c*v +", "c*v + (v < 1) +")), "has '<' where ')' is expected"));
  CHECK(contains(refusal(with("c*v +", std::string(60, '(') + "v")), "nested more than 50 levels"));
  CHECK(contains(refusal(with("c*v +", std::string(60, '-') + "v")), "nested more than 50 levels"));
  CHECK(contains(refusal(with("c*v +", "c*v + " + std::string(5000, ' '))), "at most 4000"));

  // Of equations as a whole.
  CHECK(contains(refusal(with("  - \"dz/dt = v", "  - \"q = v")), "how the state z changes"));
  CHECK(contains(refusal(with("dv_f/dt", "dw/dt")), "is the rate of no state; known: dz/dt"));
  CHECK(contains(refusal(with("F = ", "force = ")), "give no force"));
  CHECK(contains(refusal(with("soft = ", "k = ")), "the name 'k' is given twice"));
  CHECK(contains(refusal(with("soft = ", "exp = ")), "has a meaning of its own"));
  CHECK(contains(refusal(with("g*soft", "g")), "no equation takes 'soft'"));
  CHECK(contains(refusal(with("rate: max", "rate: z*max")), "'z', which is neither"));
  CHECK(contains(refusal(with("rate: max(r, 4*p*abs(v)/z_y)", "")), "the key 'rate' is missing"));
  CHECK(contains(refusal(with("rate: max(r, 4*p*abs(v)/z_y)", "rate: -r")), "'rate' is -150"));
  CHECK(contains(refusal(with("r*(v - v_f)", "r*(v - v_f - x)")), "does not rest at x = -0.02 m"));
  CHECK(contains(refusal(with("log(2 +", "log(-2 +")), "the force is no number at t = 0 s"));
  CHECK(contains(refusal(with("rate: max", "speed: max")), "speed"));

  // Of tables.
  CHECK(contains(refusal(with("N*s/m", "N*s/furlong")), "unknown unit 'N*s/furlong'"));
  CHECK(contains(refusal(with("N*s/m", "N*s/mm")), "'N*s/mm' is no SI unit"));
  CHECK(contains(refusal(with("  g: ", "  unused: {unit: N, value: 1, bounds: [0, 2]}\n  g: ")),
                 "no equation takes the parameter unused"));
  CHECK(contains(refusal(with("value: 900", "value: -900")), "c is -900; within its bounds"));
  CHECK(contains(refusal(with("[1e-5, 1]", "[1, 1]")), "write [lowest, highest]"));
  CHECK(contains(refusal(with("form: linear", "form: square")), "square"));
  CHECK(contains(refusal(with("fit: fixed", "fit: bias")), "unknown role in a fit 'bias'"));
  CHECK(contains(refusal(with("  g: ", "  int: ")), "'int' has a meaning of its own"));
  CHECK(contains(refusal(with("  g: ", "  g*/: ")), "cannot be a name in equations"));
  CHECK(contains(refusal(with("  g: ", "  k_a: ")), "is also a coefficient of 'k'"));
  CHECK(contains(refusal(with("law: two_states", "law: Two States")), "cannot name a law"));
  CHECK(contains(refusal(with("source: made up for a test", "")), "source"));

  // Of sizes: parameters, operations.
  std::string many = "law: m\nsource: t\nparameters:\n";
  for (int k = 0; k < 30; ++k)
    many += "  p" + std::to_string(k) + ": {unit: 1, value: 1, bounds: [0, 2]}\n";
  CHECK(contains(refusal(many + "equations: [F = p0]"), "has more than 19 parameters"));
  std::string sums = "law: m\nsource: t\nparameters: {k: {unit: N, value: 1, bounds: [0, 2]}}\n";
  sums += "equations:\n  - F = k";
  for (int k = 2; k < 700; ++k) sums += "+" + std::to_string(k);
  CHECK(contains(refusal(sums + "\n"), "more than 500 different operations"));

  // Of the closed form.
  const auto travel = [](const std::string& part, const std::string& by) {
    std::string text = kTravellingLawText;
    return refusal(text.replace(text.find(part), part.size(), by));
  };
  CHECK(contains(travel("exp(-rho*abs(s))", "exp(-rho*abs(x))"), "'x', which is neither"));
  CHECK(contains(travel("travel_holds: rho > 0", "travel_holds: w > 0"), "'w', which is neither"));
  CHECK(contains(travel("  - w = side*(1", "  - q = side*(1"), "what becomes of w"));
}

TEST_CASE("a where() in a where(), many times over, neither explodes nor computes both ways") {
  // Each level takes the one before in both of its ways: 2^40 operations, were they repeated.
  std::string text =
      "law: deep\nsource: t\nparameters: {a: {unit: N, value: 1, bounds: [0, 2]}}\nequations:\n"
      "  - u0 = a*v\n";
  for (int k = 1; k <= 40; ++k) {
    const std::string before = "u" + std::to_string(k - 1);
    text += "  - u" + std::to_string(k) + " = where(" + before + " < 1, " + before + " + 1, " +
            before + " - 1)\n";
  }
  const auto law = parse_law_text(text + "  - F = u40\n", "deep.yaml");
  const std::array p{1.0, 0.0};
  CHECK(law->law().force(p.data(), 0, 0.25, nullptr) == 0.25);  // up and down twenty times
}

TEST_CASE("the Bouc-Wen law from a file has the numbers of Dashpot's own") {
  const auto text = load_law_text(my_bouc_wen_file());
  const Law &mine = text->law(), &own = find_law("bouc_wen");

  // The same table, but for the words.
  REQUIRE(mine.params.size() == own.params.size());
  for (std::size_t k = 0; k < own.params.size(); ++k) {
    const ParamInfo &a = mine.params[k], &b = own.params[k];
    CAPTURE(std::string(b.name));
    CHECK(a.name == b.name);
    CHECK(a.unit == b.unit);
    CHECK(a.value == b.value);
    CHECK(a.lower == b.lower);
    CHECK(a.upper == b.upper);
    CHECK(a.start == b.start);
    CHECK(a.form == b.form);
    CHECK(a.fit == b.fit);
  }

  // The same functions at any point.
  Random random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> p = examples(own);
    for (std::size_t k = 0; k < p.size(); ++k) p[k] *= std::exp(random.normal());
    p[7] = trial % 2 ? 2 : 1 + 3 * random.uniform();
    p[5] *= trial % 3 ? 1 : -0.5;
    p[5] = std::max(p[5], -0.4 * p[4]);
    const double x = 0.01 * random.normal(), v = 0.1 * random.normal(), z = 0.005 * random.normal();
    double dz[2] = {}, both[2] = {};
    mine.derivative(p.data(), x, v, &z, &dz[0]);
    own.derivative(p.data(), x, v, &z, &dz[1]);
    CHECK_CLOSE(dz[0], dz[1], 1e-12, 1e-12 * p[6] * std::abs(v));
    const double force = own.force(p.data(), x, v, &z);
    CHECK_CLOSE(mine.force(p.data(), x, v, &z), force, 1e-12, 0);
    CHECK(mine.flow(p.data(), x, v, &z, both) == mine.force(p.data(), x, v, &z));
    CHECK(both[0] == dz[0]);
    CHECK_CLOSE(mine.rate(p.data(), v), own.rate(p.data(), v), 1e-12, 0);
  }

  // The same force along a run: by the closed form, by steps, and by both.
  const LawModel constant = LawModel::constant(own, examples(own));
  CHECK(difference(forces_along(LawModel::constant(mine, examples(mine)), false),
                   forces_along(constant, false)) < 1e-12);
  for (const bool sweeps : {false, true})
    CHECK(difference(forces_along(driven(mine), sweeps), forces_along(driven(own), sweeps)) <
          1e-12);
}

TEST_CASE(
    "a law of steps from a file has the numbers of Dashpot's own, in one operation list too") {
  const auto text = parse_law_text(
      "law: mine\nsource: t\nstates: {v_f: {unit: m/s, rest: v}}\nparameters:\n"
      "  f_y: {unit: N, value: 1034.51, bounds: [0, 1e6], form: quadratic}\n"
      "  kappa: {unit: s/m, value: 99.3466, bounds: [1e-3, 1e6]}\n"
      "  tau: {unit: s, value: 7.65641e-3, bounds: [0, 1]}\n"
      "  c: {unit: N*s/m, value: 6256.33, bounds: [0, 1e8], form: linear}\n"
      "  r: {unit: 1/s, value: 200, bounds: [1, 1e4]}\n"
      "equations:\n  - dv_f/dt = r*(v - v_f)\n"
      "  - F = f_y*tanh(kappa*(v - tau*(r*(v - v_f)))) + c*v\nrate: r\n",
      "mine.yaml");
  std::vector<double> values = examples(find_law("tanh_acceleration"));
  values.back() = 0;
  for (const bool sweeps : {false, true})
    CHECK(forces_along(LawModel::constant(text->law(), values), sweeps) ==
          forces_along(LawModel::constant(find_law("tanh_acceleration"), values), sweeps));

  // A whole step at once is the same, to the bit, as its operations one by one: with parameters
  // that stay the program takes the one, with equal ones that are told apart the other.
  const Law& law = example_law_text()->law();
  const std::vector<double> p = examples(law), again = p;
  const std::array x{0.001, 0.0015, 0.002}, v{0.1, 0.12, 0.14};
  double z[2] = {0.001, 0.05}, other[2] = {0.001, 0.05};
  const double *const same[] = {p.data(), p.data(), p.data()}, *const apart[] = {p.data(),
                                                                                 again.data(),
                                                                                 p.data()};
  for (int k = 0; k < 50; ++k) {
    law.runge_kutta(same, x.data(), v.data(), 1e-3, 2, z);
    law.runge_kutta(apart, x.data(), v.data(), 1e-3, 2, other);
    CHECK(z[0] == other[0]);
    CHECK(z[1] == other[1]);
  }
}

TEST_CASE("laws take turns in one thread, and each keeps its own parameters") {
  const Law &one = example_law_text()->law(), &two = travelling_law_text()->law();
  std::vector<double> p = examples(one), q = examples(two);
  const double z[2] = {0.002, 0.1};
  const double first = one.force(p.data(), 0.01, 0.2, z), second = two.force(q.data(), 0, 0.2, z);
  p[1] *= 2;
  const double changed = one.force(p.data(), 0.01, 0.2, z);
  CHECK(changed != first);
  p[1] /= 2;
  CHECK(two.force(q.data(), 0, 0.2, z) == second);
  CHECK(one.force(p.data(), 0.01, 0.2, z) == first);
}

TEST_CASE("the current in an equation is that in the coil, and no number to fit") {
  const Law& law = example_law_text()->law();
  const ParamInfo& row = law.params[law.index_of("i")];
  CHECK(row.fit == Fit::Drive);
  const LawModel model = LawModel::constant(law, examples(law));
  const double state[] = {0.002, 0.0};
  const double without = model.force({0, 0, 0}, state), with = model.force({0, 0, 2}, state);
  CHECK_CLOSE(with - without, 40000 * 0.4 * 0.002, 1e-12, 0);
  CHECK(law.needs_displacement);
  CHECK_FALSE(travelling_law_text()->law().needs_displacement);
}

TEST_CASE("a model file holds the law, and works where the law's file is not known") {
  ModelFile file;
  const Law& law = with_side(example_law_text()->law());
  file.model = std::make_unique<LawModel>(LawModel::constant(law, examples(law)));
  const std::string written = format_model(file);
  const ModelFile back = parse_model(written, "m.json");
  CHECK(format_model(back) == written);
  const auto* model = model_as<LawModel>(*back.model);
  REQUIRE(model);
  CHECK(&model->law() != &law);  // made from the file alone
  CHECK(message_of([] { find_law("two_states"); }) != "");
  CHECK(forces_along(*model, true) == forces_along(LawModel::constant(law, examples(law)), true));
  CHECK(info_of(*back.model).title == "An example of two states");

  // A definition under another name, or one that is no law, is refused with its place.
  std::string other = written;
  other.replace(other.find("two_states"), 10, "two_stated");
  CHECK(contains(message_of([&] { parse_model(other, "m.json"); }),
                 "is 'two_stated', but 'two_states' in its definition"));
  std::string taken = written;
  for (int k = 0; k < 2; ++k) taken.replace(taken.find("two_states"), 10, "bingham");
  CHECK(contains(message_of([&] { parse_model(taken, "m.json"); }), "defines 'bingham' anew"));
  std::string broken = written;
  broken.replace(broken.find("r*(v - v_f)"), 11, "system(v_f)");
  CHECK(contains(message_of([&] { parse_model(broken, "m.json"); }), "unknown function 'system'"));
}

TEST_CASE("a file's law is known by its name, the latest text of a name first") {
  TemporaryFolder folder;
  std::string text = kTravellingLawText;
  text.replace(text.find("travels"), 7, "known_law");
  const std::string path = folder.write("my.yaml", text);
  CHECK(model_named(path) == "known_law");
  const Law& first = find_law("known_law");
  CHECK(&know_law(path) == &first);  // the same text
  CHECK(model_info("known_law").law == &first);

  text.replace(text.find("value: 600"), 10, "value: 700");
  folder.write("my.yaml", text);
  CHECK(&know_law(path) != &first);
  CHECK(find_law("known_law").params.front().value == 700);
  CHECK(first.params.front().value == 600);

  // Names of Dashpot's own models are not to be had.
  for (const std::string name : {"bingham", "anfis"}) {
    std::string taken = kTravellingLawText;
    taken.replace(taken.find("travels"), 7, name);
    CHECK(contains(message_of([&] { model_named(folder.write("taken.yaml", taken)); }),
                   "of Dashpot's own; give the law another name"));
  }
  CHECK(model_named("bingham") == "bingham");
}
