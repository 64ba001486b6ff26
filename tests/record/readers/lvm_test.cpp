#include "dashpot/record/readers/lvm.h"

#include "dashpot/dataset.h"
#include "example_lvm.h"
#include "support.h"

using namespace dashpot;

namespace {

std::string refusal_of(const std::string& text) {
  const TemporaryFolder folder;
  return message_of([&] { read_lvm(folder.write("run.lvm", text)); });
}

std::string without(std::string text, const std::string& what, const std::string& instead = "") {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), instead);
}

}  // namespace

TEST_CASE("a LabVIEW measurement: X for all or for each channel, segments that go on, units") {
  const TemporaryFolder folder;
  for (const char* x_columns : {"One", "Multi"})
    for (const auto& [separator, decimal] : {std::pair{'\t', '.'}, {'\t', ','}, {',', '.'}}) {
      const auto path = folder.write("run.lvm", example_lvm(x_columns, separator, decimal));
      CAPTURE(x_columns);
      CAPTURE(separator);
      const std::vector<RawTable> tables = read_lvm(path);
      REQUIRE(tables.size() == 1);
      CHECK(tables[0].rows() == 400);
      CHECK(tables[0].part.empty());
      CHECK(tables[0].where(0).ends_with(":18"));
      CHECK(tables[0].where(200).ends_with(":227"));

      const Record record = load_dataset({path}).records.at(0);
      CHECK(record.sample_time == doctest::Approx(0.005));
      CHECK(record.find("displacement")->samples.at(1) == doctest::Approx(-0.039));
      CHECK(record.find("force")->samples.at(201) == -67);
    }
}

TEST_CASE("a LabVIEW measurement without X has the step that its header states, a part a segment") {
  const TemporaryFolder folder;
  const std::vector<RawTable> tables = read_lvm(folder.write("run.lvm", example_lvm("No")));
  REQUIRE(tables.size() == 2);
  CHECK(tables[1].sample_time == 0.005);
  CHECK(tables[1].part == "segment 2");
  CHECK(tables[1].columns.at(1).name == "Force");
  CHECK(tables[1].columns.at(1).unit == "N");
  CHECK(tables[1].columns.at(1).values.at(1) == -67);
}

TEST_CASE("a LabVIEW measurement whose units are in Latin-1 is read in them") {
  const TemporaryFolder folder;
  const std::string text = without(example_lvm("One"), "Label\tmm", "Label\t\xB5m");
  CHECK(read_lvm(folder.write("run.lvm", text)).at(0).columns.at(1).unit == "\u00b5m");
}

TEST_CASE("a LabVIEW measurement that is damaged is refused with its place") {
  const std::string good = example_lvm("One");
  CHECK(contains(refusal_of(good.substr(0, 60)), "ends inside a header"));
  CHECK(contains(refusal_of(good.substr(0, good.find("Channels"))), "no samples"));
  CHECK(contains(refusal_of(without(good, "X_Value\tDisplacement", "0.1\t3")),
                 "run.lvm:17: a header is not followed by the names"));
  CHECK(contains(refusal_of(without(good, "Delta_X\t0.005\t0.005", "Delta_X\t0.005\t0.01")),
                 "the channels have Delta_X of their own"));
  CHECK(contains(refusal_of(without(good, "\tDisplacement\tForce", "")), "names no channel"));

  // A cell that is no number is an error where it is used.
  const TemporaryFolder folder;
  const auto path = folder.write("run.lvm", without(good, "-39.000", "-39a"));
  CHECK(contains(message_of([&] { load_dataset({path}); }), "run.lvm:19: displacement"));
}
