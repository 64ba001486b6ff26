#include "dashpot/record/readers/mat.h"

#include <cmath>
#include <cstring>
#include <matio.h>

#include <hdf5.h>

#include "arrays_in_process.h"
#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/mat_guard.h"
#include "mat_arrays.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A file of x (3 numbers), F (3 x 2), Ts and a text, written with the MAT library itself.
std::filesystem::path write_mat(const TemporaryFolder& folder, mat_ft version,
                                matio_compression compression) {
  const auto path =
      folder.path() / (std::to_string(version) + "-" + std::to_string(compression) + ".mat");
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  REQUIRE(file);

  double x[] = {1, 2, 3}, force[] = {10, 20, 30, 40, 50, 60}, step[] = {0.01};
  const auto write = [&](const char* name, double* data, std::size_t rows, std::size_t columns) {
    std::size_t dims[] = {rows, columns};
    matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, data, 0);
    Mat_VarWrite(file, variable, compression);
    Mat_VarFree(variable);
  };

  write("x", x, 3, 1);
  write("F", force, 3, 2);
  write("Ts", step, 1, 1);
  Mat_Close(file);
  return path;
}

}  // namespace

TEST_CASE("MAT files of all versions hold the same") {
  const TemporaryFolder folder;
  struct Kind {
    mat_ft version;
    matio_compression compression;
  };
  for (const Kind kind :
       {Kind{MAT_FT_MAT4, MAT_COMPRESSION_NONE}, Kind{MAT_FT_MAT5, MAT_COMPRESSION_NONE},
        Kind{MAT_FT_MAT5, MAT_COMPRESSION_ZLIB}, Kind{MAT_FT_MAT73, MAT_COMPRESSION_NONE}}) {
    const auto path = write_mat(folder, kind.version, kind.compression);
    CAPTURE(path.string());
    const RawTable table = read_mat(path).front();
    REQUIRE(table.columns.size() == 3);
    CHECK(table.rows() == 3);
    for (const RawColumn& column : table.columns) {
      if (column.name == "x") CHECK(column.values == std::vector<double>{1, 2, 3});
      if (column.name == "F(2)") CHECK(column.values == std::vector<double>{40, 50, 60});
    }
    REQUIRE(table.scalars.size() == 1);
    CHECK(table.scalars[0].second == 0.01);
  }
}

TEST_CASE("a Ts or fs whose steps are no seconds of any test is asked about") {
  const TemporaryFolder folder;
  for (const auto& [name, value] : {std::pair{"Ts", 5.0}, {"fs", 0.2}}) {
    const auto path = folder.path() / (std::string(name) + ".mat");
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
    REQUIRE(file);
    std::vector<double> motion;
    for (int k = 0; k < 40; ++k) motion.push_back(0.01 * std::sin(0.3 * k));
    const auto write = [&](const char* variable, std::vector<double> data) {
      std::size_t dims[] = {data.size(), 1};
      matvar_t* array =
          Mat_VarCreate(variable, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, data.data(), 0);
      Mat_VarWrite(file, array, MAT_COMPRESSION_NONE);
      Mat_VarFree(array);
    };
    write("displacement", motion), write("force", motion), write(name, {value});
    Mat_Close(file);
    CHECK(contains(message_of([&] { load_dataset({path}); }),
                   std::string(name) + " has no unit and means steps of 5, which are no seconds"));
  }
}

TEST_CASE("fields of a structure are columns") {
  const TemporaryFolder folder;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const auto path = folder.path() / "struct.mat";
    std::filesystem::remove(path);
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
    REQUIRE(file);
    double force[] = {5, 6, 7, 8};
    std::size_t one[] = {1, 1}, four[] = {4, 1};
    const char* fields[] = {"force", nullptr};
    matvar_t* variable = Mat_VarCreateStruct2("test", 2, one, fields);
    Mat_VarSetStructFieldByName(
        variable, "force", 0,
        Mat_VarCreate("force", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, four, force, 0));
    Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
    Mat_Close(file);
    const RawTable table = read_mat(path).front();
    REQUIRE(table.columns.size() == 1);
    CHECK(table.columns[0].name == "test.force");
    CHECK(table.columns[0].values == std::vector<double>{5, 6, 7, 8});
  }
}

