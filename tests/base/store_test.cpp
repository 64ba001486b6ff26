#include "dashpot/base/store.h"

#include <csignal>
#include <unistd.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/wait.h>

#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "sanitized.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

constexpr StoreFormat kFormat{"search", 2, "begin anew with --fresh"};
const NamedTexts kBasis{{"data", std::string(64, 'a')}, {"seed", "1"}};

std::string refusal(const fs::path& file, const StoreFormat& format = kFormat,
                    const NamedTexts& basis = kBasis) {
  return message_of([&] { const Store store(file, format, basis); });
}

void run_sql(const fs::path& file, const std::string& statements) {
  SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec(statements);
}

std::string key_of(std::size_t k) { return "row " + std::to_string(k); }

/// Long enough that one result spans several pages of the file.
std::string bytes_of(std::size_t k) { return std::string(5000, static_cast<char>(k)); }

/// Saves results, several at once, and reports the number of each after it is saved. Runs until it
/// is killed.
[[noreturn]] void save_until_killed(const fs::path& file, std::size_t first, int reports) {
  constexpr std::size_t kAtOnce = 3;
  Store store(file, kFormat, kBasis);
  for (std::size_t k = first;; k += kAtOnce) {
    std::vector<Store::Result> results;
    for (std::size_t j = k; j < k + kAtOnce; ++j) results.push_back({key_of(j), bytes_of(j)});
    store.save(results);
    const std::size_t saved = k + kAtOnce;
    if (write(reports, &saved, sizeof saved) != sizeof saved) _exit(1);
  }
}

/// Lets a child save until it has reported `count` times, kills it, and returns how many results
/// it had reported as saved by then.
std::size_t saved_before_kill(const fs::path& file, std::size_t first, std::size_t count) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) save_until_killed(file, first, ends[1]);
  close(ends[1]);

  std::size_t saved = first;
  for (std::size_t k = 0; k < count; ++k) REQUIRE(read(ends[0], &saved, sizeof saved) > 0);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  while (read(ends[0], &saved, sizeof saved) > 0) continue;
  close(ends[0]);
  return saved;
}

}  // namespace

TEST_CASE(
    "a result comes back byte for byte, also in another process; a later one takes its place") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  const std::string bytes("\0\xff'\n", 4);
  {
    Store store(file, kFormat, kBasis);
    CHECK(store.size() == 0);
    CHECK(!store.load("a"));
    store.save("a", "earlier");
    store.save("a", bytes);
    store.save("b", "");
  }
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);  // one file at rest
  const Store store(file, kFormat, kBasis);
  CHECK(store.size() == 2);
  CHECK(store.load("a") == bytes);
  CHECK(store.load("b") == "");
  CHECK(!store.load("A"));
}

TEST_CASE("results are visited in the order of their keys, up to an end") {
  const TemporaryFolder folder;
  Store store(folder.path() / "search.sqlite", kFormat);
  store.save(std::vector<Store::Result>{{"10", "x"}, {"2", "z"}, {"09", "w"}, {"1", "y"}});
  const auto visited = [&](const std::optional<std::string>& end) {
    std::string text;
    store.for_each(
        [&](std::string_view key, std::string_view bytes) {
          text += std::string(key) + '=' + std::string(bytes) + ' ';
        },
        end);
    return text;
  };
  CHECK(visited(std::nullopt) == "09=w 1=y 10=x 2=z ");
  CHECK(visited("10") == "09=w 1=y ");
  CHECK(visited("") == "");
}

TEST_CASE("several threads save and load at once") {
  const TemporaryFolder folder;
  Store store(folder.path() / "search.sqlite", kFormat);
  parallel_for(40, 4, [&](std::size_t k) {
    store.save(key_of(k), bytes_of(k));
    CHECK(store.load(key_of(k)) == bytes_of(k));
  });
  CHECK(store.size() == 40);
}

TEST_CASE("killed at any moment: what was saved is there whole, and nothing half saved") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  Random random(1);
  std::size_t saved = 0;
  for (int kills = 0; kills < 8; ++kills) {
    saved = saved_before_kill(file, saved, 1 + random.next() % 40);

    // The last results may have been saved and not reported, but all of them or none.
    const Store store(file, kFormat, kBasis);
    CHECK(store.size() >= saved);
    CHECK(store.size() % 3 == 0);
    for (std::size_t k = 0; k < store.size(); ++k) CHECK(store.load(key_of(k)) == bytes_of(k));
    saved = store.size();
  }
}

