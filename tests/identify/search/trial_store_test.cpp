#include "dashpot/identify/search/trial_store.h"

#include <cmath>
#include <limits>

#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
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

TEST_CASE("a result comes back bit for bit, also from another process's file") {
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
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);  // one file at rest
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

TEST_CASE("a result is written once") {
  const TemporaryFolder folder;
  TrialStore store(folder.path() / "search.sqlite", kSearch);
  store.save({"hidden=5", 1, 0}, example());
  CHECK(!message_of([&] { store.save({"hidden=5", 1, 0}, example()); }).empty());
  CHECK(store.size() == 1);
}

TEST_CASE("several threads write at once") {
  const TemporaryFolder folder;
  TrialStore store(folder.path() / "search.sqlite", kSearch);
  parallel_for(40, 4, [&](std::size_t k) { store.save({"hidden=5", 1, k}, example()); });
  CHECK(store.size() == 40);
}

TEST_CASE(
    "another search, another process and another kind of file are refused with what is the "
    "matter") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  const auto message = [](const fs::path& path, const NamedTexts& search) {
    return message_of([&] { const TrialStore store(path, search); });
  };
  {
    const TrialStore first(file, kSearch);
    CHECK(message(file, kSearch).find("is in use by another search") != std::string::npos);
    CHECK(message_of([&] { TrialStore::remove(file); }).find("is in use") != std::string::npos);
  }
  CHECK(message(file, kSearch).empty());
  NamedTexts other = kSearch;
  other[0].second = std::string(64, 'b');
  other[1].second = "2";
  CHECK(message(file, other).find("holds another search (other data; seed: '1' there, '2' here)") !=
        std::string::npos);
  CHECK(message(file, kSearch).empty());  // a refusal changes nothing
  const fs::path text = folder.write("text.sqlite", "not a database, " + std::string(2000, 'x'));
  CHECK(message(text, kSearch).find("is no file of search results") != std::string::npos);
  CHECK(read_file(text).starts_with("not a database"));
  CHECK(message(folder.path() / "nowhere" / "search.sqlite", kSearch).find("cannot be") !=
        std::string::npos);
  CHECK(
      message(folder.write("empty.sqlite", ""), kSearch).empty());  // a kill before the first write
}

TEST_CASE("a file that was cut is reported as damaged, never read as results") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  {
    TrialStore store(file, kSearch);
    for (std::size_t k = 0; k < 200; ++k) store.save({"hidden=5", 1, k}, example());
  }
  fs::resize_file(file, fs::file_size(file) / 2);
  const std::string message = message_of([&] {
    const TrialStore store(file, kSearch);
    for (std::size_t k = 0; k < 200; ++k) store.load({"hidden=5", 1, k});
  });
  CHECK(message.find("is damaged") != std::string::npos);
  TrialStore::remove(file);
  CHECK(TrialStore(file, kSearch).size() == 0);
}
