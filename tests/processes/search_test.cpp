#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <SQLiteCpp/SQLiteCpp.h>

#include "cli/program.h"
#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/value.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// 9 networks of 3 folds: short, and long enough to be killed in the middle.
const std::string kHalving =
    " --over hidden=2:12 --over activation=tanh,sigmoid --method halving --trials 9 --starts 1 "
    "--network epochs=30 "
    "--output ";

std::string search_of(const std::string& options) {
  return "search " + small_campaign().string() + " " + options;
}

using Rows = std::map<std::string, std::string>;

/// What a killed search left, as a copy shows it: the file itself stays as it was found.
Rows rows_in(const fs::path& folder) {
  const TemporaryFolder copy;
  for (const char* name : {"search.sqlite", "search.sqlite-wal"})
    if (fs::exists(folder / name)) fs::copy_file(folder / name, copy.path() / name);
  Rows rows;
  if (!fs::exists(copy.path() / "search.sqlite")) return rows;
  SQLite::Database database((copy.path() / "search.sqlite").string(), SQLite::OPEN_READWRITE);
  if (!database.tableExists("result")) return rows;
  SQLite::Statement select(database, "SELECT key, bytes FROM result");
  while (select.executeStep())
    rows[select.getColumn(0).getString()] = select.getColumn(1).getString();
  return rows;
}

/// Nothing of what was there is gone or was made again.
void check_kept(const Rows& before, const Rows& after) {
  for (const auto& [key, value] : before) {
    const auto found = after.find(key);
    REQUIRE_MESSAGE(found != after.end(), key);
    CHECK_MESSAGE(found->second == value, key);
  }
}

int wanted_kills() {
  const char* stated = std::getenv("DASHPOT_KILLS");
  return stated ? std::atoi(stated) : 2;
}

}  // namespace

TEST_CASE(
    "search: a table, a page, a table as CSV, Markdown and JSON, and the best model as a file" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_dashpot(search_of("--over hidden=2,3,8-4 --over activation=tanh,relu --method grid "
                            "--network epochs=20 --starts 1 --figures --output " +
                            folder.path().string()));
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  for (const char* part : {"search: 6 trials\n", "6 of 6", "hidden  activation", "8-4", "best",
                           "18 fits in", "trials was chosen by this very error"})
    CHECK_MESSAGE(contains(result.output, part), part);
  for (const char* file : {"search.sqlite", "search.html", "search.json", "search.md", "search.csv",
                           "models/best.json", "figures/search.svg", "figures/search.pdf"})
    CHECK_MESSAGE(fs::exists(folder.path() / file), file);
  const Value report = parse_json(read_file(folder.path() / "search.json"), "search.json");
  CHECK(report.find("trials")->items().size() == 6);
  const Value& best = report.find("trials")->items().front();
  CHECK(best.find("best")->as_bool());
  CHECK(contains(read_file(folder.path() / "search.md"), "| Par. |"));

  const ProgramResult judged =
      stdout_of_dashpot("evaluate " + (folder.path() / "models" / "best.json").string() + " " +
                        small_campaign().string());
  CHECK(judged.exit_code == 0);
  const std::string table = read_file(folder.path() / "search.csv");
  const ProgramResult json =
      stdout_of_dashpot(search_of("--over hidden=2,3,8-4 --over activation=tanh,relu --method grid "
                                  "--network epochs=20 --starts 1 --json --output " +
                                  folder.path().string()));
  CHECK(parse_json(json.output, "search --json").find("kept_fits")->as_number() == 18);
  CHECK(read_file(folder.path() / "search.csv") == table);
}

