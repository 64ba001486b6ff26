#include "dashpot/base/print_units.h"

#include "dashpot/error.h"
#include "support.h"

using dashpot::PrintUnits;

TEST_CASE("what is composed of force and length follows the units that people ask for") {
  struct Case {
    std::string units, si_unit, name;
    double factor;
  };
  const double pound = 4.4482216152605, inch = 0.0254;
  for (const Case& c : {Case{"lbf,in/s", "N", "lbf", 1 / pound},
                        {"lbf,in/s", "m", "in", 1 / inch},
                        {"lbf,in/s", "m/s", "in/s", 1 / inch},
                        {"lbf,in/s", "N/m", "lbf/in", inch / pound},
                        {"lbf,in/s", "N*s/m", "lbf s/in", inch / pound},
                        {"lbf,in/s", "J", "lbf in", 1 / (pound * inch)},
                        {"lbf,in/s", "m/s^2", "in/s^2", 1 / inch},
                        {"kN, m/s", "N", "kN", 1e-3},
                        {"kN, m/s", "J", "kJ", 1e-3},
                        {"kN, m/s", "N*s/m", "kNs/m", 1e-3},
                        {"N,mm/s", "N/m", "N/mm", 1e-3},
                        {"N,mm/s", "J", "J", 1},
                        {"daN,cm/s", "J", "daN m", 0.1},
                        {"lbf,in/s", "A", "A", 1},
                        {"lbf,in/s", "s", "s", 1}}) {
    CAPTURE(c.units + " " + c.si_unit);
    const dashpot::PrintUnit unit = PrintUnits::parse(c.units, "--units").of(c.si_unit);
    CHECK(unit.name == c.name);
    CHECK(unit.factor == doctest::Approx(c.factor).epsilon(1e-14));
  }

  // People see mm unless they ask for more; programs see SI.
  CHECK(PrintUnits().of("m/s").name == "mm/s");
  CHECK(PrintUnits().of("m/s").factor == 1000);
  CHECK(PrintUnits::si().of("m/s").factor == 1);
}

TEST_CASE("units that are none are refused with what would be right") {
  for (const std::string text :
       {"", "N", "mm/s,N", "N,mm", "kg,mm/s", "N,A/s", "N,mm/s,s", "x,y/s"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(PrintUnits::parse(text, "--units"), dashpot::Error);
  }
}
