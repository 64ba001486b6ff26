#include "dashpot/base/units.h"

#include <numbers>

#include "support.h"

using namespace dashpot;

static void check_factor(const char* text, double factor, Dimension dimension) {
  CAPTURE(text);
  const auto unit = parse_unit(text);
  REQUIRE(unit);
  CHECK_CLOSE(unit->factor, factor, 1e-15, 0);
  CHECK(unit->dimension == dimension);
}

TEST_CASE("units of data sheets of fluids") {
  CHECK_CLOSE(require_unit("cP", "").factor, 1e-3, 1e-15, 0);
  CHECK(require_unit("cP", "").dimension == require_unit("Pa*s", "").dimension);
  CHECK_CLOSE(require_unit("kOe", "").factor, 79577.4715, 1e-4, 0);
  CHECK(require_unit("Oe", "").dimension == require_unit("kA/m", "").dimension);
}

TEST_CASE("units in all their spellings") {
  check_factor("mm", 1e-3, {0, 1});
  check_factor("cm/s", 1e-2, {0, 1, -1});
  check_factor("N*s/cm", 100, {1, 0, -1});
  check_factor("N s/m", 1, {1, 0, -1});
  check_factor("N.s/m", 1, {1, 0, -1});
  check_factor("N*s/(m*A)", 1, {1, 0, -1, -1});
  check_factor("kN", 1e3, {1, 1, -2});
  check_factor("Newtons", 1, {1, 1, -2});
  check_factor("m/s²", 1, {0, 1, -2});
  check_factor("m/s2", 1, {0, 1, -2});
  check_factor("mm.s-1", 1e-3, {0, 1, -1});
  check_factor("mm s-1", 1e-3, {0, 1, -1});
  check_factor("m\u00b7s\u22121", 1, {0, 1, -1});
  check_factor("m s\u207b\u00b2", 1, {0, 1, -2});
  check_factor("mm per s", 1e-3, {0, 1, -1});
  check_factor("Amps", 1, {0, 0, 0, 1});
  check_factor("milliamps", 1e-3, {0, 0, 0, 1});
  check_factor("Inches", 0.0254, {0, 1});
  check_factor("mA", 1e-3, {0, 0, 0, 1});
  check_factor("in", 0.0254, {0, 1});
  check_factor("min", 60, {0, 0, 1});
  check_factor("g0", 9.80665, {0, 1, -2});
  check_factor("%", 0.01, {});
  // The trap of the published Bouc-Wen sets: 363 cm^-2 is 3.63e6 m^-2, not 3.63e-2.
  check_factor("cm^-2", 1e4, {0, -2});
  check_factor("1/cm^2", 1e4, {0, -2});
}

TEST_CASE("degrees Celsius have an offset and no powers") {
  CHECK_CLOSE(parse_unit("degC")->offset, 273.15, 0, 1e-12);
  CHECK_CLOSE(parse_unit("°C")->offset, 273.15, 0, 1e-12);
  CHECK(!parse_unit("degC^2"));
  CHECK(!parse_unit("m/degC"));
}

TEST_CASE("what is no unit is refused") {
  for (const char* bad :
       {"", "furlong", "m/", "/s", "m//s", "m^x", "m^99", "N*", "(m", "mmm", "mms-1", "T-1"})
    CHECK_MESSAGE(!parse_unit(bad), bad);
  CHECK(message_of([] {
          require_unit("furlong", "run.csv, column x");
        }).find("run.csv, column x: unknown unit 'furlong'") == 0);
  CHECK(message_of([] { parse_quantity("5:1", "Hz", "--frequencies"); }) ==
        "--frequencies: '5:1' has an unknown unit ':1'; a number in Hz, or one with its unit");
  CHECK(message_of([] { parse_quantity("one", "1", "share"); }) ==
        "share: 'one' is not a number; write it as 0.25");
}

TEST_CASE("a frequency counts turns, an angle over time 2 pi of them, a rate neither") {
  CHECK_CLOSE(parse_quantity("2rad/s", "Hz", "x"), 1 / std::numbers::pi, 1e-15, 0);
  CHECK_CLOSE(parse_quantity("720 deg/s", "Hz", "x"), 2, 1e-15, 0);
  CHECK_CLOSE(parse_quantity("720°/s", "Hz", "x"), 2, 1e-15, 0);
  CHECK(parse_quantity("2 1/s", "Hz", "x") == 2);
  CHECK(parse_quantity("3kHz", "Hz", "x") == 3000);
  CHECK(parse_quantity("314 rad/s", "1/s", "x") == 314);
  CHECK(message_of([] { parse_quantity("50Hz", "1/s", "--damper, lag_rate"); }) ==
        "--damper, lag_rate: 'Hz' is not a unit of a rate; it is counted in 1/s; that of a lag is "
        "2 pi times its corner frequency in Hz");
}
