#include "dashpot/record/record_file.h"

#include "dashpot/base/file.h"
#include "dashpot/record/readers/reader.h"
#include "support.h"

using namespace dashpot;

namespace {

Record small_record() {
  Record record;
  record.time = {0, 0.001, 0.002};
  record.channels = {{"body", "m", {0, 1.0 / 3, -2}, ""},
                     {"tyre_load", "N", {4414.5, 1e-7, 9e5}, ""}};
  return record;
}

}  // namespace

TEST_CASE("a record as CSV: units in the names, nine digits") {
  const TemporaryFolder folder;
  save_csv(small_record(), folder.path() / "trace.csv");
  CHECK(read_file(folder.path() / "trace.csv") ==
        "time [s],body [m],tyre_load [N]\n0,0,4414.5\n0.001,0.333333333,1e-07\n0.002,-2,900000\n");
}

TEST_CASE("a record as a MATLAB file reads back bit for bit, in a folder that it makes") {
  const TemporaryFolder folder;
  save_mat(small_record(), folder.path() / "new" / "trace.mat");
  const std::vector<RawTable> tables = read_tables(folder.path() / "new" / "trace.mat");
  REQUIRE(tables.size() == 1);
  REQUIRE(tables[0].columns.size() == 3);
  CHECK(tables[0].columns[0].name == "time");
  CHECK(tables[0].columns[1].values == small_record().channels[0].samples);
  CHECK(tables[0].columns[2].values == small_record().channels[1].samples);
  CHECK(message_of([] { save_mat(small_record(), "/proc/none.mat"); }).find("/proc/none.mat") == 0);
}
