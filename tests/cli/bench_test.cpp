#include <fstream>

#include "dashpot/base/file.h"
#include "dashpot/record/dataset.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("bench: the files read back as the campaign that was asked for") {
  const Dataset dataset = load_dataset({small_campaign() / "dataset.yaml"});
  REQUIRE(dataset.records.size() == 9);
  CHECK(dataset.drive_unit == "V");
  for (const Record& record : dataset.records) {
    CHECK(record.drive_level.has_value());
    CHECK_CLOSE(record.sample_time, 1.0 / 200, 1e-9, 0);
    for (const char* channel : {"displacement", "velocity", "force", "voltage"})
      CHECK(record.find(channel) != nullptr);
  }
}

TEST_CASE("bench: a folder is understood by the dataset file in it") {
  const Dataset dataset = load_dataset({small_campaign()});
  CHECK(dataset.records.size() == 9);
  CHECK(dataset.drive_unit == "V");
}

TEST_CASE("bench: the same seed gives the same bytes, another seed others") {
  const TemporaryFolder folder;
  const auto bytes_of = [&](const std::string& name, const std::string& seed) {
    const std::string to = (folder.path() / name).string();
    REQUIRE(run_dashpot("bench --motions 5x2 --levels 1 --seed " + seed + " --output " + to).exit_code == 0);
    return read_file(folder.path() / name / "5_mm_2_Hz_1_V.csv");
  };
  const std::string first = bytes_of("a", "3");
  CHECK(first == bytes_of("b", "3"));
  CHECK(first != bytes_of("c", "4"));
  CHECK(first.starts_with("t_s,x_mm,F_N,voltage_V\n"));
}

TEST_CASE("bench: a motion too fast to be sampled is refused with the limit") {
  const ProgramResult result = run_dashpot("bench --motions 5x90 --levels 1 --output /tmp/never");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "tenth of the sample rate"));
}
