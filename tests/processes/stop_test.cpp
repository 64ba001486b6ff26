#include <chrono>
#include <filesystem>

#include "cli/program.h"
#include "dashpot/base/file.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr double kLongestEnd = 12;
#else
constexpr double kLongestEnd = 3;
#endif

/// A results folder with an old report in it, on a file system with almost no room left. Without
/// the right to mount one, a limit on file sizes has the same effect.
std::string on_full_disk(const fs::path& folder, const std::string& command) {
  const std::string mount = "mount -t tmpfs -o size=64k tmpfs " + folder.string();
  const std::string old = "echo old > " + folder.string() + "/report.html";
  const std::string unmount = "umount " + folder.string();
  return "( if " + mount + " 2>/dev/null; then " + old + "; " + command + "; code=$?; cat " +
         folder.string() + "/report.html; find " + folder.string() + " -name '*report.html?*'; " +
         unmount + "; exit $code; else " + old + "; ( ulimit -f 16; " + command +
         " ); code=$?; cat " + folder.string() + "/report.html; exit $code; fi )";
}

}  // namespace

TEST_CASE("an interruption ends identify soon, with 130 and without half-written files") {
  const TemporaryFolder folder;
  const std::string results = (folder.path() / "results").string();
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult result =
      run_program("timeout --preserve-status -s INT 1 " + program_path() + " identify " +
                  small_campaign().string() +
                  " --models modified_bouc_wen --starts 100000 --output " + results);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  CAPTURE(result.output);
  CHECK(result.exit_code == 130);
  CHECK(contains(result.output, "interrupted"));
  // A second of work, a quarter of one to end (8 where sanitizers slow the end down), the start.
  CHECK(taken.count() < kLongestEnd);
  // The store of finished fits, with its log where the work did not end in order.
  CHECK(fs::exists(fs::path(results) / "fits.sqlite"));
  for (const auto& entry : fs::recursive_directory_iterator(results))
    if (entry.is_regular_file()) CHECK(entry.path().filename().string().starts_with("fits.sqlite"));
}

TEST_CASE("a signal that comes twice at once, as `timeout` may send it, is one signal") {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(
      "( " + program_path() + " identify " + small_campaign().string() +
      " --quiet --models modified_bouc_wen --starts 100000 --output " + folder.path().string() +
      " & job=$!; sleep 0.5; kill -TERM $job; kill -TERM $job; wait $job )");
  CHECK(result.exit_code == 143);
  CHECK(contains(result.output, "interrupted"));
}

TEST_CASE("a full disk is reported and the old report survives") {
  const TemporaryFolder folder;
  const fs::path results = folder.path() / "results";
  fs::create_directory(results);
  const ProgramResult result = run_program(
      on_full_disk(results, program_path() + " identify " + small_campaign().string() +
                                " --quiet --fresh --models bingham --output " + results.string()));
  CAPTURE(result.output);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "report.html"));
  CHECK(result.output.ends_with("old\n"));
}
