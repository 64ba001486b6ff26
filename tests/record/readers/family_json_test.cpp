#include "dashpot/record/readers/family_json.h"

#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr const char* kFamilyFile = R"({"dampers": [
  {"name": "a", "piston_area": 5e-4, "gap_area": 1e-4, "gap": 0.001, "pole_length": 0.006, "viscosity": 0.1,
   "levels": [
     {"current": 0, "yield_stress": 200, "time": [0, 0.01, 0.02, 0.03], "displacement": [0, 0.001, 0.002, 0.001],
      "force": [1, 2, 3, -2]},
     {"current": 0.5, "yield_stress": 9000, "time": [0, 0.01, 0.02, 0.03],
      "displacement": [0, 0.001, 0.002, 0.001], "force": [5, 6, 7, -6]}]}]})";

std::string refused_family(const std::string& from, const std::string& to) {
  const TemporaryFolder folder;
  std::string text = kFamilyFile;
  text.replace(text.find(from), from.size(), to);
  const auto path = folder.write("family.json", text);
  return message_of([&] { load_dataset({path}); });
}

}  // namespace

TEST_CASE("a family in one JSON file with English keys: dampers, levels, conditions in SI") {
  const TemporaryFolder folder;
  const Dataset data = load_dataset({folder.write("family.json", kFamilyFile)});
  REQUIRE(data.records.size() == 2);
  CHECK(data.drive_unit == DriveUnit::Ampere);
  CHECK(data.records[1].drive_level == 0.5);
  CHECK(data.records[1].condition == "a");
  CHECK(data.records[1].channel("force").samples[2] == 7);
  const std::vector<std::pair<std::string, double>> wanted{
      {"yield_stress", 9000}, {"piston_area", 5e-4}, {"gap_area", 1e-4},
      {"gap", 1e-3},          {"pole_length", 6e-3}, {"viscosity", 0.1}};
  CHECK(data.records[1].conditions == wanted);
}

TEST_CASE("a family's JSON file that cannot be used is refused with its place") {
  CHECK(refused_family("\"gap\": 0.001", "\"gapp\": 0.001").find("did you mean 'gap'") !=
        std::string::npos);
  CHECK(refused_family("[5, 6, 7, -6]", "[5, 6, 7]").find("'force' has 3 values, 'time' has 4") !=
        std::string::npos);
  CHECK(refused_family("\"current\": 0.5,", "").find("current") != std::string::npos);
  CHECK(refused_family("\"gap\": 0.001", "\"gap\": \"wide\"").find("not a number") !=
        std::string::npos);
}

TEST_CASE("field levels of a family without currents are told, and not taken for one in silence") {
  const TemporaryFolder folder;
  const std::string level =
      R"({"time": [0, 0.04, 0.08], "displace": [0, 1, 2], "velocity": [1, 1, 1], "force": )";
  folder.write("dampers.json", R"({"a": [)" + level + "[1, 2, 3]}, " + level + "[4, 5, 6]}]}");
  folder.write("inp_dampers.json",
               R"({"a": {"Ty": [200, 9000], "viscocidad": 0.1, "Ap": 5e-4, "Ag": 1e-4, "h": 0.001,
                         "L": 0.006}})");
  const Dataset data = load_dataset({(folder.path() / "dampers.json").string()});
  CHECK(data.drive_unit == DriveUnit::None);
  CHECK_MESSAGE(
      contains(data.notes.front(), "recorded at 2 fields, its yield stress is 200 ... 9000 Pa"),
      data.notes.front());
}
