#include <chrono>
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

std::string sweep_of(const std::string& options) {
  return "sweep comfort --duration 6 --threads 1 " + options;
}

}  // namespace

TEST_CASE("sweep: a table, a page, rides as CSV and HDF5; more samples go on from there") {
  const TemporaryFolder folder;
  const std::string output = " --output " + folder.path().string();
  const ProgramResult result = run_dashpot(sweep_of("--samples 10" + output));
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  for (const char* part :
       {"sweep: 10 vehicles, 3 controllers each", "Against passive", "Weighted acceleration",
        "What matters", "sprung_mass", "30 rides in", "uniform, 320 ... 520 kg"})
    CHECK_MESSAGE(contains(result.output, part), part);
  for (const char* file : {"sweep.sqlite", "report.html", "report.json", "report.md", "rides.csv",
                           "quantiles.csv", "ratios.csv", "correlations.csv", "sweep.h5"})
    CHECK_MESSAGE(fs::exists(folder.path() / file), file);
  CHECK(split(read_file(folder.path() / "rides.csv"), '\n').size() == 32);
  const std::string first = read_file(folder.path() / "rides.csv");

  const ProgramResult more = run_dashpot(sweep_of("--samples 20 --json" + output));
  CHECK(contains(more.output, "60 rides in"));
  CHECK(contains(more.output, "; 30 kept from before"));
  CHECK(read_file(folder.path() / "rides.csv").starts_with(first));

  const ProgramResult other = run_dashpot(sweep_of("--seed 2" + output));
  CHECK(other.exit_code == 1);
  CHECK(contains(other.output, "holds another sweep (seed: '1' there, '2' here)"));
  CHECK(run_dashpot(sweep_of("--samples 2 --seed 2 --fresh" + output)).exit_code == 0);
}

TEST_CASE("sweep: a program for its tables that does not run is told before anything rides") {
  const TemporaryFolder folder;
  const fs::path broken = folder.write("dashpot-hdf5", "#!/bin/sh\nexit 3\n");
  fs::permissions(broken, fs::perms::owner_all);
  const ProgramResult result =
      run_dashpot(sweep_of("--samples 2 --output " + (folder.path() / "out").string()),
                  "env DASHPOT_PROGRAMS=" + folder.path().string());
  CAPTURE(result.output);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "dashpot-hdf5: did not make the file: it ended with status 3"));
  CHECK(!fs::exists(folder.path() / "out" / "sweep.sqlite"));
}

TEST_CASE(
    "sweep: killed at random moments, it goes on, and the tables are the same to the last bit" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const fs::path whole = folder.path() / "whole", resumed = folder.path() / "resumed";
  const std::string request = "sweep comfort --duration 6 --samples 200 --threads 2 --output ";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(run_dashpot(request + whole.string()).exit_code == 0);
  double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Random random(
      static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()));
  int kills = 0;
  for (int run = 0; run < 30 && kills < 3; ++run) {
    const std::string moment = format_exact(random.uniform(0.2, 0.6) * seconds);
    const int code = run_program("timeout -s KILL " + moment + " " + program_path() + " " +
                                 request + resumed.string())
                         .exit_code;
    REQUIRE((code == 137 || code == 0));
    kills += code == 137;
    if (code == 137) continue;
    if (kills > 0) break;

    // It has ended before it could be killed, on a machine that others leave alone by now.
    seconds /= 2;
    fs::remove_all(resumed);
  }
  MESSAGE(kills << " kills");
  CHECK(kills > 0);
  const ProgramResult last = run_dashpot(request + resumed.string());
  CAPTURE(last.output);
  CHECK(last.exit_code == 0);
  for (const char* table : {"rides.csv", "quantiles.csv", "ratios.csv", "correlations.csv"})
    CHECK_MESSAGE(read_file(resumed / table) == read_file(whole / table), table);
}

TEST_CASE("sweep: an interruption says what is kept and how to go on" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "log").string();
  const ProgramResult result = run_program(
      "( " + program_path() + " " +
      sweep_of("--samples 1000000 --output " + folder.path().string()) + " > " + log +
      " 2>&1 & job=$!; for k in $(seq 600); do grep -q 'sweep: ' " + log +
      " && break; sleep 0.05; done; sleep 0.3; kill -INT $job; wait $job; code=$?; cat " + log +
      "; exit $code )");
  CAPTURE(result.output);
  CHECK(result.exit_code == 130);
  CHECK(contains(result.output, "the same command goes on from there"));
  CHECK(!fs::exists(folder.path() / "report.html"));
  CHECK(!fs::exists(folder.path() / "sweep.sqlite-wal"));  // closed in order
}

TEST_CASE("sweep: what cannot be swept is told" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const fs::path bad = folder.write(
      "bad.yaml", "plant: savaresi_spelta\nroad: iso8608_fft\nvary:\n  mass: [3 kg]\n");
  const std::pair<std::string, std::string> cases[] = {
      {"", "REQUEST: is missing"},
      {"comfrt", "unknown sweep 'comfrt'; did you mean 'comfort'"},
      {bad.string(), "bad.yaml:4: nothing of a vehicle is known as 'mass'"},
      {"comfort --duration 3", "nothing is left of 3 s"},
      {"comfort --samples 0", "--samples"}};
  for (const auto& [options, part] : cases) {
    const ProgramResult result =
        run_dashpot("sweep " + options + " --output " + (folder.path() / "out").string());
    CAPTURE(result.output);
    CHECK(result.exit_code != 0);
    CHECK_MESSAGE(contains(result.output, part), part);
  }
  CHECK(contains(run_dashpot("sweep --measures").output, "tyre_load_index"));
}
