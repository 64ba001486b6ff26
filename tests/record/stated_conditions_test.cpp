#include <algorithm>
#include <cmath>

#include "dashpot/dataset.h"
#include "dashpot/physics/damper_physics.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr const char* kRun =
    "t_s,x_mm,F_N\n0,0,1\n0.01,1,2\n0.02,2,3\n0.03,1,-1\n0.04,0,-2\n0.05,-1,-1\n";

double condition(const Record& record, std::string_view name) {
  for (const auto& [key, value] : record.conditions)
    if (key == name) return value;
  return -1;
}

std::string refused(const TemporaryFolder& folder) {
  return message_of([&] { load_dataset({folder.path()}); });
}

/// Two runs at two currents, and what is stated about them.
void write_campaign(const TemporaryFolder& folder, const std::string& manifest,
                    const std::string& statement = {}) {
  folder.write("a_0A.csv", kRun);
  folder.write("b_1A.csv", kRun);
  folder.write("small.yaml", "name: small\nfluid: 132DG\ngap: 0.8 mm\n");
  folder.write("wide.yaml", "name: wide\nfluid: 132DG\ngap: 1.2 mm\npole_length: 25 mm\n");
  if (!manifest.empty()) folder.write("manifest.csv", manifest);
  if (!statement.empty()) folder.write("dataset.yaml", statement);
}

}  // namespace

TEST_CASE("drawings in a manifest give geometry, fluid, and the yield stress at each current") {
  const TemporaryFolder folder;
  write_campaign(folder, "file,damper\na_0A.csv,small.yaml\nb_1A.csv,wide.yaml\n");
  const Dataset data = load_dataset({folder.path()});
  REQUIRE(data.records.size() == 2);
  const Record& wide = *std::ranges::find(data.records, "b_1A", &Record::name);
  const DamperDescription drawn = load_description(folder.path() / "wide.yaml");
  const DamperPhysics physics = evaluate_physics(drawn, {.current = 1});
  CHECK(condition(wide, "gap") == 1.2e-3);
  CHECK(condition(wide, "pole_length") == 25e-3);
  CHECK(condition(wide, "piston_area") == physics.piston_area);
  CHECK(condition(wide, "viscosity") == physics.viscosity);
  CHECK(condition(wide, "yield_stress") == physics.yield_stress);
  const Record& small = *std::ranges::find(data.records, "a_0A", &Record::name);
  CHECK(condition(small, "yield_stress") == 0);
  CHECK(condition(small, "gap") == 0.8e-3);
}

TEST_CASE("a dataset file names the drawing, by pattern or by a column, and goes before it") {
  const TemporaryFolder folder;
  write_campaign(folder, "",
                 "files:\n  - {match: 'a*', damper: small.yaml, conditions: {gap: 0.9 mm}}\n"
                 "  - {match: 'b*', damper: passenger_car}\n");
  const Dataset data = load_dataset({folder.path()});
  CHECK_CLOSE(condition(data.records[0], "gap"), 0.9e-3, 1e-12, 0);
  CHECK(condition(data.records[1], "pole_length") == 24e-3);

  write_campaign(folder, "file,drawn\na_0A.csv,small.yaml\nb_1A.csv,wide.yaml\n",
                 "files: [{match: '*.csv', damper: {manifest: drawn}}]\n");
  CHECK(condition(load_dataset({folder.path()}).records[1], "gap") == 1.2e-3);
}

TEST_CASE("columns of a manifest are conditions, by their names with a unit or as stated") {
  const TemporaryFolder folder;
  write_campaign(folder,
                 "file,gap [mm],pole_length_mm,viscosity,room\na_0A.csv,1.1,20,0.1,25\n"
                 "b_1A.csv,1.3,20,0.2,26\n");
  Dataset data = load_dataset({folder.path()});
  CHECK_CLOSE(condition(data.records[0], "gap"), 1.1e-3, 1e-12, 0);
  CHECK_CLOSE(condition(data.records[1], "pole_length"), 20e-3, 1e-12, 0);
  CHECK(condition(data.records[0], "viscosity") == -1);
  CHECK(std::ranges::any_of(data.notes, [](const std::string& note) {
    return note.find("'viscosity' has no unit") != std::string::npos;
  }));

  write_campaign(folder, "",
                 "files:\n  - match: '*.csv'\n    conditions:\n      gap: {manifest: 'gap [mm]'}\n"
                 "      viscosity: {manifest: viscosity, unit: Pa*s}\n"
                 "      temperature: {manifest: room, unit: degC}\n");
  data = load_dataset({folder.path()});
  CHECK_CLOSE(condition(data.records[0], "gap"), 1.1e-3, 1e-12, 0);
  CHECK(condition(data.records[1], "viscosity") == 0.2);
  CHECK_CLOSE(condition(data.records[1], "temperature"), 299.15, 1e-12, 0);
}

TEST_CASE("a column of what no drawing has is a condition too") {
  const TemporaryFolder folder;
  write_campaign(folder,
                 "file,spring_stiffness [N/mm],yield_stress [kPa]\na_0A.csv,2,0\nb_1A.csv,2,30\n");
  const Dataset data = load_dataset({folder.path()});
  CHECK(condition(data.records.front(), "spring_stiffness") == 2000);
}

