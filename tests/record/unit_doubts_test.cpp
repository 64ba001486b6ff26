#include "dashpot/record/unit_doubts.h"

#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A sine of 10 mm and 1 Hz against 1 kN*s/m, at 100 Hz for 2 s and at 0.5 A.
Record usual_record() {
  Record record;
  record.name = "usual";
  record.sample_time = 0.01;
  Channel x{"displacement", "m", {}, "column x_mm, mm -> m"};
  Channel v{"velocity", "m/s", {}, "derived from displacement, 20 Hz zero-phase"};
  Channel f{"force", "N", {}, "column F [N], sign flipped"};
  for (int k = 0; k < 200; ++k) {
    const double t = 0.01 * k, w = 2 * M_PI;
    record.time.push_back(t);
    x.samples.push_back(0.01 * std::sin(w * t));
    v.samples.push_back(0.01 * w * std::cos(w * t));
    f.samples.push_back(10 * w * std::cos(w * t));
  }
  record.channels = {
      x, v, f, {"current", "A", std::vector<double>(200, 0.5), "constant, from file name"}};
  return record;
}

/// The only doubt about that record with one channel changed.
std::string doubt_about(const std::string& channel, double factor, const std::string& origin) {
  Record record = usual_record();
  Channel& changed = *record.find(channel);
  for (double& value : changed.samples) value *= factor;
  changed.origin = origin;
  const std::vector<std::string> doubts = doubts_about_units(record);
  REQUIRE(doubts.size() == 1);
  return doubts.front();
}

}  // namespace

TEST_CASE("a record of usual sizes raises no doubt of its units, nor does one at rest") {
  CHECK(doubts_about_units(usual_record()).empty());
  Record at_rest = usual_record();
  for (Channel& channel : at_rest.channels) std::ranges::fill(channel.samples, 0);
  CHECK(doubts_about_units(at_rest).empty());
}

TEST_CASE("currents that are negative in all records are told, those of both signs are not") {
  std::vector<Record> records{usual_record(), usual_record()};
  std::ranges::fill(records[0].find("current")->samples, 0.001);
  std::ranges::fill(records[1].find("current")->samples, -0.5);
  const auto doubt = doubt_about_currents(records);
  REQUIRE(doubt);
  CHECK(contains(doubt->why, "its current is negative, as that of all records: -0.5 A"));
  std::ranges::fill(records[0].find("current")->samples, 0.5);
  CHECK(!doubt_about_currents(records));
}

TEST_CASE("sizes that no MR damper has are told with column, likelier unit and what to write") {
  CHECK(doubt_about("current", 1000, "column I [A]") ==
        "the current (column 'I [A]') reaches 500 A: is its unit A right? No MR damper does so; in "
        "mA it would be 0.5 A: if so, write that unit into the header, or state it in a dataset "
        "file with the other channels, 'channels: {current: {column: \"I [A]\", unit: mA}, ...}'");
  CHECK(contains(doubt_about("displacement", 1000, "column x [m]"),
                 "(column 'x [m]') spans 20 m: is its unit m right? No MR damper does so; in mm it "
                 "would be 0.02 m: if so"));
  CHECK(contains(doubt_about("displacement", 1e-3, "column x, y [mm], mm -> m"),
                 "(column 'x, y [mm]') spans 2e-05 m: is its unit mm right? Hardly any MR damper "
                 "does so; in m it would be 0.02 m: if so"));
  CHECK(contains(doubt_about("force", 1e-3, "column F [N], sign flipped"),
                 "(column 'F [N]') spans 0.1257 N: is its unit N right? Hardly any MR damper does "
                 "so; in kN it would be 125.7 N: if so"));
  CHECK(contains(doubt_about("force", 1e5, "column F [kN], kN -> N"),
                 "spans 1.257e+07 N: is its unit kN right? No MR damper does so; in N it would be "
                 "1.257e+04 N"));

  // A level from beside the columns has none to write.
  CHECK(doubt_about("current", 1000, "constant, from file name") ==
        "the current (constant, from file name) reaches 500 A: is its unit A right? No MR damper "
        "does so; in mA it would be 0.5 A");
  // Where no usual unit helps, the column may be wrong.
  CHECK(contains(doubt_about("current", 1e12, "column I [A]"), "the column may be another one"));
}

