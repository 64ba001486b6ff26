#include "dashpot/record/readers/hdf5.h"

#include <algorithm>
#include <cmath>

#include <hdf5.h>

#include "arrays_in_process.h"
#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "example_hdf5.h"
#include "hdf5_arrays.h"
#include "support.h"

using namespace dashpot;

namespace {

// Files that are damaged on purpose may be left open by HDF5, and its exit handler would go round
// and round closing them. dashpot-hdf5 leaves without it, too.
[[maybe_unused]] const herr_t kNoExitHandler = H5dont_atexit();

}  // namespace

TEST_CASE("HDF5: groups are recordings, datasets columns, attributes units") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "day.h5";
  write_example_hdf5(path, {"at 0.5A", "at 1A"});
  const auto tables = read_tables(path);
  REQUIRE(tables.size() == 2);
  CHECK(tables[0].place().ends_with("day.h5, group 'at 0.5A'"));
  REQUIRE(tables[1].columns.size() == 4);
  for (const RawColumn& column : tables[1].columns) {
    REQUIRE(column.values.size() == 40);
    if (column.name == "t") CHECK(column.values[39] == 0.01 * 39);
    if (column.name == "x") CHECK(column.unit == "mm");
    if (column.name == "F(1)") CHECK(column.values[3] == 3);
    if (column.name == "F(2)") CHECK(column.values[3] == double(0.1f));
  }
  REQUIRE(tables[1].scalars.size() == 1);
  CHECK(tables[1].scalars[0].second == 7);
  REQUIRE(tables[1].notes.size() == 1);
  CHECK(tables[1].notes[0] == "dataset 'at 1A/words' passed over: it holds no plain numbers");
}

TEST_CASE("HDF5: numbers packed with a scale and an offset are unpacked") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "packed.h5";
  write_example_hdf5(path, {"a"});
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
              set = H5Dopen2(file, "a/x", H5P_DEFAULT), one = H5Screate(H5S_SCALAR);
  for (const auto& [name, value] :
       {std::pair{"scale_factor", 0.5}, {"add_offset", 10.0}, {"_FillValue", 5.0}}) {
    const hid_t attribute = H5Acreate2(set, name, H5T_NATIVE_DOUBLE, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
  }
  H5Sclose(one), H5Dclose(set), H5Fclose(file);
  const std::vector<RawTable> tables = read_tables(path);
  for (const RawColumn& column : tables.front().columns)
    if (column.name == "x") {
      CHECK(column.values[3] == 11.5);
      CHECK(std::isnan(column.values[5]));  // not measured
    }
}

TEST_CASE("HDF5: a number that is an attribute of a group is as good as one in a dataset") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "day.h5";
  write_example_hdf5(path, {"first", "second"});
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), one = H5Screate(H5S_SCALAR);
  for (const auto& [name, current] : {std::pair{"first", 0.25}, {"second", 1.0}}) {
    const hid_t group = H5Gopen2(file, name, H5P_DEFAULT);
    const hid_t attribute =
        H5Acreate2(group, "current_A", H5T_NATIVE_DOUBLE, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, &current);
    H5Aclose(attribute), H5Gclose(group);
  }
  H5Sclose(one), H5Fclose(file);
  const std::vector<RawTable> tables = read_tables(path);
  REQUIRE(tables.size() == 2);
  for (const RawTable& table : tables) {
    CHECK(table.columns.size() == 4);
    CHECK(std::ranges::count(table.scalars,
                             std::pair<std::string, double>(
                                 "current_A", table.part_name == "first" ? 0.25 : 1.0)) == 1);
  }
}

