#include "dashpot/identify/search/trial_store.h"

#include <cmath>
#include <limits>

#include <SQLiteCpp/SQLiteCpp.h>

#include "dashpot/base/file.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

const NamedTexts kSearch{{"data", std::string(64, 'a')}, {"seed", "1"}};

FoldResult example() {
  FoldResult result;
  result.parameters = 41;
  result.sums = {100, 0.1, 1.0 / 3, 7, -1e300, 5e-324, 0.2, -12, 13};
  result.worst_esr = std::numeric_limits<double>::infinity();
  result.diverged = 2;
  result.seconds = 0.25;
  return result;
}

}  // namespace

TEST_CASE("a result comes back bit for bit, also in another process") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  const TrialStore::Key key{"hidden=5", 1.0 / 3, 2};
  {
    TrialStore store(file, kSearch);
    CHECK(!store.load(key));
    store.save(key, example());
    FoldResult failed;
    failed.failure = "r1: has no motion";
    failed.sums.squared = std::numeric_limits<double>::quiet_NaN();
    store.save({"hidden=5", 1, 2}, failed);
    CHECK(store.size() == 2);
  }
  const TrialStore store(file, kSearch);
  CHECK(store.size() == 2);
  const auto kept = store.load(key);
  REQUIRE(kept);
  const FoldResult made = example();
  CHECK(kept->parameters == made.parameters);
  CHECK(kept->sums.n == made.sums.n);
  CHECK(kept->sums.squared == made.sums.squared);
  CHECK(kept->sums.absolute == made.sums.absolute);
  CHECK(kept->sums.largest == made.sums.largest);
  CHECK(kept->sums.force == made.sums.force);
  CHECK(kept->sums.force_squared == made.sums.force_squared);
  CHECK(kept->sums.error == made.sums.error);
  CHECK(kept->sums.force_min == made.sums.force_min);
  CHECK(kept->sums.force_max == made.sums.force_max);
  CHECK(kept->worst_esr == made.worst_esr);
  CHECK(kept->diverged == made.diverged);
  CHECK(kept->seconds == made.seconds);
  CHECK(kept->failure.empty());
  CHECK(store.load({"hidden=5", 1, 2})->failure == "r1: has no motion");
  CHECK(std::isnan(store.load({"hidden=5", 1, 2})->sums.squared));
  CHECK(!store.load({"hidden=5", 1.0 / 3, 1}));
  CHECK(!store.load({"hidden=6", 1.0 / 3, 2}));
}

TEST_CASE("a damaged result is none, and is made again in its place") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  const TrialStore::Key key{"hidden=5", 1, 0};
  TrialStore(file, kSearch).save(key, example());
  for (const std::string& bad : {std::string(), std::string("{"), std::string("{}"),
                                 std::string("[1]"), std::string("{\"failure\": 3}")}) {
    Store(file, TrialStore::kFormat, kSearch).save("hidden=5 1 0", bad);
    TrialStore store(file, kSearch);
    CHECK(!store.load(key));
    store.save(key, example());
    CHECK(store.load(key)->sums.squared == example().sums.squared);
    CHECK(store.size() == 1);
  }
}

TEST_CASE("a search that an older version kept is refused with what to do, and stays as it is") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  {
    SQLite::Database older(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    older.exec(
        "PRAGMA application_id = 1146114888; PRAGMA user_version = 1;"
        "CREATE TABLE search (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;"
        "INSERT INTO search VALUES ('seed', '1');"
        "CREATE TABLE fold_result (design TEXT NOT NULL, share REAL NOT NULL, fold INTEGER NOT "
        "NULL, failure TEXT NOT NULL, squared REAL, PRIMARY KEY (design, share, fold)) STRICT;"
        "INSERT INTO fold_result VALUES ('hidden=5', 1, 0, '', 0.1);");
  }
  const std::string before = read_file(file);
  CHECK(message_of([&] { const TrialStore store(file, kSearch); }) ==
        file.string() +
            ": was written by an older version of Dashpot, which this one cannot read; give "
            "another --output, or begin anew with --fresh");
  CHECK(read_file(file) == before);
}
