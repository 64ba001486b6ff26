#include "dashpot/damper/dependence.h"

#include "dashpot/base/units.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("parameters follow the current by their form") {
  const Dependence d{{Form::Constant, Form::Linear, Form::Quadratic}, {{7}, {1, 2}, {1, 2, 3}}};
  double p[3];
  d.evaluate(2, p);
  CHECK(p[0] == 7);
  CHECK(p[1] == 5);
  CHECK(p[2] == 17);
  d.evaluate(0, p);
  CHECK(p[2] == 1);
}

TEST_CASE("forms are named, and a wrong name is answered") {
  for (const Form form : {Form::Constant, Form::Linear, Form::Quadratic})
    CHECK(parse_form(name_of(form), "") == form);
  CHECK(message_of([] { parse_form("linar", "model.json, form"); }) ==
        "model.json, form: unknown form 'linar'; did you mean 'linear'? known: constant, linear, quadratic");
}

TEST_CASE("coefficients have names and units") {
  CHECK(coefficient_name("c0", Form::Constant, 0) == "c0");
  CHECK(coefficient_name("c0", Form::Linear, 1) == "c0_b");
  CHECK(coefficient_name("c0", Form::Quadratic, 2) == "c0_c");
  CHECK(coefficient_unit("N*s/m", 0, "A") == "N*s/m");
  CHECK(coefficient_unit("N*s/m", 1, "A") == "N*s/(m*A)");
  CHECK(coefficient_unit("N", 2, "V") == "N/V^2");
  CHECK(coefficient_unit("1", 1, "A") == "1/A");
  CHECK(coefficient_unit("1/(m*s)", 1, "A") == "1/(m*s*A)");
  for (const char* unit : {"N", "N/m", "1/m^2", "s/m", "1"})
    CHECK(parse_unit(coefficient_unit(unit, 2, "A")).has_value());
}
