#include "dashpot/export/c/c_text.h"

#include "support.h"

using namespace dashpot;

TEST_CASE(
    "C text in single precision: types, functions, numbers; not comments, names or whole numbers") {
  const auto single = [](const char* code) { return in_precision(code, CPrecision::Single); };
  CHECK(single("double x = 2 * exp(0.5) + 1e-7; /* double 0.5 */") ==
        "float x = 2 * expf(0.5F) + 1e-7F; /* double 0.5 */");
  CHECK(single("my_exp(a1, x[10], 3.)") == "my_exp(a1, x[10], 3.F)");
  CHECK(single("1e-200") == "1.17549435e-38F");  // the smallest normal float
  CHECK(single("fabs(step) <= 1e-9 * y") == "fabsf(step) <= 1e-5F * y");  // 1e-9 is never met
  CHECK(in_precision("exp(0.5)", CPrecision::Double) == "exp(0.5)");
  CHECK(message_of([&] { single("1e39"); }) ==
        "single precision: cannot hold 1e39; export in double precision");
}

TEST_CASE("C text: numbers, prefixes and texts") {
  CHECK(c_number(5) == "5.0");
  CHECK(c_number(-2.5e-9) == "-2.5e-09");
  CHECK(pascal_case("bouc_wen") == "BoucWen");
  CHECK(with_prefix("damper_step(&my_damper_x, DAMPER_H) /* damper_model */", "front") ==
        "front_step(&my_damper_x, FRONT_H) /* front_model */");
  const std::string code = with_texts("#include \"held.h\"\nint x;\n#include \"held.h\"\n");
  CHECK(code.find("double held(") != std::string::npos);
  CHECK(code.find("double held(") == code.rfind("double held("));
  CHECK(
      with_texts("#include \"straight_current.h\"\n")
          .starts_with(
              "/* From a demand to a current without a model of the damper. */\n\n/* Damping in a "
              "straight line"));
  CHECK(message_of([] { with_texts("#include \"none.h\"\n"); }) ==
        "none.h: is no C text of Dashpot");
}