TEST_CASE("what cannot be used is refused with what is the matter, and left as it was") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";

  // Another process, here another connection.
  {
    const Store first(file, kFormat, kBasis);
    CHECK(refusal(file).find("is in use by another process; wait") != std::string::npos);
    CHECK(message_of([&] { Store::remove(file); }).find("is in use") != std::string::npos);
  }
  CHECK(refusal(file).empty());

  // Another basis, format or version.
  const std::string before = read_file(file);
  NamedTexts other = kBasis;
  other[0].second = std::string(64, 'b');
  other[1].second = "2";
  CHECK(refusal(file, kFormat, other)
            .find("holds another search (other data; seed: '1' there, '2' here); give another "
                  "--output, or begin anew with --fresh") != std::string::npos);
  CHECK(refusal(file, {"sweep", 2, ""}).find("holds search results, no sweep results") !=
        std::string::npos);
  CHECK(refusal(file, {"search", 3, "remove it"})
            .find("was written by an older version of Dashpot, which this one cannot read; give "
                  "another --output, or remove it") != std::string::npos);
  CHECK(refusal(file, {"search", 1, ""}).find("was written by a newer version") !=
        std::string::npos);
  CHECK(read_file(file) == before);

  // Something else altogether.
  const fs::path text = folder.write("text.sqlite", "not a database, " + std::string(2000, 'x'));
  CHECK(refusal(text).find("is no file of search results") != std::string::npos);
  CHECK(read_file(text).starts_with("not a database"));
  const fs::path foreign = folder.path() / "foreign.sqlite";
  run_sql(foreign, "CREATE TABLE result (key TEXT, bytes BLOB)");
  CHECK(refusal(foreign).find("is a database of another program") != std::string::npos);
  CHECK(refusal(folder.path() / "nowhere" / "search.sqlite").find("cannot be written") !=
        std::string::npos);
  CHECK(refusal(folder.write("empty.sqlite", "")).empty());  // killed before the first write
}

TEST_CASE("a damaged file is reported as damaged, and can be removed") {
  const TemporaryFolder folder;
  const fs::path cut = folder.path() / "cut.sqlite", emptied = folder.path() / "emptied.sqlite";
  {
    Store store(cut, kFormat, kBasis);
    for (std::size_t k = 0; k < 20; ++k) store.save(key_of(k), bytes_of(k));
    const Store other(emptied, kFormat, kBasis);
  }
  fs::resize_file(cut, fs::file_size(cut) / 2);
  const std::string message = message_of([&] {
    const Store store(cut, kFormat, kBasis);
    for (std::size_t k = 0; k < 20; ++k) store.load(key_of(k));
  });
  CHECK(message.find("is damaged") != std::string::npos);
  CHECK(message.find("; begin anew with --fresh") != std::string::npos);
  Store::remove(cut);
  CHECK(!fs::exists(cut));

  run_sql(emptied, "DELETE FROM store");
  CHECK(refusal(emptied).find("is damaged: it does not say what it holds") != std::string::npos);
  run_sql(emptied, "DROP TABLE store");
  CHECK(refusal(emptied).find("is damaged") != std::string::npos);
}

TEST_CASE("a result that was changed behind the store is dropped, the others stay") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  {
    Store store(file, kFormat, kBasis);
    for (std::size_t k = 0; k < 4; ++k) store.save(key_of(k), "0.25 and more");
    CHECK(store.dropped() == 0);
  }
  run_sql(file,
          "UPDATE result SET bytes = CAST('0.26 and more' AS BLOB) WHERE key = 'row 1';"
          "UPDATE result SET key = 'row 9' WHERE key = 'row 2';"
          "UPDATE result SET checksum = '' WHERE key = 'row 3'");
  {
    const Store store(file, kFormat, kBasis);
    CHECK(store.dropped() == 3);
    CHECK(store.size() == 1);
    CHECK(store.load(key_of(0)) == "0.25 and more");
    for (const std::size_t k : {1, 2, 3, 9}) CHECK(!store.load(key_of(k)));
  }
  CHECK(Store(file, kFormat, kBasis).dropped() == 0);
}

TEST_CASE("single bits that flip in the file cost results, and never change one") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  {
    Store store(file, kFormat, kBasis);
    for (std::size_t k = 0; k < 40; ++k) store.save(key_of(k), bytes_of(k).substr(0, 300));
  }
  const std::string whole = read_file(file);
  Random random(3);
  int changed = 0;
  for (int trial = 0; trial < (kSanitized ? 60 : 200); ++trial) {
    std::string flipped = whole;
    flipped[random.next() % whole.size()] ^= static_cast<char>(1 << random.next() % 8);
    write_file(file, flipped);
    message_of([&] {
      const Store store(file, kFormat, kBasis);
      for (std::size_t k = 0; k < 40; ++k)
        if (const auto bytes = store.load(key_of(k)))
          changed += *bytes != bytes_of(k).substr(0, 300);
    });
    for (const char* end : {"-wal", "-journal"}) fs::remove(file.string() + end);
  }
  CHECK(changed == 0);
}

TEST_CASE("a file of before the checksums is taken as it is, and guarded from then on") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "search.sqlite";
  {
    Store store(file, kFormat, kBasis);
    store.save("a", "one");
    store.save("b", "two");
  }
  run_sql(file, "ALTER TABLE result DROP COLUMN checksum; PRAGMA user_version = 2");
  {
    const Store store(file, kFormat, kBasis);
    CHECK(store.dropped() == 0);
    CHECK(store.load("a") == "one");
    CHECK(store.load("b") == "two");
  }
  run_sql(file, "UPDATE result SET bytes = CAST('ane' AS BLOB) WHERE key = 'a'");
  CHECK(Store(file, kFormat, kBasis).dropped() == 1);
}
