#include "dashpot/record/statement_text.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "dashpot/base/file.h"
#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// Rows of a viscous damper in the units of a workshop, with or without a line of names; `force` is
/// the sign of its column.
std::string workshop_rows(const std::string& names, double force) {
  std::string rows = names;
  for (int k = 0; k < 400; ++k) {
    const double angle = 2 * std::numbers::pi * 0.005 * k;
    rows += std::to_string(0.005 * k) + "," + std::to_string(0.5 * std::sin(angle)) + "," +
            std::to_string(force * 90 * std::cos(angle)) + "\n";
  }
  return rows;
}

void check_same(const Dataset& a, const Dataset& b) {
  REQUIRE(a.records.size() == b.records.size());
  CHECK(a.drive_unit == b.drive_unit);
  for (std::size_t r = 0; r < a.records.size(); ++r) {
    const Record &one = a.records[r], &other = b.records[r];
    CAPTURE(one.name);
    CHECK(one.name == other.name);
    CHECK(one.condition == other.condition);
    CHECK(one.drive_level == other.drive_level);
    CHECK(one.conditions == other.conditions);
    REQUIRE(one.size() == other.size());
    for (const Channel& channel : one.channels) {
      CAPTURE(channel.name);
      const Channel* same = other.find(channel.name);
      REQUIRE(same);
      for (std::size_t k = 0; k < one.size(); ++k)
        CHECK_CLOSE(channel.samples[k], same->samples[k], 1e-12, 1e-15);
    }
  }
}

/// Reads a folder, and once more by the statement of what was understood.
void check_round_trip(const fs::path& data) {
  const Dataset understood = load_dataset({data});
  const TemporaryFolder folder;
  const fs::path statement =
      folder.write("stated.yaml", statement_text(understood, data, folder.path()));
  CAPTURE(dashpot::read_file(statement));
  check_same(understood, load_dataset({statement}));
}

}  // namespace

TEST_CASE("what was understood, written down, reads the same: units, signs, levels from names") {
  const TemporaryFolder folder;
  const std::string names = "Time [s],Pos [in],Load (lbs)\n";
  folder.write("data/run_0,5A.csv", workshop_rows(names, -1));
  folder.write("data/run_1A.csv", workshop_rows(names, -1));
  folder.write("data/other [2]_1A.csv", workshop_rows(names, 1));
  check_round_trip(folder.path() / "data");

  const Dataset dataset = load_dataset({folder.path() / "data"});
  const std::string text = statement_text(dataset, folder.path() / "data", folder.path());
  CHECK(contains(text, "\"displacement\": {column: \"Pos [in]\", unit: \"in\"}"));
  CHECK(contains(text, "sign: -1"));
  CHECK(contains(text, "level: 0.5"));
}

TEST_CASE("a level that is corrected leaves the frequency in the record's name alone") {
  const TemporaryFolder folder;
  folder.write("data/recordings/10 mm 2 Hz 2A.csv",
               workshop_rows("Time [s],Pos [mm],Load [N]\n", 1));
  const fs::path data = folder.path() / "data";
  std::string text = statement_text(load_dataset({data}), data, folder.path());
  const std::size_t at = text.find("level: 2");
  REQUIRE(at != std::string::npos);
  const Dataset corrected =
      load_dataset({folder.write("stated.yaml", text.replace(at, 8, "level: 0.5"))});
  REQUIRE(corrected.records.size() == 1);
  CHECK(corrected.records[0].drive_level == 0.5);
  CHECK(corrected.records[0].name == "recordings/10 mm 2 Hz 2A");
}

TEST_CASE("files with several tests and gaps are stated with all their levels") {
  const TemporaryFolder folder;
  std::string rows = workshop_rows("t [s],x [mm],F [N]\n", 1);
  for (int k = 0; k < 400; ++k)
    rows += std::to_string(100 + 0.005 * k) + "," + std::to_string(0.5 * std::sin(0.03 * k)) + "," +
            std::to_string(90 * std::cos(0.03 * k)) + "\n";
  folder.write("data/run_2A.csv", rows);
  check_round_trip(folder.path() / "data");
}

TEST_CASE("the measured sets, read by what was understood of them, are the same" *
          doctest::test_suite("long")) {
  for (const char* set : {"utfpr", "utfsm"}) {
    const fs::path data = shared_data(set);
    if (data.empty()) return;
    CAPTURE(set);
    LoadOptions plain;
    plain.recognise = false;
    const Dataset understood = load_dataset({data}, plain);
    const TemporaryFolder folder;
    check_same(understood, load_dataset({folder.write(
                               "stated.yaml", statement_text(understood, data, folder.path()))}));
  }
}