TEST_CASE("a text beside the data of a structure is their unit, and its time is a time") {
  const TemporaryFolder folder;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    const auto path = folder.path() / (std::to_string(version) + ".mat");
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
    REQUIRE(file);
    const auto write = [&](const char* name, const char* unit, double size, bool with_time) {
      std::vector<double> data, time;
      for (int k = 0; k < 40; ++k) {
        time.push_back(0.01 * k);
        data.push_back(size * std::sin(0.3 * k));
      }
      const char* fields[] = {"data", "unit", "time"};
      std::size_t one[] = {1, 1}, many[] = {data.size(), 1}, letters[] = {1, std::strlen(unit)};
      matvar_t* structure = Mat_VarCreateStruct(name, 2, one, fields, with_time ? 3 : 2);
      const auto set = [&](const char* field, matio_classes kind, matio_types type,
                           std::size_t* dims, void* from) {
        Mat_VarSetStructFieldByName(structure, field, 0,
                                    Mat_VarCreate(field, kind, type, 2, dims, from, 0));
      };
      set("data", MAT_C_DOUBLE, MAT_T_DOUBLE, many, data.data());
      set("unit", MAT_C_CHAR, MAT_T_UINT8, letters, const_cast<char*>(unit));
      if (with_time) set("time", MAT_C_DOUBLE, MAT_T_DOUBLE, many, time.data());
      Mat_VarWrite(file, structure, MAT_COMPRESSION_NONE);
      Mat_VarFree(structure);
    };
    write("displacement", "in", 0.4, true);
    write("force", "lbf", 200, false);
    Mat_Close(file);

    const Record record = load_dataset({path}).records.at(0);
    CHECK(record.sample_time == doctest::Approx(0.01));
    CHECK(record.find("displacement")->samples.at(1) ==
          doctest::Approx(0.0254 * 0.4 * std::sin(0.3)));
    CHECK(record.find("force")->samples.at(1) == doctest::Approx(4.4482216 * 200 * std::sin(0.3)));
  }
}

TEST_CASE("a MAT file of cells and arrays of structures says what it holds") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "tests.mat";
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  REQUIRE(file);
  std::size_t size[] = {1, 2}, one[] = {1, 1};
  const char* fields[] = {"force"};
  double number = 1;
  matvar_t* runs = Mat_VarCreateStruct("runs", 2, size, fields, 1);
  for (std::size_t k = 0; k < 2; ++k)
    Mat_VarSetStructFieldByName(
        runs, "force", k, Mat_VarCreate("force", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &number, 0));
  matvar_t* cells[] = {Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &number, 0),
                       Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &number, 0)};
  matvar_t* cell = Mat_VarCreate("all", MAT_C_CELL, MAT_T_CELL, 2, size, cells, 0);
  for (matvar_t* variable : {runs, cell}) {
    Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
  const std::string told = message_of([&] { read_mat(path); });
  CHECK(told.find("variable 'runs' passed over: an array of structures") != std::string::npos);
  CHECK(told.find("variable 'all' passed over: a cell array") != std::string::npos);
}

TEST_CASE("a cut MAT file is refused with its name, at every length") {
  const TemporaryFolder folder;
  for (const matio_compression compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    const std::string bytes = read_file(write_mat(folder, MAT_FT_MAT5, compression));
    const std::size_t sizes[] = {10, 127, 128, 131, 140, 170, bytes.size() / 2, bytes.size() - 1};
    for (const std::size_t size : sizes) {
      CAPTURE(size);
      const auto path = folder.write("cut.mat", bytes.substr(0, size));
      CHECK(message_of([&] { read_mat(path); }).find("cut.mat: damaged or cut off MAT file") !=
            std::string::npos);
    }
  }
  const std::string hdf5 = read_file(write_mat(folder, MAT_FT_MAT73, MAT_COMPRESSION_NONE));
  const auto path = folder.write("cut73.mat", hdf5.substr(0, hdf5.size() / 2));
  CHECK(message_of([&] { read_mat(path); }).find("cut73.mat") != std::string::npos);
}

