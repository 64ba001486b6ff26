#include "dashpot/record/conditions.h"

#include <cmath>
#include <numbers>

#include "support.h"

using namespace dashpot;

TEST_CASE("a level in a name whose digits no number holds is in doubt") {
  const std::string many(330, '3'), zeros(400, '0');
  const auto doubt_of = [](const std::string& name) {
    const NameParts parts = split_name(name);
    REQUIRE(parts.level.has_value());
    return parts.level->doubt;
  };
  CHECK(doubt_of("run_" + many + ",5A").find("is no number of A") != std::string::npos);

  // A fraction of so many zeros is none either: as good as 0.
  CHECK(doubt_of("run_" + zeros + "5A").find("may be 5 A or 0 A") != std::string::npos);
  CHECK(doubt_of("run_0_" + zeros + "5mA").find("or 5 mA") != std::string::npos);
  CHECK(doubt_of("run_0,5A").empty());
}

TEST_CASE("a symbol and a number without a unit may be a level, and a counter is none") {
  for (const auto& [name, word] : {std::pair{"run_I=0.5_f=1Hz", "I=0.5"},
                                   {"I0.5", "I0.5"},
                                   {"20mm_I_1.5", "I_1.5"},
                                   {"test I=0,5", "I=0,5"},
                                   {"U=12", "U=12"},
                                   {"current0", "current0"},
                                   {"run_I3", ""},
                                   {"V2_final", ""},
                                   {"I=0.5A", ""},
                                   {"MIX0.5", ""},
                                   {"I=", ""}}) {
    CAPTURE(std::string(name));
    CHECK(level_without_unit(name) == word);
    // With its unit it is one.
    if (!std::string(word).empty()) CHECK(split_name(std::string(word) + "A").level.has_value());
  }
}

namespace {

/// A sine of 4 Hz.
Record moved(double amplitude, double level) {
  Record record;
  Channel x{.name = "displacement", .unit = "m", .origin = "column x"};
  for (int k = 0; k < 500; ++k) {
    record.time.push_back(0.002 * k);
    x.samples.push_back(amplitude * std::sin(8 * std::numbers::pi * record.time.back()));
  }
  record.channels = {std::move(x)};
  record.drive_level = level;
  return record;
}

using Names = std::vector<std::string>;

Names conditions(std::vector<Record> records, const Names& names) {
  infer_conditions(records, names);
  Names found;
  for (const Record& record : records) found.push_back(record.condition);
  return found;
}

}  // namespace

TEST_CASE("letters within a word state no motion") {
  for (const char* name : {"hammer_3", "comma", "summer 2026"})
    CHECK(conditions({moved(0.004, 0)}, {name}) == Names{"4 mm 4 Hz"});
  CHECK(conditions({moved(0.004, 0)}, {"sine 4_mm"}) == Names{"sine 4_mm"});
}

TEST_CASE("a bare number in a name that is the drive level is no part of the motion") {
  // At the end and within.
  CHECK(conditions({moved(0.004, 0), moved(0.004, 0.5), moved(0.008, 0), moved(0.008, 0.5)},
                   {"test_4mm_4Hz_0", "test_4mm_4Hz_0.5", "0-8mm-4Hz", "0.5-8mm-4Hz"}) ==
        Names{"test_4mm_4Hz", "test_4mm_4Hz", "8mm-4Hz", "8mm-4Hz"});

  // A number that tells motions apart, and a single record, keep it.
  const Names apart{"sine_4_4Hz", "sine_8_4Hz"};
  CHECK(conditions({moved(0.004, 4), moved(0.008, 8)}, apart) == apart);
  CHECK(conditions({moved(0.004, 0.5)}, {"test_4mm_0.5"}) == Names{"test_4mm_0.5"});
}

TEST_CASE("what counts records that move alike is no part of the motion") {
  const std::vector<Record> alike{moved(0.005, 0), moved(0.005, 1), moved(0.00505, 2)};
  CHECK(conditions(alike, {"Test_07_sine_5mm_4Hz", "Test_08_sine_5mm_4Hz",
                           "Test_12_sine_5mm_4Hz"}) == Names(3, "Test_sine_5mm_4Hz"));
  CHECK(conditions(alike, {"sine_5mm_4Hz", "sine_5mm_4Hz_rep2", "sine_5mm_4Hz-Wdh3"}) ==
        Names(3, "sine_5mm_4Hz"));

  // A number that tells motions apart stays, and names that say something else do.
  CHECK(conditions({moved(0.005, 0), moved(0.005, 1), moved(0.01, 0)},
                   {"1_sine_5_4Hz", "2_sine_5_4Hz", "3_sine_10_4Hz"}) ==
        Names{"1_sine_5_4Hz", "1_sine_5_4Hz", "3_sine_10_4Hz"});
  const Names spaced{"3 mm 4 Hz", "5 mm 4 Hz 1", "5 mm 4 Hz 2"};
  CHECK(conditions(alike, spaced) == Names{"3 mm 4 Hz", "5 mm 4 Hz", "5 mm 4 Hz"});
  const Names warm{"sine_5mm_4Hz_20degC", "sine_5mm_4Hz_60degC", "saw_5mm_4Hz_20degC"};
  CHECK(conditions(alike, warm) == warm);
  CHECK(conditions({moved(0.005, 0)}, {"07_sine_5mm_4Hz"}) == Names{"07_sine_5mm_4Hz"});
}
