#include "dashpot/damper/dependence.h"

#include <cmath>

#include "dashpot/base/units.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("parameters follow the current by their form") {
  const Dependence d{
      {Form::Constant, Form::Linear, Form::Quadratic, Form::Cubic, Form::Exponential},
      {{7}, {1, 2}, {1, 2, 3}, {1, 2, 3, 4}, {1, 9, 0.5}}};
  const double at_two[] = {7, 5, 17, 49, 9 - 8 * std::exp(-1.0)};
  for (std::size_t k = 0; k < 5; ++k) CHECK_CLOSE(d.at(k, 2), at_two[k], 1e-15, 0);
  CHECK(d.at(2, 0) == 1);
  CHECK(d.at(4, 0) == 1);
}

TEST_CASE("forms are named, and a wrong name is answered") {
  for (const Form form :
       {Form::Constant, Form::Linear, Form::Quadratic, Form::Cubic, Form::Exponential})
    CHECK(parse_form(name_of(form), "") == form);
  CHECK(message_of([] { parse_form("linar", "model.json, form"); }) ==
        "model.json, form: unknown form 'linar'; did you mean 'linear'? known: constant, linear, "
        "quadratic, "
        "cubic, exponential");
}

TEST_CASE("coefficients have names and units") {
  CHECK(coefficient_name("c0", Form::Constant, 0) == "c0");
  CHECK(coefficient_name("c0", Form::Linear, 1) == "c0_b");
  CHECK(coefficient_name("c0", Form::Quadratic, 2) == "c0_c");
  CHECK(coefficient_unit("N*s/m", Form::Linear, 0, DriveUnit::Ampere) == "N*s/m");
  CHECK(coefficient_unit("N*s/m", Form::Linear, 1, DriveUnit::Ampere) == "N*s/(m*A)");
  CHECK(coefficient_unit("N", Form::Quadratic, 2, DriveUnit::Volt) == "N/V^2");
  CHECK(coefficient_unit("1", Form::Linear, 1, DriveUnit::Ampere) == "1/A");
  CHECK(coefficient_unit("1/(m*s)", Form::Linear, 1, DriveUnit::Ampere) == "1/(m*s*A)");
  CHECK(coefficient_unit("N", Form::Exponential, 1, DriveUnit::Ampere) == "N");
  CHECK(coefficient_unit("N", Form::Exponential, 2, DriveUnit::Volt) == "1/V");
  for (const char* unit : {"N", "N/m", "1/m^2", "s/m", "1"})
    CHECK(parse_unit(coefficient_unit(unit, Form::Quadratic, 2, DriveUnit::Ampere)).has_value());
}
