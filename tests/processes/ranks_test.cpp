#include <filesystem>

#include "cli/program.h"
#include "dashpot/base/file.h"

using namespace dashpot;
namespace fs = std::filesystem;

// The commands that share their work under mpirun. Without Open MPI these tests say so and pass.
namespace {

bool has_mpi() {
  const bool there = fs::exists(fs::path(program_path()).parent_path() / "dashpot-mpi.so") &&
                     run_program("command -v mpirun").exit_code == 0;
  if (!there) MESSAGE("skipped: libopenmpi-dev or openmpi-bin is missing");
  return there;
}

std::string mpirun(const std::string& ranks) {
  return "mpirun --allow-run-as-root --oversubscribe -n " + ranks + ' ';
}

/// The command alone and on 4 ranks: `file` of its results has the same bytes.
void check_same_bits(const std::string& command, const std::string& file) {
  const TemporaryFolder folder;
  CAPTURE(command);
  const auto at = [&](const std::string& name) {
    return " --output " + (folder.path() / name).string();
  };
  const ProgramResult alone = run_dashpot(command + at("alone"));
  REQUIRE_MESSAGE(alone.exit_code == 0, alone.output);
  const ProgramResult shared =
      run_program(mpirun("4") + program_path() + ' ' + command + at("shared"));
  REQUIRE_MESSAGE(shared.exit_code == 0, shared.output);
  CHECK(read_file(folder.path() / "shared" / file) == read_file(folder.path() / "alone" / file));
}

std::string small_line(const TemporaryFolder& folder) {
  const std::string line = (folder.path() / "line").string();
  const ProgramResult made = run_dashpot(
      "bench --dampers 60 --damper vrths_mr_tanh_kwok --motions 10x2,10x4 --levels 0,1 "
      "--cycles 2 --sample-rate 200 --output " +
      line);
  REQUIRE_MESSAGE(made.exit_code == 0, made.output);
  return line;
}

}  // namespace

TEST_CASE("mpirun: rank, search, sweep and identify-many find what one process finds, to the bit") {
  if (!has_mpi()) return;
  const std::string data = small_campaign().string();
  const TemporaryFolder folder;
  check_same_bits("rank " + data + " --models bingham,tanh_kwok", "report.csv");
  check_same_bits("search " + data + " --over hidden=3,4 --method grid --network epochs=3",
                  "search.csv");
  check_same_bits("sweep comfort --duration 6 --samples 70", "rides.csv");
  check_same_bits("identify-many " + small_line(folder) + " --models tanh_kwok", "dampers.csv");
}

TEST_CASE("mpirun: a worker that is ahead of slower ones in the next piece of work is waited for") {
  if (!has_mpi()) return;
  const TemporaryFolder folder;
  // The five dampers of the pilot are one piece, the sixty the next: three ranks begin at once.
  const std::string command = program_path() + " identify-many " + small_line(folder) +
                              " --models tanh_kwok --pilot 5 --threads 1 --output ";
  for (const char* night : {"first", "second"}) {
    const ProgramResult result =
        run_program(mpirun("8") + command + (folder.path() / night).string());
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    // What a worker looks up of the pilot is no result of an earlier run.
    CHECK(result.output.find("kept from before") == std::string::npos);
  }
}

TEST_CASE("mpirun: a rank that is killed ends the job; the same command goes on") {
  if (!has_mpi()) return;
  const TemporaryFolder folder;
  const std::string command = program_path() + " identify-many " + small_line(folder) +
                              " --models tanh_kwok --pilot 0 --threads 1 --output ";
  REQUIRE(run_program(command + (folder.path() / "alone").string()).exit_code == 0);

  // The last child of mpirun is a worker, the first is rank 0, which has the store. It is killed as
  // soon as there are rows in that: what is written since its start lies in a file beside it.
  for (const char* which : {"tail", "head"}) {
    const std::string night = (folder.path() / which).string();
    const std::string wait_for_rows =
        "for wait in $(seq 4000); do [ \"$(stat -c %s " + night +
        "/production.sqlite-wal)\" -gt 60000 ] && break; sleep 0.005; done 2> /dev/null; ";
    const ProgramResult killed =
        run_program("( " + mpirun("3") + command + night + " & job=$!; " + wait_for_rows +
                    "kill -KILL $(pgrep -P $job | " + which + " -n 1); wait $job )");
    CAPTURE(killed.output);
    CHECK(killed.exit_code != 0);

    const ProgramResult after = run_program(mpirun("2") + command + night);
    CAPTURE(after.output);
    CHECK(after.exit_code == 0);
    CHECK(after.output.find("kept from before") != std::string::npos);
    CHECK(read_file(fs::path(night) / "dampers.csv") ==
          read_file(folder.path() / "alone/dampers.csv"));
  }
}

TEST_CASE("mpirun: other work, other commands and what cannot be shared are refused once") {
  if (!has_mpi()) return;
  const TemporaryFolder folder;
  const auto count_of = [](const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++count;
    return count;
  };

  // Two ranks that were told to do unlike things.
  const std::string rank = program_path() + " rank " + small_campaign().string() + " --output " +
                           folder.path().string() + " --models ";
  const ProgramResult unlike =
      run_program(mpirun("1") + rank + "bingham : -n 1 " + rank + "arctan");
  CAPTURE(unlike.output);
  CHECK(unlike.exit_code != 0);
  CHECK(count_of(unlike.output, "rank 1: has other recordings") == 1);

  const ProgramResult other = run_program(mpirun("2") + program_path() + " models");
  CAPTURE(other.output);
  CHECK(other.exit_code == 2);
  CHECK(count_of(other.output, "does not share its work among the processes of mpirun") == 1);
  const ProgramResult halving =
      run_program(mpirun("2") + program_path() + " search " + small_campaign().string() +
                  " --over hidden=3:30 --method halving --output " + folder.path().string());
  CHECK(count_of(halving.output, "halving is not shared among processes") == 1);
}
