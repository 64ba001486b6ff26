#include <chrono>
#include <filesystem>

#include <sys/resource.h>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/record/mat_bytes.h"
#include "program.h"
#include "record/readers/example_hdf5.h"
#include "record/readers/example_mdf4.h"
#include "record/readers/example_tdms.h"
#include "record/readers/example_workbook.h"

using dashpot::Random;

// Every format of recordings, damaged in every way: the program reads it or says what is wrong,
// within the memory and the time that anybody has.

namespace {

constexpr double kMostSeconds = 10;
constexpr long kMostMemory = 1 << 20;  // KiB

struct Recording {
  std::string name, bytes;
};

std::string csv_recording() {
  std::string text = "t_s;x_mm;F_N\n";
  for (int k = 0; k < 60; ++k)
    text += std::to_string(0.01 * k) + ';' + std::to_string(k % 7) + ';' +
            std::to_string(40 * (k % 5)) + '\n';
  return text;
}

std::string daq_recording() {
  std::string text = "Time\tDisp\tForce\nsec\tmm\tN\n";
  for (int k = 0; k < 60; ++k)
    text += std::to_string(0.01 * k) + '\t' + std::to_string(k % 7) + '\t' + std::to_string(k % 5) +
            '\n';
  return text;
}

std::string mat_recording() {
  std::vector<double> t, x, force;
  for (int k = 0; k < 60; ++k)
    t.push_back(0.01 * k), x.push_back(0.001 * (k % 7)), force.push_back(40 * (k % 5));
  return dashpot::mat_bytes({{.name = "t_s", .rows = 60, .columns = 1, .values = t},
                             {.name = "x_m", .rows = 60, .columns = 1, .values = x},
                             {.name = "F_N", .rows = 60, .columns = 1, .values = force}});
}

/// Deflated in chunks, with units.
std::string hdf5_recording() {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "run.h5";
  std::vector<double> t, x, force;
  for (int k = 0; k < 60; ++k) {
    t.push_back(0.01 * k);
    x.push_back(k % 7);
    force.push_back(40 * (k % 5));
  }
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  write_hdf5_dataset(file, "time", H5T_NATIVE_DOUBLE, t.data(), 60, 1, "s");
  write_hdf5_dataset(file, "displacement", H5T_NATIVE_DOUBLE, x.data(), 60, 1, "mm");
  write_hdf5_dataset(file, "force", H5T_NATIVE_DOUBLE, force.data(), 60, 1, "N");
  H5Fclose(file);
  return dashpot::read_file(path);
}

std::vector<Recording> recordings() {
  return {{"run.csv", csv_recording()},
          {"run.txt", daq_recording()},
          {"run.mat", mat_recording()},
          {"run.h5", hdf5_recording()},
          {"plain.mf4", example_mdf4(0)},
          {"packed.mf4", example_mdf4(3)},
          {"run.tdms", example_tdms(false, false)},
          {"daqmx.tdms", example_tdms_daqmx()},
          {"run.xlsx", example_recording_workbook()}};
}

/// The same damage in every test run: three cuts, three files with flipped bits, four with a length
/// or a number that lies.
std::vector<std::string> damaged(const std::string& whole) {
  std::vector<std::string> all;
  for (const double share : {0.1, 0.5, 0.95})
    all.push_back(whole.substr(0, static_cast<std::size_t>(share * double(whole.size()))));
  Random random(5);
  const auto place = [&](std::size_t room) {
    return static_cast<std::size_t>(random.uniform() * double(whole.size() - room));
  };
  for (int k = 0; k < 3; ++k) {
    all.push_back(whole);
    for (int flips = 0; flips < 4; ++flips)
      all.back()[place(0)] ^= static_cast<char>(1 << int(8 * random.uniform()));
  }
  for (const std::string& lie : {std::string(8, '\xFF'), std::string(8, '\x7F'),
                                 std::string("\x00\x00\x00\x40", 4), std::string("99999999")}) {
    all.push_back(whole);
    all.back().replace(place(lie.size()), lie.size(), lie);
  }
  return all;
}

/// Reads it or says why not, and is done in time.
void check_inspected(const std::filesystem::path& file) {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult result = run_dashpot("inspect '" + file.string() + "'");
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  CAPTURE(result.output);
  CHECK((result.exit_code == 0 || result.exit_code == 1));
  if (result.exit_code == 1) CHECK(contains(result.output, "error: "));
  CHECK(taken.count() < kMostSeconds);
}

}  // namespace

TEST_CASE("every format of recordings, damaged in any way, is read or refused within its budget" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  for (const Recording& recording : recordings()) {
    CAPTURE(recording.name);
    const auto file = folder.write(recording.name, recording.bytes);
    const ProgramResult whole = run_dashpot("inspect '" + file.string() + "'");
    CAPTURE(whole.output);
    CHECK(whole.exit_code == 0);
    for (const std::string& bytes : damaged(recording.bytes))
      check_inspected(folder.write(recording.name, bytes));
  }

  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  CHECK(used.ru_maxrss < kMostMemory);
}

TEST_CASE("a file that ends HDF5 is an error of the file") {
  const TemporaryFolder folder;
  const auto file = folder.write("run.h5", without_chunk_sides(hdf5_recording()));
  const ProgramResult result = run_dashpot("inspect '" + file.string() + "'");
  CAPTURE(result.output);
  CHECK(result.exit_code == 1);
  CHECK(result.output.starts_with("error: " + file.string() + ": "));
}

TEST_CASE("Ctrl-C ends a command while a file of HDF5 is being read") {
  const TemporaryFolder folder;
  const auto file = folder.write("run.h5", hdf5_recording());
  const auto reader =
      folder.write("dashpot-hdf5", "#!/bin/sh\necho $$ >\"$0.pid\"\nexec sleep 100");
  std::filesystem::permissions(reader, std::filesystem::perms::owner_all);
  const auto begin = std::chrono::steady_clock::now();
  const std::string pid = reader.string() + ".pid";
  const ProgramResult result = run_program(
      "( export DASHPOT_PROGRAMS=" + folder.path().string() + "; " + program_path() + " inspect " +
      file.string() + " & until [ -s " + pid + " ]; do sleep 0.1; done; kill -INT $!; wait $!; " +
      "code=$?; kill -9 $(cat " + pid + "); exit $code )");
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  CAPTURE(result.output);
  CHECK(result.exit_code == 130);
  CHECK(contains(result.output, "interrupted"));
  CHECK(taken.count() < 60);
}

TEST_CASE("a packed recording without end is refused within its budget" *
          doctest::test_suite("long")) {
  // Little that unpacks to 1 GB of a text: a packed part, 64 times.
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.csv.gz";
  const ProgramResult made = run_program(
      "cd '" + folder.path().string() +
      "' && head -c 16M /dev/zero | tr '\\0' '1' | gzip -1 > part && "
      "(printf 't_s,x_mm,F_N\\n' | gzip; for k in $(seq 64); do cat part; done) > run.csv.gz");
  REQUIRE(made.exit_code == 0);
  check_inspected(file);
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  CHECK(used.ru_maxrss < kMostMemory);
}
