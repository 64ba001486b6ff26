// What the attacks of review 6 did to the command line, each as it has to end.
#include <chrono>

#include "dashpot/base/file.h"
#include "program.h"
#include "sanitized.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// With room for files of so many KiB only, as on a disk that fills up.
ProgramResult run_limited(int kibibytes, const std::string& arguments) {
  return run_program("( ulimit -f " + std::to_string(kibibytes) + "; " + program_path() + " " +
                     arguments + " )");
}

/// A folder in which an earlier run of the command has left its results, and its files by content.
struct Before {
  TemporaryFolder folder;
  std::vector<std::pair<fs::path, std::string>> files;

  explicit Before(const std::string& command) {
    REQUIRE(run_dashpot(command + " -o " + output()).exit_code == 0);
    for (const auto& entry : fs::recursive_directory_iterator(output()))
      if (entry.is_regular_file()) files.emplace_back(entry.path(), read_file(entry.path()));
  }
  std::string output() const { return (folder.path() / "out").string(); }
};

bool is_whole(const fs::path& path, const std::string& content) {
  if (path.extension() == ".pdf") return contains(content.substr(content.size() - 10), "%%EOF");
  if (path.extension() == ".svg") return contains(content.substr(content.size() - 10), "</svg>");
  if (path.extension() == ".h5") return content.starts_with("\x89HDF");
  return !content.empty();
}

/// All of these; with sanitizers, where each start of the program takes a third of a second, the
/// first.
template <class T>
std::vector<T> some_of(std::vector<T> limits) {
  if (kSanitized) limits.resize(1);
  return limits;
}

/// A command at every limit: it fails with its cause and leaves no file that is cut off.
void check_full_disk(const std::string& command) {
  const Before before(command);
  std::size_t largest = 0;
  for (const auto& [path, content] : before.files) largest = std::max(largest, content.size());
  for (const std::size_t share : some_of<std::size_t>({5, 2, 9})) {
    const int limit = static_cast<int>(largest * share / 10 / 1024) + 1;
    CAPTURE(limit);
    const ProgramResult result = run_limited(limit, command + " -o " + before.output());
    CAPTURE(result.output);
    CHECK(result.exit_code == 1);
    CHECK(contains(result.output, "error: "));
    for (const auto& [path, content] : before.files) {
      CAPTURE(path.string());
      const std::string now = read_file(path);
      CHECK(is_whole(path, now));
      if (path.extension() == ".mat") CHECK(now.size() == content.size());
    }
    for (const auto& entry : fs::recursive_directory_iterator(before.output()))
      CHECK(!contains(entry.path().string(), ".part"));
  }
}

bool has_gnuplot() { return run_program("gnuplot --version").exit_code == 0; }

}  // namespace

TEST_CASE("a full disk: MAT files are whole, or the command fails") {
  check_full_disk("simulate --duration 3 --mat --quiet");
  check_full_disk("export --to tables --parameters spencer1997 --quiet");
}

TEST_CASE("a full disk: figures are whole, or the command fails" * doctest::test_suite("long")) {
  if (!has_gnuplot()) return;
  check_full_disk("simulate --duration 3 --figures --quiet");
}

TEST_CASE("a full disk ends a sweep with an error, not a crash, and its tables stay whole" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string sweep = "sweep comfort --samples 8 --duration 6 --quiet";
  const std::string out = (folder.path() / "out").string();
  REQUIRE(run_dashpot(sweep + " -o " + out).exit_code == 0);
  const std::string earlier = read_file(fs::path(out) / "sweep.h5");
  for (const int limit : some_of<int>({60, 24, 100})) {
    const ProgramResult result = run_limited(limit, sweep + " -o " + out);
    CAPTURE(result.output);
    CHECK(result.exit_code == 1);
    CHECK(contains(result.output, "cannot be written: "));
    CHECK(read_file(fs::path(out) / "sweep.h5") == earlier);
  }
}

TEST_CASE("links at the names of results and of temporaries lead nowhere") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", victim = folder.write("victim", "precious");
  fs::create_directory(out);
  for (const char* name : {"trace.mat", "trace.mat.part", "sweep.h5.partial"})
    fs::create_symlink(victim, out / name);
  CHECK(run_dashpot("simulate --duration 1 --mat --quiet -o " + out.string()).exit_code == 0);
  CHECK(read_file(victim) == "precious");
  CHECK(!fs::is_symlink(out / "trace.mat"));
}

TEST_CASE("options that would take for ever are refused with what they would cost" *
          doctest::test_suite("long")) {
  const auto check = [](const std::string& command, const std::string& why) {
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult result = run_program("timeout 20 " + program_path() + " " + command);
    CAPTURE(command);
    CAPTURE(result.output);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));
    CHECK((result.exit_code == 1 || result.exit_code == 2));
    CHECK(contains(result.output, why));
  };
  check("simulate --max-step 1e-300", "steps, hours of work");
  check("simulate --duration 1e300", "samples, more than a memory holds");
  check("simulate --tolerance 1e-300", "a tolerance is not above 0");
  check("ride --frequencies 1e-300,1e300", "vehicles answer between");
  check("ride --held 1e9", "held currents are as many rides");
  check("search mlp_one_sensor " + small_campaign().string() + " --method grid --steps 1e9", "");
}

TEST_CASE("results that cannot be meant are said first, and exit 3") {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const ProgramResult bench = run_dashpot("bench --levels 1e308 -o " + out);
  CAPTURE(bench.output);
  CHECK(bench.exit_code == 3);
  CHECK(bench.output.starts_with("error: the damper gives no finite force"));
  CHECK(!fs::exists(out));
}

// Sanitizers need memory of their own.
TEST_CASE("too little memory is an error of the input, not an abort" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  std::string json = "[0";
  for (int k = 0; k < 1'900'000; ++k) json += ",0";
  const fs::path path = folder.write("large.json", json + "]");
  const ProgramResult result = run_program("( ulimit -v 210000; " + program_path() + " evaluate " +
                                           path.string() + " " + small_campaign().string() + " )");
  CAPTURE(result.output);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "out of memory"));
}

// With sanitizers that moment is longer.
TEST_CASE("an interruption ends any work within a moment, reading included" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  std::string rows = "t [s],x [mm],F [N]\n";
  for (int k = 0; k < 400'000; ++k) rows += std::to_string(0.001 * k) + ",1,2\n";
  const fs::path path = folder.write("long.csv", rows);
  const ProgramResult result =
      run_program("( " + program_path() + " identify " + path.string() +
                  " --models narx_one_sensor -o " + (folder.path() / "out").string() +
                  " & job=$!; sleep 0.4; begin=$(date +%s%N); kill -INT $job; wait $job; code=$?; "
                  "echo \"took $(( ($(date +%s%N) - begin) / 1000000 )) ms\"; exit $code )");
  CAPTURE(result.output);
  CHECK((result.exit_code == 130 || result.exit_code == 1));
  const std::size_t at = result.output.find("took ");
  REQUIRE(at != std::string::npos);
  CHECK(std::stoi(result.output.substr(at + 5)) < 600);  // 300 on a machine with nothing else to do
}