TEST_CASE("a temperature and a voltage of unusual sizes are told") {
  const auto doubt = [](const Channel& channel) {
    Record record = usual_record();
    record.channels.push_back(channel);
    const std::vector<std::string> doubts = doubts_about_units(record);
    return doubts.empty() ? std::string() : doubts.front();
  };
  const auto constant = [](const char* name, const char* unit, double value, const char* origin) {
    return Channel{name, unit, std::vector<double>(200, value), origin};
  };
  CHECK(contains(doubt(constant("temperature", "K", 25, "column temp")),
                 "reaches 25 K: is its unit K right? Hardly any MR damper does so; in degC it "
                 "would be 298.1 K"));
  CHECK(contains(doubt(constant("temperature", "K", 571.15, "column T, degC -> K")),
                 "in K it would be 298 K"));
  CHECK(doubt(constant("temperature", "K", 353, "column T, degC -> K")).empty());
  CHECK(
      contains(doubt(constant("voltage", "V", 2250, "column U [V]")), "in mV it would be 2.25 V"));
  CHECK(doubt(constant("voltage", "V", -24, "column U [V]")).empty());
}

TEST_CASE("currents that all are thousandths of A below a column in mA are told") {
  const auto doubt = [](const std::vector<double>& levels, const std::string& origin) {
    std::vector<Record> records;
    for (const double level : levels) {
      Record& record = records.emplace_back(usual_record());
      record.name = format_number(1e3 * level);
      record.drive_level = level;
      std::ranges::fill(record.find("current")->samples, level);
      record.find("current")->origin = origin;
    }
    const auto suspect = doubt_about_currents(records);
    return suspect ? suspect->record + ": " + suspect->why : "";
  };
  CHECK(
      contains(doubt({0, 1e-3, 2e-3}, "column I [mA], mA -> A"),
               "2: its current, the largest of all records, reaches 0.002 A (column 'I [mA]'): is "
               "its unit mA right? MR dampers take more; in A it would be 2 A: if so"));
  // A damper of 20 mA, the zero of a sensor, and what is counted in A.
  CHECK(doubt({0, 0.01, 0.02}, "column I [mA], mA -> A").empty());
  CHECK(doubt({4e-4, 4e-4}, "column I [mA], mA -> A").empty());
  CHECK(doubt({0, 1e-3}, "column I [A]").empty());
}

TEST_CASE("a time in another unit is told by its steps, or by a speed without room") {
  Record slow = usual_record();
  for (double& t : slow.time) t *= 1000;
  CHECK(
      contains(doubts_about_units(slow).at(0),
               "the samples are 10 s apart: is the unit of time right? In ms it would be 0.01 s"));

  Record fast = usual_record();
  for (double& t : fast.time) t /= 1000;
  for (double& v : fast.find("velocity")->samples) v *= 1000;
  CHECK(contains(doubts_about_units(fast).at(0),
                 "it reaches 62.8 m/s within a stroke of 20 mm, which takes more than 2e+05 m/s^2: "
                 "the unit of time or that of the motion may be wrong"));

  // A blow within 5 mm is none of that.
  Record blow = usual_record();
  for (double& x : blow.find("displacement")->samples) x *= 0.25;
  for (double& v : blow.find("velocity")->samples) v *= 80;
  CHECK(doubts_about_units(blow).empty());
}

TEST_CASE("a file whose amperes are thousandths is read, and identify is told") {
  const TemporaryFolder folder;
  std::string text = "t [s],x [mm],F [N],I [A]\n";
  const Record record = usual_record();
  for (std::size_t k = 0; k < record.size(); ++k)
    text += format_number(record.time[k], 6) + "," +
            format_number(1e3 * record.channel("displacement").samples[k], 6) + "," +
            format_number(record.channel("force").samples[k], 6) + ",1500\n";
  const Dataset dataset = load_dataset({folder.write("run.csv", text)});
  REQUIRE(dataset.suspects.size() == 1);
  CHECK(contains(dataset.suspects[0].why, "(column 'I [A]') reaches 1500 A"));
  CHECK(dataset.notes.front().starts_with("suspect: run: the current"));
}
