#include "dashpot/report/column_table.h"

#include <cmath>
#include <csignal>
#include <limits>

#include <hdf5.h>
#include <sys/resource.h>

#include "dashpot/base/file.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

ColumnTable example() {
  return {"rides",
          "some rides",
          {{"controller", "1", "what drives", {}, {"passive", "sky,\"hook\""}},
           {"sprung_mass", "kg", "body", {400.1, std::nextafter(1.0, 2.0)}},
           {"diverged_at", "s", "when", {std::numeric_limits<double>::quiet_NaN(), 1e-300}}}};
}

/// What HDF5 itself reads.
std::vector<double> numbers_in(const fs::path& path, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(file >= 0);
  const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
  return values;
}

/// The first text of a dataset, or of an attribute of it.
std::string text_in(const fs::path& path, const std::string& name,
                    const char* attribute = nullptr) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Oopen(file, name.c_str(), H5P_DEFAULT);
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  char* texts[2] = {};
  if (attribute) {
    const hid_t there = H5Aopen(set, attribute, H5P_DEFAULT);
    CHECK(H5Aread(there, type, texts) >= 0);
    H5Aclose(there);
  } else {
    CHECK(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts) >= 0);
  }
  std::string text = texts[0] ? texts[0] : "";
  for (char* one : texts) H5free_memory(one);
  H5Tclose(type);
  H5Oclose(set);
  H5Fclose(file);
  return text;
}

}  // namespace

TEST_CASE("a table as CSV keeps all digits, units in its titles, nothing where there is nothing") {
  CHECK(csv_table(example()) ==
        "controller,sprung_mass[kg],diverged_at[s]\n"
        "passive,400.1,\n"
        "\"sky,\"\"hook\"\"\",1.0000000000000002,1e-300\n");
}

TEST_CASE("a table as HDF5 comes back bit for bit, with units") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "deep" / "sweep.h5";
  const ColumnTable table = example();
  write_hdf5(file, {table}, {{"command", "dashpot sweep"}});
  CHECK(numbers_in(file, "rides/sprung_mass") == table.columns[1].numbers);
  const std::vector<double> diverged = numbers_in(file, "rides/diverged_at");
  CHECK(std::isnan(diverged[0]));
  CHECK(diverged[1] == 1e-300);
  CHECK(text_in(file, "rides/controller") == "passive");
  CHECK(text_in(file, "rides/sprung_mass", "unit") == "kg");
  CHECK(text_in(file, "rides/sprung_mass", "meaning") == "body");
  CHECK(text_in(file, "rides", "title") == "some rides");
  CHECK(text_in(file, "/", "command") == "dashpot sweep");

  write_hdf5(folder.path() / "again.h5", {table}, {{"command", "dashpot sweep"}});
  CHECK(read_file(file) == read_file(folder.path() / "again.h5"));
}

TEST_CASE("an empty table is written, a folder in place of the file is told") {
  const TemporaryFolder folder;
  write_hdf5(folder.path() / "empty.h5", {{"ratios", "none", {{"mean", "1", "", {}}}}}, {});
  CHECK(numbers_in(folder.path() / "empty.h5", "ratios/mean").empty());
  fs::create_directory(folder.path() / "taken");
  const std::string message =
      message_of([&] { write_hdf5(folder.path() / "taken", {example()}, {}); });
  CHECK(message.find("cannot be written") != std::string::npos);
  CHECK(!fs::exists(folder.path() / "taken.partial"));
}

TEST_CASE("a disk that fills up under HDF5 leaves the old file, and nothing to crash on at exit") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "sweep.h5";
  write_hdf5(file, {example()}, {});
  const std::string before = read_file(file);
  ColumnTable large = example();
  for (DataColumn& column : large.columns)
    if (!column.is_text()) column.numbers.resize(50000);
  std::erase_if(large.columns, [](const DataColumn& column) { return column.is_text(); });

  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100'000, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] { write_hdf5(file, {large}, {}); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  CHECK(contains(message, "cannot be written: File too large"));
  CHECK(read_file(file) == before);
}
