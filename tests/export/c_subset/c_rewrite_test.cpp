#include "dashpot/export/c_subset/c_rewrite.h"

#include "dashpot/export/c/c_text.h"
#include "support.h"

using namespace dashpot;

namespace {

std::string single(std::string_view code) { return in_precision(code, CPrecision::Single); }

}  // namespace

TEST_CASE(
    "C text in single precision: types, functions, numbers; not comments, names or whole numbers") {
  CHECK(single("double x = 2 * exp(0.5) + 1e-7; /* double 0.5 */") ==
        "float x = 2 * expf(0.5F) + 1e-7F; /* double 0.5 */");
  CHECK(single("my_exp(a1, x[10], 3.)") == "my_exp(a1, x[10], 3.F)");
  CHECK(single("printf(\"double 0.5 %g\\n\", (double)x)") ==
        "printf(\"double 0.5 %g\\n\", (float)x)");
  CHECK(single("1e-200") == "1.17549435e-38F");  // the smallest normal float
  CHECK(single("fabs(step) <= 1e-9 * y") == "fabsf(step) <= 1e-9F * y");
  CHECK(in_precision("exp(0.5)", CPrecision::Double) == "exp(0.5)");
  CHECK(message_of([] { single("1e39"); }) ==
        "single precision: cannot hold 1e39; export in double precision");
}

TEST_CASE("C text in single precision: its own tanh, within 4e-7 and never beyond 1") {
  CHECK(single("f(tanh(x), atanh(y))") == "f(tanh_single(x), atanhf(y))");
  const std::string code = single("#include <math.h>\n\ndouble f(double x) { return tanh(x); }\n");
  const TemporaryFolder folder;
  folder.write("f.c", code);
  folder.write("main.c", R"(#include <math.h>
#include <stdio.h>
float f(float x);
int main(void) {
  double worst = 0, most = 0;
  unsigned k;
  for (k = 0; k < 2000000; ++k) {
    const float x = (k < 1000000) ? 1e-5F * (float)k : powf(10.0F, 1e-5F * (float)k - 30.0F);
    const double t = (double)f(x), error = fabs(t - tanh((double)x)) / fmin(1.0, (double)x);
    worst = (x > 0.0F && error > worst) ? error : worst;
    most = fmax(most, fabs(t));
    if (f(-x) != -f(x)) return 3;
  }
  if (!isnan(f(nanf("")))) return 4;
  printf("%g\n", worst);
  return (worst < 4e-7 && most == 1.0) ? 0 : 1;
}
)");
  const ProgramResult result = run_program("cd '" + folder.path().string() +
                                           "' && cc -std=c99 -O2 f.c main.c -lm -o f && ./f");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}

TEST_CASE("C text in single precision: marked numbers are exchanged") {
  CHECK(single("const double tolerance = 1e-9; /* single precision: 1e-5 */") ==
        "const float tolerance = 1e-5F; /* double precision: 1e-9 */");
  CHECK(single("#define NARROW 1e-12 /* single precision: 2e-7 */\n") ==
        "#define NARROW 2e-7F /* double precision: 1e-12 */\n");
  CHECK(message_of([] { single("int a;\nbreak; /* single precision: 1e-5 */"); }) ==
        "C text:2: has a mark behind no number; const double name = 1e-9; /* single precision: "
        "1e-5 */");
  CHECK(message_of([] { single("a = 1e-9; /* single precision: low */"); }) ==
        "C text:1: marks no number for single precision but 'low'; const double name = 1e-9; /* "
        "single precision: 1e-5 */");

  // Each text's marks, and those of the texts that exporters make, can be followed.
  for (const auto& [name, text] : c_texts()) {
    CAPTURE(name);
    CHECK(single(text).find("single precision:") == std::string::npos);
  }
}

TEST_CASE("C text under another prefix: names in code and comments, not in strings") {
  CHECK(with_prefix("damper_step(&my_damper_x, DAMPER_H) /* damper_model */", "front") ==
        "front_step(&my_damper_x, FRONT_H) /* front_model */");
  CHECK(with_prefix("#include \"damper.h\"\n#ifndef DAMPER_H\ndamper(\"damper_x\")", "front") ==
        "#include \"damper.h\"\n#ifndef FRONT_H\ndamper(\"damper_x\")");
  CHECK(message_of([] { require_free_names("bank", "static int bank_advance(int x);"); }) ==
        "name: 'bank' begins names that the code has inside; say 'bank_damper'");
  require_free_names("bank", "static int bank_advanced, my_bank_advance; /* bank_advance */");
}