TEST_CASE(
    "search: killed at random moments, it goes on, nothing is lost and the table is the same" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const fs::path whole = folder.path() / "whole";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(run_dashpot(search_of(kHalving + whole.string())).exit_code == 0);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string table = read_file(whole / "search.csv");
  const Rows all = rows_in(whole);
  CHECK(all.size() == (9 + 3) * 3);

  Random random(
      static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()));
  int kills = 0, in_the_middle = 0, runs = 0;
  fs::path resumed = folder.path() / "resumed0";
  Rows before;
  while (kills < wanted_kills() && ++runs < 20 * wanted_kills()) {
    const std::string moment = format_exact(random.uniform(0, seconds));
    const ProgramResult result =
        run_program("timeout -s KILL " + moment + " " + program_path() + " " +
                    search_of("--threads 2" + kHalving + resumed.string()));
    CAPTURE(result.output);
    const Rows after = rows_in(resumed);
    check_kept(before, after);
    before = after;
    if (result.exit_code != 0) {
      REQUIRE(result.exit_code == 137);
      ++kills;
      in_the_middle += !after.empty() && after.size() < all.size();
      continue;
    }
    CHECK(read_file(resumed / "search.csv") == table);
    resumed = folder.path() / ("resumed" + std::to_string(runs));
    before.clear();
  }
  CHECK(kills == wanted_kills());
  MESSAGE(kills << " kills, " << in_the_middle << " of them amid the trials");
  const ProgramResult last = run_dashpot(search_of(kHalving + resumed.string()));
  CHECK(last.exit_code == 0);
  const Rows end = rows_in(resumed);
  check_kept(before, end);
  CHECK(end.size() == all.size());
  CHECK(read_file(resumed / "search.csv") == table);
}

TEST_CASE("search: an interruption says what is kept and how to go on") {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "log").string();
  const ProgramResult result =
      run_program("( " + program_path() + " " +
                  search_of("--over hidden=2:40 --over l2=1e-6:1e-2 --trials 5000 --output " +
                            folder.path().string()) +
                  " > " + log + " 2>&1 & job=$!; for k in $(seq 600); do grep -q ' 1 of 5000' " +
                  log + " && break; sleep 0.05; done; kill -INT $job; wait $job; code=$?; cat " +
                  log + "; exit $code )");
  CAPTURE(result.output);
  CHECK(result.exit_code == 130);
  CHECK(contains(result.output, "every finished fit is kept in " + folder.path().string() +
                                    "; the same command goes on from there"));
  CHECK(!fs::exists(folder.path() / "search.html"));
  CHECK(!fs::exists(folder.path() / "search.sqlite-wal"));  // closed in order
  CHECK(!rows_in(folder.path()).empty());
}

TEST_CASE("search: another search's file is refused until --fresh throws it away" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string rest =
      " --method grid --network epochs=3 --starts 1 --no-report --output " + folder.path().string();
  REQUIRE(run_dashpot(search_of("--over hidden=2,3" + rest)).exit_code == 0);
  const ProgramResult other = run_dashpot(search_of("--over hidden=2,3 --seed 2" + rest));
  CHECK(other.exit_code == 1);
  CHECK(contains(other.output, "holds another search (seed: '1' there, '2' here)"));
  CHECK(run_dashpot(search_of("--over hidden=2,3 --seed 2 --fresh" + rest)).exit_code == 0);
  CHECK(rows_in(folder.path()).size() == 6);
}

TEST_CASE("search: on a terminal the best so far stand in a table that redraws itself" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(
      "script -qec '" + program_path() + " " +
      search_of("--over hidden=2,3,4 --method grid --network epochs=3 --starts 1 --output " +
                folder.path().string()) +
      "' /dev/null < /dev/null");
  CHECK(contains(result.output, " of 3 trials ended, the best so far:"));
  CHECK(contains(result.output, "A\x1b[J"));  // some lines up, and away with what is there
}

TEST_CASE("search: what cannot be searched is told before the recordings are read" *
          doctest::test_suite("long")) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "--over is missing"},
      {"--over hidden=2,3 --model bingham", "unknown network 'bingham'; known: mlp_one_sensor"},
      {"--over hidden=2,3 --network hidden=4", "hidden is fixed as well"},
      {"--over hidden=2:60 --method halving --trials 5", "too few to be divided by three"},
      {"--over hidden=2:60 --method halving --effort epochs",
       "state them with --network epochs=300"},
      {"--over hidden=2:60 --models bingham", "unknown option '--models'"}};
  for (const auto& [options, part] : cases) {
    const ProgramResult result = run_dashpot("search /nowhere " + options);
    CAPTURE(result.output);
    CHECK(result.exit_code == 2);
    CHECK_MESSAGE(contains(result.output, part), part);
  }
}