TEST_CASE("HDF5: what is damaged, elsewhere or far too large is refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.h5";
  write_example_hdf5(path, {"a"});
  const std::string whole = read_file(path);
  for (const std::size_t size : {whole.size() / 4, whole.size() / 2, whole.size() - 9})
    CHECK_THROWS_AS(read_tables(folder.write("cut.h5", whole.substr(0, size))), Error);

  // A dataset, a chunk, of more numbers than the file can have; more chunks than it can list.
  constexpr std::pair<hsize_t, hsize_t> kBombs[] = {
      {1'000'000'000, 1000}, {10, 100'000'000}, {5'000'000, 1}};
  for (const auto& [extent, chunk] : kBombs) {
    const auto bomb = folder.path() / "bomb.h5";
    const hid_t file = H5Fcreate(bomb.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hsize_t limit = H5S_UNLIMITED;
    const hid_t space = H5Screate_simple(1, &extent, &limit);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 1, &chunk);
    H5Pset_deflate(creation, 9);
    const hid_t set =
        H5Dcreate2(file, "F", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dclose(set), H5Pclose(creation), H5Sclose(space), H5Fclose(file);
    CHECK_THROWS_WITH_AS(read_tables(bomb), doctest::Contains("unpacks to far more"), Error);
  }

  // A dataset whose extent lost its sides, and its chunks did not: HDF5 would count chunks for
  // ever.
  const char extent_of_force[] = {1, 2, 1, 0, 0, 0, 0, 0, 40, 0, 0, 0, 0, 0, 0, 0, 2};
  const std::size_t at = whole.find(std::string(extent_of_force, sizeof extent_of_force));
  REQUIRE(at != std::string::npos);
  std::string scalar = whole;
  scalar[at + 1] = 0;
  CHECK_THROWS_WITH_AS(read_tables(folder.write("scalar.h5", scalar)),
                       doctest::Contains("of its chunks cannot be"), Error);

  // A chunk that is longer than the column: HDF5 would read behind what it unpacks to.
  const char chunk_of_force[] = {40, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0};
  const std::size_t chunk = whole.find(std::string(chunk_of_force, sizeof chunk_of_force));
  REQUIRE(chunk != std::string::npos);
  for (const std::size_t byte : {std::size_t{1}, std::size_t{5}}) {
    std::string longer = whole;
    longer[chunk + byte] = 1;
    CHECK_THROWS_WITH_AS(read_tables(folder.write("longer.h5", longer)),
                         doctest::Contains("of its chunks cannot be"), Error);
  }

  // A number of 32 MiB, and numbers whose bits lie beside them: HDF5 would read behind its buffer.
  const std::string real("\x08\0\0\0\0\0\x40\0\x34\x0b\0\x34", 12);
  const std::string integer("\x10\x08\0\0\x02\0\0\0\0\0\x10\0", 12);
  struct {
    std::string type;
    std::size_t byte;
    char value;
  } const damages[] = {{real, 3, 2}, {real, 11, 99}, {integer, 10, 0}, {integer, 11, 16}};
  for (const auto& damage : damages) {
    std::string damaged = whole;
    const std::size_t type = damaged.find(damage.type);
    REQUIRE(type != std::string::npos);
    damaged[type + damage.byte] = damage.value;
    CHECK_THROWS_WITH_AS(read_tables(folder.write("damaged.h5", damaged)),
                         doctest::Contains("of its numbers and"), Error);
  }

  // Numbers of another file.
  const auto link = folder.path() / "link.h5";
  const hid_t file = H5Fcreate(link.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_external("run.h5", "/a/t", file, "t", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  CHECK_THROWS_WITH_AS(read_tables(link), doctest::Contains("from other files"), Error);
}

// In this process, where sanitizers watch.
TEST_CASE("HDF5: flipped bytes are read or refused, and nothing else") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.h5";
  write_example_hdf5(path, {"a"});
  const std::string whole = read_file(path);
  Random random(17);
  for (int k = 0; k < 200; ++k) {
    std::string bytes = whole;
    for (int flips = 0; flips < 3; ++flips)
      bytes[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] ^=
          static_cast<char>(1 << int(8 * random.uniform()));
    try {
      hdf5_tables(arrays_of(hand_over_hdf5, folder.write("flipped.h5", bytes)), "flipped.h5");
    } catch (const Error&) {
    }
  }
}
