#include "dashpot/export/c/c_text.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("C text: numbers, names and texts") {
  CHECK(c_number(5) == "5.0");
  CHECK(c_number(-2.5e-9) == "-2.5e-09");
  CHECK(pascal_case("bouc_wen") == "BoucWen");
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
