#include "dashpot/identify/many/damper_folders.h"

#include <filesystem>

#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

TEST_CASE("dampers of a folder: subfolders, else files, in the order of their serial numbers") {
  const TemporaryFolder folder;
  for (const char* name : {"unit-10", "unit-9", "unit-101"})
    fs::create_directories(folder.path() / name);
  folder.write("truth.csv", "x");
  fs::create_directories(folder.path() / ".hidden");
  DamperFolders found = find_dampers(folder.path());
  CHECK(found.has_serials);
  CHECK(found.names == std::vector<std::string>{"unit-9", "unit-10", "unit-101"});
  CHECK(found.serials == std::vector<double>{9, 10, 101});
  CHECK(found.passed_over == std::vector<std::string>{"truth.csv"});
  CHECK(found.statement.empty());

  // A name without a number: all go by their names.
  fs::create_directories(folder.path() / "spare");
  found = find_dampers(folder.path());
  CHECK_FALSE(found.has_serials);
  CHECK(found.names.front() == "spare");
  CHECK(found.serials == std::vector<double>{1, 2, 3, 4});

  const TemporaryFolder files;
  files.write("sn2_run1.csv", "x");
  files.write("sn1_run1.csv", "x");
  files.write("dataset.yaml", "name: night\n");
  found = find_dampers(files.path());
  CHECK(found.names == std::vector<std::string>{"sn1_run1.csv", "sn2_run1.csv"});
  CHECK_FALSE(found.has_serials);  // both end in 1
  CHECK(found.statement_of(0) == files.path() / "dataset.yaml");

  CHECK_THROWS_WITH_AS(find_dampers(files.path() / "none"), doctest::Contains("is no folder"),
                       Error);
  const TemporaryFolder empty;
  CHECK_THROWS_WITH_AS(find_dampers(empty.path()), doctest::Contains("holds no damper"), Error);
}

TEST_CASE("what a damper's row comes from changes with its files, their names and its statement") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "1");
  const auto write = [&](const std::string& name, const std::string& text) {
    folder.write(name, text);
    return find_dampers(folder.path()).content_of(0);
  };
  const std::string first = write("1/a.csv", "x");
  CHECK(find_dampers(folder.path()).content_of(0) == first);
  const std::string second = write("1/a.csv", "y"), third = write("1/b.csv", "y"),
                    fourth = write("dataset.yaml", "name: a\n");
  CHECK(first != second);
  CHECK(second != third);
  CHECK(third != fourth);
  CHECK(write("1/dataset.yaml", "name: b\n") != fourth);
  CHECK(find_dampers(folder.path()).statement_of(0).empty());
}
