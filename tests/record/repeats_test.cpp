#include "dashpot/record/repeats.h"

#include <cmath>
#include <numbers>

#include "support.h"

using namespace dashpot;

namespace {

/// A sine of so many mm at 2 Hz and 1 A against a damper of that many N.
Record run(const std::string& name, double millimetres, double newtons) {
  Record record;
  record.name = name;
  record.drive_level = 1;
  Channel x{"displacement", "m"}, v{"velocity", "m/s"}, f{"force", "N"};
  for (int k = 0; k < 500; ++k) {
    const double angle = 4 * std::numbers::pi * 0.002 * k;
    record.time.push_back(0.002 * k);
    x.samples.push_back(1e-3 * millimetres * std::sin(angle));
    v.samples.push_back(4e-3 * std::numbers::pi * millimetres * std::cos(angle));
    f.samples.push_back(-70 + newtons * std::tanh(5 * std::cos(angle)));
  }
  record.channels = {x, v, f};
  return record;
}

}  // namespace

TEST_CASE("a copy of a record is told, also where its name says another drive") {
  std::vector<Record> records{run("first", 10, 900), run("second", 10, 901), run("copy", 10, 900)};
  records.back().drive_level = 2;
  const std::vector<Suspect> found = doubts_about_repeats(records);
  REQUIRE(found.size() == 1);
  CHECK(found.front().record == "copy");
  CHECK(contains(found.front().why, "its force is that of first in every sample"));
}

TEST_CASE("of repetitions the one whose force is another damper's is told") {
  const std::vector<Record> three{run("first", 10, 900), run("other", 10.1, 1440),
                                  run("last", 10, 870)};
  const std::vector<Suspect> found = doubts_about_repeats(three);
  REQUIRE(found.size() == 1);
  CHECK(found.front().record == "other");
  CHECK(found.front().why.starts_with("its force has 1.6 times the size of that of first"));

  // Of two nobody knows which it is: the later one is named, beside the other.
  const std::vector<Suspect> of_two = doubts_about_repeats(std::span(three).first(2));
  REQUIRE(of_two.size() == 1);
  CHECK(of_two.front().record == "other");
}

TEST_CASE("repetitions differ by warmth, and other motions, drives and conditions are none") {
  std::vector<Record> records{run("cold", 10, 900), run("warm", 10, 750), run("farther", 20, 2000),
                              run("driven", 10, 1800), run("unlike", 10, 1801)};
  records[3].drive_level = 2;
  records[4].conditions = {{"gap", 1e-3}};
  CHECK(doubts_about_repeats(records).empty());
}