TEST_CASE("a MAT file that promises more than it holds is refused before anything is allocated") {
  const TemporaryFolder folder;
  std::string bytes = read_file(write_mat(folder, MAT_FT_MAT5, MAT_COMPRESSION_NONE));
  bytes[128 + 8 + 16 + 8 + 3] = 0x40;  // the rows of x: 2^30 + 3
  const auto path = folder.write("huge.mat", bytes);
  CHECK(message_of([&] { read_mat(path); }).find("damaged or cut off MAT file") !=
        std::string::npos);
}

// The sanitizers and the memory limit judge this test, in this process; any Error is a right
// answer.
TEST_CASE("damaged MAT files never crash") {
  const TemporaryFolder folder;
  Random random(11);
  for (const matio_compression compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    const std::string bytes = read_file(write_mat(folder, MAT_FT_MAT5, compression));
    for (int round = 0; round < 300; ++round) {
      std::string damaged = bytes;
      for (std::size_t k = 1 + random.index(4); k > 0; --k)
        damaged[random.index(damaged.size())] = static_cast<char>(random.next());
      const auto path = folder.write("damaged.mat", damaged);
      try {
        mat_tables(arrays_of(hand_over_mat, path), "damaged.mat");
      } catch (const Error&) {
      }
    }
  }
}

TEST_CASE("a file of version 7.3 that was cut off says so at every length") {
  const TemporaryFolder folder;
  const std::string whole = read_file(write_mat(folder, MAT_FT_MAT73, MAT_COMPRESSION_NONE));
  for (const std::size_t left :
       {std::size_t{20}, std::size_t{530}, whole.size() / 2, whole.size() - 1})
    CHECK(message_of([&] {
            read_mat(folder.write("cut.mat", whole.substr(0, left)));
          }).find("cut off") != std::string::npos);
}

namespace {

/// A file of version 7.3 whose only variable is made by `make` in an open file of HDF5.
template <class Make>
std::filesystem::path mat73(const TemporaryFolder& folder, Make make) {
  const auto path = folder.path() / "made.mat";
  std::filesystem::remove(path);
  Mat_Close(Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT73));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(file >= 0);
  make(file);
  H5Fclose(file);
  return path;
}

/// A column of so many numbers, laid out as `creation` says.
void add_dataset(hid_t file, hsize_t count, hid_t creation) {
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t set =
      H5Dcreate2(file, "x", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  REQUIRE(set >= 0);
  H5Dclose(set);
  H5Sclose(space);
}

}  // namespace

TEST_CASE("version 7.3: datasets far larger than their file are refused") {
  const TemporaryFolder folder;
  const auto path = mat73(folder, [](hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 1000;
    H5Pset_chunk(creation, 1, &chunk);
    add_dataset(file, 400'000'000, creation);
    H5Pclose(creation);
  });
  CHECK(std::filesystem::file_size(path) < 20000);
  CHECK(contains(message_of([&] { read_mat(path); }),
                 "unpacks to far more than a recording of its size"));
}

TEST_CASE("version 7.3: numbers in other files are not followed") {
  const TemporaryFolder folder;
  const auto secret = folder.write("secret", std::string(80, 's'));
  const auto stored = mat73(folder, [&](hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, secret.c_str(), 0, 80);
    add_dataset(file, 10, creation);
    H5Pclose(creation);
  });
  CHECK(contains(message_of([&] { read_mat(stored); }), "takes numbers from other files"));
  const auto linked = mat73(folder, [](hid_t file) {
    REQUIRE(H5Lcreate_external("other.mat", "/x", file, "x", H5P_DEFAULT, H5P_DEFAULT) >= 0);
  });
  CHECK(contains(message_of([&] { read_mat(linked); }), "takes numbers from other files"));
}

TEST_CASE("version 5: packed variables count together") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "many.mat";
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  REQUIRE(file);
  std::vector<double> zeros(2'000'000);
  std::size_t dims[] = {zeros.size(), 1};
  for (int k = 0; k < 8; ++k) {
    const std::string name = "x" + std::to_string(k);
    matvar_t* variable = Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims,
                                       zeros.data(), MAT_F_DONT_COPY_DATA);
    Mat_VarWrite(file, variable, MAT_COMPRESSION_ZLIB);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
  CHECK(contains(message_of([&] { read_mat(path); }),
                 "unpacks to far more than a recording of its size"));
}
