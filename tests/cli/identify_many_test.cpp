#include <algorithm>
#include <filesystem>
#include <set>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "program.h"
#include "sanitized.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

constexpr int kDampers = kSanitized ? 30 : 120, kLeastFaulty = kSanitized ? 1 : 5;

/// A virtual line, made once: 8 % of its dampers have faults, and the recording of one more is
/// damaged.
const fs::path& virtual_line() {
  static const TemporaryFolder folder;
  static const fs::path path = [] {
    const fs::path line = folder.path() / "line";
    const ProgramResult made =
        run_dashpot("bench --dampers " + std::to_string(kDampers) +
                    " --faults 0.08 --damper vrths_mr_tanh_kwok --motions 10x2,10x4 "
                    "--levels 0,1 --cycles 2 --sample-rate 200 --output " +
                    line.string());
    REQUIRE_MESSAGE(made.exit_code == 0, made.output);
    write_file(line / "unit-000999/broken.csv", "t_s,x_mm,F_N\n0,1\nnonsense\n");
    return line;
  }();
  return path;
}

std::string many_command(const std::string& rest) {
  return "identify-many " + virtual_line().string() + " --models tanh_kwok " + rest;
}

/// The dampers in the first column of the lines that `chosen` takes.
template <class Chosen>
std::set<std::string> dampers_in(const fs::path& csv, const Chosen& chosen) {
  std::set<std::string> names;
  for (const std::string& line : split(read_file(csv), '\n'))
    if (line.starts_with("unit-") && chosen(line)) names.insert(split(line, ',').front());
  return names;
}

}  // namespace

TEST_CASE(
    "identify-many: planted faults are found, sound dampers are not named, a bad one is a row" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string night = (folder.path() / "night").string();
  const ProgramResult result = run_dashpot(many_command("--output " + night));
  CAPTURE(result.output);
  CHECK(result.exit_code == 4);  // a damper could not be read
  CHECK(contains(result.output, std::to_string(kDampers + 1) + " dampers: " +
                                    std::to_string(kDampers) + " with a result, 1 without"));
  CHECK(contains(read_file(fs::path(night) / "report.md"), "broken.csv"));

  const auto faulty = dampers_in(virtual_line() / "faults.csv", [](auto&) { return true; });
  const auto named = dampers_in(fs::path(night) / "dampers.csv", [](const std::string& line) {
    return contains(line, ",stands out,");
  });
  std::size_t found = 0;
  for (const std::string& name : faulty) found += named.contains(name);
  MESSAGE("recall ", found, " of ", faulty.size(), ", false alarms ", named.size() - found, " of ",
          kDampers - faulty.size());
  CHECK(faulty.size() >= kLeastFaulty);
  CHECK(found == faulty.size());
  CHECK(named.size() - found <= 1);
  const auto lost = dampers_in(fs::path(night) / "dampers.csv", [](const std::string& line) {
    return contains(line, ",no result,");
  });
  CHECK(lost == std::set<std::string>{"unit-000999"});
}

TEST_CASE("identify-many: the same rows with one thread, in parts, and after an interruption" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  const auto table = [&](const char* name) {
    return read_file(folder.path() / name / "dampers.csv");
  };
  REQUIRE(run_dashpot(many_command("--threads 1 --output " + at("one"))).exit_code == 4);

  // In parts that know nothing of each other.
  for (const char* part : {"1/2", "2/2"})
    REQUIRE(run_dashpot(many_command(std::string("--part ") + part + " --output " +
                                     at(part[0] == '1' ? "part1" : "part2")))
                .exit_code == 0);
  const ProgramResult merged =
      run_dashpot("merge " + at("part1") + ' ' + at("part2") + " --output " + at("joined"));
  CAPTURE(merged.output);
  CHECK(contains(merged.output, "129 results from 2 stores; 8 found more than once, and alike"));
  const ProgramResult after = run_dashpot(many_command("--output " + at("joined")));
  CHECK(contains(after.output, "121 kept from before"));
  CHECK(table("joined") == table("one"));

  // Stopped on the way, then the same command.
  run_program("timeout -s KILL 0.7 " + program_path() + ' ' +
              many_command("--output " + at("killed")));
  REQUIRE(run_dashpot(many_command("--output " + at("killed"))).exit_code == 4);
  CHECK(table("killed") == table("one"));

  // A damper whose recordings have changed is fitted again, others are not.
  const fs::path changed = virtual_line() / "unit-000999/broken.csv";
  const std::string before = read_file(changed);
  write_file(changed, before + "more nonsense\n");
  CHECK(
      contains(run_dashpot(many_command("--output " + at("one"))).output, "120 kept from before"));
  write_file(changed, before);
}

TEST_CASE("identify-many says what would be right" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& arguments, int code) {
    const ProgramResult result =
        run_dashpot("identify-many " + arguments + " --output " + (folder.path() / "out").string());
    CHECK(result.exit_code == code);
    return result.output;
  };
  const std::string line = virtual_line().string();
  CHECK(contains(says(line + "/none", 1), "is no folder"));
  CHECK(contains(says(line + " --models usual", 2), "stands for many models"));
  CHECK(contains(says(line + " --false-alarms 0", 2), "must lie between 0 and 0.5"));
  fs::create_directories(folder.path() / "bad/unit-1");
  CHECK(contains(says((folder.path() / "bad").string(), 1), "no damper gives a model"));
}
