#include "dashpot/damper/force_band.h"

#include "support.h"

using namespace dashpot;

namespace {

ForceBand example() {
  return {.level = 0.9,
          .records = 7,
          .speeds = {0.1},
          .drives = {0, 2},
          .half_width = {10, 30, 20, 40}};
}

}  // namespace

TEST_CASE("a force band steps in speed and is linear in the drive, constant beyond its knots") {
  const ForceBand band = example();
  CHECK(band.half_width_at({0, 0.05, 0}) == 10);
  CHECK(band.half_width_at({0, -0.05, 1}) == 20);
  CHECK(band.half_width_at({0, 0.1, 1}) == 30);
  CHECK(band.half_width_at({0, -9, 5}) == 40);
  CHECK(band.half_width_at({0, 0, -3}) == 10);
  CHECK(band.scaled(3).half_width_at({0, 0, 0}) == 30);
}

TEST_CASE("the spread of an ensemble's members adds in quadrature, with the band's factor") {
  ForceBand band = example();
  band.spread = 2;
  CHECK(band.half_width_at({0, 0.1, 0}) == 20);
  CHECK_CLOSE(band.half_width_at({0, 0.1, 0}, 7.5), 25, 1e-15, 0);  // 15, 20, 25
  CHECK_CLOSE(band.scaled(3).half_width_at({0, 0.1, 0}, 7.5), 75, 1e-15, 0);
  const std::string text = format_json(to_json(band), false);
  CHECK(read_force_band(parse_json(text, "m.json")).spread == 2);
  std::string broken = text;
  broken.replace(broken.find("\"spread\":2"), 10, "\"spread\":0");
  CHECK(message_of([&] { read_force_band(parse_json(broken, "m.json")); }).find("leave it out") !=
        std::string::npos);
}

TEST_CASE("a force band in JSON: there and back, and what is refused") {
  const std::string text = format_json(to_json(example()));
  const ForceBand band = read_force_band(parse_json(text, "m.json"));
  CHECK(format_json(to_json(band)) == text);
  CHECK(band.records == 7);
  const auto refused = [](const std::string& widths, const std::string& drives) {
    return message_of([&] {
      read_force_band(parse_json(
          "{\"version\": 1, \"level\": 0.9, \"records\": 7, \"speeds\": [], \"drives\": " + drives +
              ", \"half_width_N\": " + widths + "}",
          "m.json"));
    });
  };
  CHECK(refused("[1, 2]", "[0, 1]").empty());
  CHECK(refused("[1]", "[0, 1]").find("one width per band") != std::string::npos);
  CHECK(refused("[1, 0]", "[0, 1]").find("not positive") != std::string::npos);
  CHECK(refused("[1, 2]", "[1, 1]").find("not in order") != std::string::npos);
  std::string many = text;
  many.replace(many.find("\"records\": 7"), 12, "\"records\": 1e300");  // no count holds it
  CHECK(message_of([&] {
          read_force_band(parse_json(many, "m.json"));
        }).find("records is 1e+300") != std::string::npos);
}
