#include "dashpot/record/conditions.h"

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