TEST_CASE("a manifest with semicolons and decimal commas; a build; what it states in vain") {
  const TemporaryFolder folder;
  write_campaign(folder,
                 "file;current [A];gap [mm];specimen;operator\na_0A.csv;0,25;1,1;1;Ann\n"
                 "b_1A.csv;1,5;1,3;2;Bob\nc_2A.csv;2;1,3;2;Bob\n");
  Dataset data = load_dataset({folder.path()});
  REQUIRE(data.records.size() == 2);
  CHECK(*data.records[0].drive_level == 0.25);
  CHECK_CLOSE(condition(data.records[1], "gap"), 1.3e-3, 1e-12, 0);
  CHECK(condition(data.records[1], "specimen") == 2);
  const auto notes = [&](const std::string& words) {
    return std::ranges::count_if(
        data.notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  CHECK(notes("manifest.csv names files that are not there: 'c_2A.csv' (line 4)") == 1);
  CHECK(notes("not used without a dataset file: 'operator'") == 1);

  // Builds by words are said; a file that is named alone asks for no other.
  write_campaign(folder, "file,specimen\na_0A.csv,left\nb_1A.csv,right\nc_2A.csv,left\n");
  data = load_dataset({folder.path() / "a_0A.csv"});
  CHECK(condition(data.records[0], "specimen") == -1);
  CHECK(notes("'specimen' is not used") == 1);
  CHECK(notes("not there") == 0);
}

TEST_CASE("a drive level in a manifest is in the unit of its column's name") {
  for (const auto& [column, statement] :
       {std::pair<std::string, std::string>{"current [mA]", ""},
        {"current_mA", ""},
        {"lev (mA)", "files:\n  - {match: '*.csv', level: {manifest: 'lev (mA)'}}\n"}}) {
    CAPTURE(column);
    const TemporaryFolder folder;
    write_campaign(folder, "file," + column + "\na_0A.csv,150\nb_1A.csv,1500\n", statement);
    const Dataset data = load_dataset({folder.path()});
    CHECK_CLOSE(*data.records[0].drive_level, 0.15, 1e-12, 0);
    CHECK_CLOSE(*data.records[1].drive_level, 1.5, 1e-12, 0);
  }
}

TEST_CASE("drawings and columns that cannot be used end the work, with what would be right") {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& manifest, const std::string& statement,
                        const char* words) {
    write_campaign(folder, manifest, statement);
    const std::string message = refused(folder);
    CAPTURE(message);
    CHECK(message.find(words) != std::string::npos);
  };
  const std::string listed = "file,gap,drawn\na_0A.csv,1,small.yaml\nb_1A.csv,wide,none.yaml\n";
  const auto entry = [](const std::string& text) {
    return "files:\n  - match: '*.csv'\n    " + text + "\n";
  };
  says(listed, entry("conditions: {gap: {manifest: gap}}"),
       "has no unit; {manifest: gap, unit: mm}");
  says(listed, entry("conditions: {gap: {manifest: gap, unit: kg}}"), "does not fit gap");
  says(listed, entry("conditions: {gap: {manifest: gap, unit: mm}}"), "is 'wide', not a number");
  says(listed, entry("conditions: {gap: {manifest: gape, unit: mm}}"), "has no 'gape'");
  says("file,gap\na_0A.csv,1.2\nb_1A.csv,1.2\n",
       entry("conditions: {gap: {manifest: gap, unit: m}}"),
       "column 'gap', a_0A.csv: gap is 1.2 m; 5e-05 ... 0.01 m");
  says(listed, entry("damper: {manifest: drawn}"), "none.yaml");
  says(listed, entry("damper: {manifest: drawings}"), "has no 'drawings'");
  says(listed, entry("damper: smal"), "is no drawing");
  folder.write("wrong.yaml", "gap: 30 mm\n");
  says(listed, entry("damper: wrong.yaml"), "dataset.yaml:3");
  folder.write("wrong.yaml", "yield_stress: 20 kPa\n");
  says(listed, entry("damper: wrong.yaml"), "that no current changes");
}

TEST_CASE("a record's temperature makes its fluid's viscosity, or is said not to count") {
  const TemporaryFolder folder;
  write_campaign(folder,
                 "file,damper,temperature [degC]\na_0A.csv,small.yaml,60\nb_1A.csv,thin.yaml,60\n");
  folder.write("thin.yaml", "name: thin\nfluid: 132DG\nviscosity_exponent: 0.01\n");
  const Dataset data = load_dataset({folder.path()});
  const auto says = [](const Record& record, const char* words) {
    return std::ranges::any_of(record.notes, [&](const std::string& note) {
      return note.find(words) != std::string::npos;
    });
  };
  const double at_40 = load_description(folder.path() / "small.yaml").fluid->viscosity(313.15);
  CHECK(condition(data.records[0], "viscosity") == at_40);
  CHECK(says(data.records[0], "its temperature does not count"));
  CHECK_CLOSE(condition(data.records[1], "viscosity"), at_40 * std::exp(-0.01 * 20), 1e-12, 0);
  CHECK(says(data.records[1], "the viscosity of 132DG is that at 60 degC"));
}
