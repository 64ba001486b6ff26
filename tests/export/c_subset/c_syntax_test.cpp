#include "dashpot/export/c_subset/c_syntax.h"

#include "dashpot/export/c/c_text.h"
#include "support.h"

using namespace dashpot;

namespace {

/// What calls exported C from elsewhere is C of another kind: with characters, memory and switches.
bool is_of_an_interface(std::string_view name) {
  return name.starts_with("fm") || name == "mex.c" || name == "sfunction.c" || name == "modelica.h";
}

/// The types and sizes that texts say in their first comment must be declared before.
std::string declared_before() {
  std::string code;
  for (const char* type :
       {"damper_input", "damper_model",    "damper_signals", "damper_demand", "DamperInput",
        "DamperDemand", "DemandKind",      "FilterSample",   "FirstRoot",     "LawPath",
        "RootBracket",  "StrutSignals",    "ControlLimits",  "ForceLoop",     "InverseInput",
        "InverseModel", "LawModel",        "LawParameters",  "Mlp",           "Observer",
        "PlantFilter",  "PolynomialError", "RootError",      "SearchError"})
    code += "typedef struct " + std::string(type) + " { double x; } " + type + ";\n";
  for (const char* size : {"CELL_MOST_CURRENTS",   "CELL_MOST_FEATURES",
                           "CELL_MOST_INPUTS",     "CELL_MOST_LAG",
                           "CELL_MOST_WIDTH",      "DAMPER_INPUTS",
                           "DAMPER_PLANT_STATES",  "DAMPER_SAMPLE_TIME",
                           "DAMPER_STATE_SIZE",    "DAMPER_SENSORS",
                           "DAMPER_DRIVES",        "DAMPER_STRUTS",
                           "FILTER_MOST",          "FILTER_MOST_SENSORS",
                           "FILTER_MOST_INPUTS",   "FILTER_MOST_DAMPER",
                           "FILTER_MOST_DAMPERS",  "FILTER_MOST_MEMORY",
                           "FILTER_KEPT",          "GATED_MOST_GATES",
                           "GATED_MOST_SIGNALS",   "INVERSE_STATES",
                           "INVERSE_TAPS",         "LAW_MOST_STATES",
                           "MLP_MOST_WIDTH",       "NARX_MOST_INPUTS",
                           "PASSIVE_MOST_INPUTS",  "PASSIVE_MOST_NEURONS",
                           "PASSIVE_MOST_SPRINGS", "STRUT_STATE",
                           "SUGENO_MOST_INPUTS",   "SUGENO_MOST_MEMBERSHIPS",
                           "SUGENO_MOST_RULES"})
    code += "#define " + std::string(size) + " 2\n";
  return code;
}

std::string refused(const std::string& code) {
  return message_of([&] { parse_c(code); });
}

}  // namespace

TEST_CASE(
    "C subset: every C text of the project is in it but what calls exported C from elsewhere") {
  const std::string before = declared_before();
  for (const auto& [name, text] : c_texts()) {
    if (is_of_an_interface(name)) continue;
    CAPTURE(name);
    const std::string code = before + with_texts(text);
    CHECK(message_of([&] { parse_c(code); }) == "");
  }
}

TEST_CASE("C subset: what a text says") {
  const CProgram program = parse_c(
      "#ifdef __cplusplus\nextern \"C\" {\n#endif\n"
      "#define SIZE 3\n"
      "typedef enum Side { kLeft, kRight, } Side;\n"
      "typedef struct Pair { double first, second[SIZE]; const Side* sides; } Pair;\n"
      "static const double kTable[] = {1.5, 2.0F, 1e-3, 4.};\n"
      "double sum(const Pair* p, int n);\n"
      "double sum(const Pair* p, int n) { return p->first + (double)n; }\n");
  CHECK(program.size_of_struct("Pair") == 5);
  REQUIRE(program.globals.size() == 3);  // two names of the enumeration, the table
  CHECK(program.globals[1].name == "kRight");
  CHECK(program.globals[1].initialiser[0].value[0].number == 1);
  CHECK(program.globals[2].type.count == 4);
  CHECK(program.globals[2].initialiser[0].list[3].value[0].number == 4);
  const CFunction& sum = program.functions.at("sum");
  CHECK(sum.parameters[0].type.is_pointer());
  const CExpr& value = sum.body[0].parts[0].exprs[0];
  CHECK(value.text == "+");
  CHECK(value.parts[0].kind == CExpr::Kind::Member);
  CHECK(value.parts[0].parts[0].text == "*");
  CHECK(value.parts[1].kind == CExpr::Kind::Cast);
  CHECK(message_of([&] { (void)program.size_of_struct("None"); }) ==
        "C text: has no struct 'None'");
}

TEST_CASE("C subset: operators bind as in C") {
  const auto tree = [](const std::string& expression) {
    const CProgram program = parse_c("int f(int a) { return " + expression + "; }");
    const auto written = [](const auto& self, const CExpr& expr) -> std::string {
      if (expr.kind == CExpr::Kind::Name) return expr.text;
      if (expr.kind == CExpr::Kind::Number) return std::to_string(static_cast<int>(expr.number));
      std::string out = "(" + expr.text;
      for (const CExpr& part : expr.parts) out += " " + self(self, part);
      return out + ")";
    };
    return written(written, program.functions.at("f").body[0].parts[0].exprs[0]);
  };
  CHECK(tree("a - 1 - 2 * 3") == "(- (- a 1) (* 2 3))");
  CHECK(tree("a < 1 == 2 && 3 || !a") == "(|| (&& (== (< a 1) 2) 3) (! a))");
  CHECK(tree("a ? 1 : a ? 2 : 3") == "(? a 1 (? a 2 3))");
  CHECK(tree("-a[1] % f(a, 2)") == "(% (- ( a 1)) (f a 2))");
}

TEST_CASE("C subset: what is outside of it is refused with its line and what would be right") {
  CHECK(refused("double f(double x) {\n  do { x = 1; } while (x > 2);\n  return x;\n}") ==
        "C text:2: has 'do', which is outside of the subset of C; while");
  CHECK(refused("unsigned f;") ==
        "C text:1: has 'unsigned', which is outside of the subset of C; "
        "int");
  CHECK(refused("#if A > 1\n#endif") ==
        "C text:1: has the directive '#if'; #include, #define NAME VALUE, #ifdef, #ifndef or "
        "#endif");
  CHECK(refused("\n#define TWICE(x) (2 * (x))") ==
        "C text:2: has the macro 'TWICE' with arguments; a function");
  CHECK(refused("#ifndef A_H\nint a;") == "C text:2: ends within #ifdef or #ifndef; #endif");
  CHECK(refused("int a\nint b;") == "C text:2: has 'int' behind 'a'; ';' is expected there");
  CHECK(refused("Pair p;") == "C text:1: has 'Pair'; a type is expected there");
  CHECK(refused("int a = 017;") ==
        "C text:1: has '017' behind '='; a number such as 10, 0.5, 1e-9 or 0.5F is expected there");
  CHECK(refused("int f(int a) { return a | 1; }") ==
        "C text:1: has '|' behind 'a'; ';' is expected there");
  CHECK(refused("int f(int a) { return \"a\"; }") ==
        "C text:1: has '\"a\"' behind 'return'; an expression is expected there");
  CHECK(refused("double a[2 - 1];").find("a constant") != std::string::npos);
  CHECK(refused("int f(int a) { return a;") ==
        "C text:1: has its end behind ';'; an expression is expected there");
}
