#include <filesystem>

#include <SQLiteCpp/SQLiteCpp.h>

#include "cli/program.h"
#include "dashpot/base/file.h"
#include "dashpot/base/store.h"
#include "dashpot/base/text.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// The command in parts, joined into `folder`/joined. Returns what the joining printed.
std::string run_in_parts(const std::string& command, int parts, const fs::path& folder) {
  std::string named;
  for (int k = 1; k <= parts; ++k) {
    const std::string part = (folder / ("part" + std::to_string(k))).string();
    const ProgramResult made = run_dashpot(command + " --part " + std::to_string(k) + '/' +
                                           std::to_string(parts) + " --output " + part);
    CAPTURE(made.output);
    REQUIRE(made.exit_code == 0);
    named += ' ' + part;
  }
  const ProgramResult merged =
      run_dashpot("merge" + named + " --output " + (folder / "joined").string());
  CAPTURE(merged.output);
  REQUIRE(merged.exit_code == 0);
  return merged.output;
}

}  // namespace

TEST_CASE("rank in three parts on unlike machines: joined, it is what one process finds" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string command =
      "rank " + small_campaign().string() + " --models bingham,tanh_kwok --simd sse2";
  CHECK(contains(run_in_parts(command, 3, folder.path()), "8 results from 3 stores"));

  const fs::path joined = folder.path() / "joined", whole = folder.path() / "whole";
  const ProgramResult after = run_dashpot(command + " --output " + joined.string());
  CHECK(contains(after.output, "8 fits kept from before"));
  REQUIRE(run_dashpot(command + " --output " + whole.string()).exit_code == 0);
  CHECK(read_file(joined / "report.csv") == read_file(whole / "report.csv"));

  // Joining again changes nothing, and other instructions are other tasks.
  const std::string before = read_file(joined / "fits.sqlite");
  const std::string again =
      "merge " + (whole / "fits.sqlite").string() + " --output " + joined.string();
  CHECK(contains(run_dashpot(again).output, "8 results from 1 store; 8 found more than once"));
  CHECK(read_file(joined / "fits.sqlite").size() == before.size());
  if (!contains(run_dashpot("help rank --simd").output, "avx2")) return;
  const ProgramResult other =
      run_dashpot("rank " + small_campaign().string() + " --models bingham --simd avx2 --output " +
                  joined.string());
  if (other.exit_code == 0) CHECK(!contains(other.output, "kept from before"));
}

TEST_CASE("search and sweep in parts" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string search =
      "search " + small_campaign().string() + " --over hidden=3,4 --method grid --network epochs=3";
  run_in_parts(search, 2, folder.path() / "search");
  const fs::path searched = folder.path() / "search";
  REQUIRE(run_dashpot(search + " --output " + (searched / "joined").string()).exit_code == 0);
  REQUIRE(run_dashpot(search + " --output " + (searched / "whole").string()).exit_code == 0);
  CHECK(read_file(searched / "joined/search.csv") == read_file(searched / "whole/search.csv"));

  const std::string sweep = "sweep comfort --duration 6 --samples 70";
  const fs::path swept = folder.path() / "sweep";
  CHECK(contains(run_in_parts(sweep, 2, swept), "210 results from 2 stores"));
  const ProgramResult after = run_dashpot(sweep + " --output " + (swept / "joined").string());
  CHECK(contains(after.output, "210 kept from before"));
  REQUIRE(run_dashpot(sweep + " --output " + (swept / "whole").string()).exit_code == 0);
  CHECK(read_file(swept / "joined/rides.csv") == read_file(swept / "whole/rides.csv"));
}

TEST_CASE(
    "merge: stores that disagree are refused with task, values and files; nothing is joined") {
  const TemporaryFolder folder;
  constexpr StoreFormat kFit{"fit", 2, "remove this file"};
  const auto make = [&](const std::string& name, const std::string& bytes) {
    fs::create_directories(folder.path() / name);
    Store(folder.path() / name / "fits.sqlite", kFit).save("bingham 1234", bytes);
    return (folder.path() / name).string();
  };
  const std::string a = make("a", R"({"seconds": 1, "parameters": [["c0", 700]]})"),
                    b = make("b", R"({"seconds": 2, "parameters": [["c0", 700]]})"),
                    c = make("c", R"({"seconds": 1, "parameters": [["c0", 701]]})");
  const fs::path joined = folder.path() / "joined";
  CHECK(run_dashpot("merge " + a + ' ' + b + " --output " + joined.string()).exit_code == 0);
  const std::string before = read_file(joined / "fits.sqlite");
  const ProgramResult refused =
      run_dashpot("merge " + a + ' ' + c + " --output " + joined.string());
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.output, c + "/fits.sqlite: disagrees with "));
  CHECK(contains(refused.output,
                 "on 'bingham 1234': there and here parameters[0][1] is 700 and 701"));
  CHECK(read_file(joined / "fits.sqlite") == before);
  CHECK(std::distance(fs::directory_iterator(joined), {}) == 1);

  // Other results, other files and what is missing.
  Store(folder.path() / "old.sqlite", {"fit", 1, "remove this file"}).save("x", "{}");
  const auto refusal = [&](const fs::path& store) {
    return run_dashpot("merge " + store.string() + " --output " + joined.string()).output;
  };
  CHECK(contains(refusal(folder.path() / "old.sqlite"), "was written by an older version"));
  CHECK(contains(refusal(folder.write("no.sqlite", "hello")), "no.sqlite"));
  CHECK(contains(refusal(folder.path() / "none.sqlite"), "there is no such file"));
}

TEST_CASE("--part and --simd say what would be right" * doctest::test_suite("long")) {
  const auto says = [](const std::string& options) {
    const ProgramResult result = run_dashpot("sweep comfort " + options);
    CHECK(result.exit_code == 2);
    return result.output;
  };
  for (const char* part : {"0/3", "4/3", "3", "a/b", "1/0", "/"})
    CHECK(contains(says(std::string("--part ") + part), "give its number and how many there are"));
  CHECK(contains(says("--simd neon"), "unknown value 'neon'"));
}
