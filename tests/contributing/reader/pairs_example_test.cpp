#include "dashpot/record/readers/reader.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the example reader: a good file becomes a table, a damaged one is refused") {
  const TemporaryFolder folder;
  const std::vector<RawTable> tables =
      read_tables(folder.write("good.pairs", "pairs\n0 1\n0.1 2\n"));
  REQUIRE(tables.size() == 1);
  CHECK(tables.front().rows() == 2);
  const auto bad = folder.write("bad.pairs", "pairs\nnone\n");
  CHECK(message_of([&] { read_tables(bad); }).find("has no pair") != std::string::npos);
  CHECK(known_formats().find("pairs (.pairs)") != std::string::npos);
}
