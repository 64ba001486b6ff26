#include "dashpot/base/text.h"

#include <array>
#include <cmath>

#include "dashpot/base/find_row.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("a number is the whole text or nothing") {
  CHECK(*parse_number(" 1.5e-3 ") == 1.5e-3);
  CHECK(*parse_number("+2") == 2);
  CHECK(*parse_number("-0,25", ',') == -0.25);
  for (const char* bad : {"", " ", "1.5x", "1,5", "++1", "abc", "1 2", "0x10"})
    CHECK_MESSAGE(!parse_number(bad), bad);
  CHECK_MESSAGE(!parse_number("1.234,5", ','),
                "a point is no digit where the comma is the decimal sign");
  CHECK(std::isnan(*parse_number("nan")));
}

TEST_CASE("exact text reads back as the same double") {
  for (const double x : {0.1, 1.0 / 3, 6.02214076e23, -5e-324, 1e300})
    CHECK(*parse_number(format_exact(x)) == x);
  CHECK(format_number(0.0045123) == "0.004512");
  CHECK(format_number(3.63e6, 3) == "3.63e+06");
  CHECK(format_number(-0.0) == "0");
}

TEST_CASE("plain text has no exponent up to a million") {
  CHECK(format_plain(20000) == "20000");
  CHECK(format_plain(123456.7) == "123457");
  CHECK(format_plain(-1234.5678, 3) == "-1235");
  CHECK(format_plain(999999.9) == "1000000");
  CHECK(format_plain(1e6) == "1e+06");
  CHECK(format_plain(999.6, 3) == "1000");
  CHECK(format_plain(0.0045123) == "0.004512");
}

TEST_CASE("split keeps empty parts and join undoes it") {
  CHECK(split("a,,b,", ',') == std::vector<std::string>{"a", "", "b", ""});
  CHECK(join(split("a,,b,", ','), ",") == "a,,b,");
}

TEST_CASE("one is counted in the singular") {
  CHECK(counted(0, "record") == "0 records");
  CHECK(counted(1, "whole cycle") == "1 whole cycle");
  CHECK(counted(2, "record") == "2 records");
}

TEST_CASE("a mistyped word finds its neighbour") {
  const std::vector<std::string> known = {"bingham", "modified_bouc_wen", "tanh_kwok"};
  CHECK(closest("bingam", known) == "bingham");
  CHECK(closest("modified", known) == "modified_bouc_wen");
  CHECK(!closest("polynomial", known));
  CHECK(suggest("Bingham", {}).find("DASHPOT_DATA") != std::string::npos);
  CHECK(suggest("Bingham", known) ==
        "did you mean 'bingham'? known: bingham, modified_bouc_wen, tanh_kwok");
}

TEST_CASE("a row of a table is found by its name, or named in the error") {
  struct Row {
    std::string_view name;
    int value;
  };
  static constexpr std::array kRows{Row{"alpha", 1}, Row{"beta", 2}};
  static constexpr std::array kPointers{&kRows[0], &kRows[1]};
  CHECK(&find_row(kRows, "beta", "letter", "--letter") == &kRows[1]);
  CHECK(&find_row(kPointers, "alpha", "letter", "--letter") == &kRows[0]);
  CHECK(message_of([] { find_row(kRows, "betta", "letter", "--letter"); }) ==
        "--letter: unknown letter 'betta'; did you mean 'beta'? known: alpha, beta");
}
