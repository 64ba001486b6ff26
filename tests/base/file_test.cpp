#include "dashpot/base/file.h"

#include <csignal>

#include <sys/resource.h>

#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

TEST_CASE("write and read back, gzip included") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "deep" / "a.txt";
  write_file(path, "one\n");
  write_file(path, "two\n");
  CHECK(read_file(path) == "two\n");
  CHECK(run_program("gzip -k " + path.string()).exit_code == 0);
  CHECK(read_file(path.string() + ".gz") == "two\n");
}

TEST_CASE("a file that cannot be read says why") {
  const TemporaryFolder folder;
  CHECK(message_of([&] { read_file(folder.path() / "none.csv"); }).find("there is no such file") !=
        std::string::npos);
  CHECK(message_of([&] { read_file(folder.path()); }).find("is a folder") != std::string::npos);
  const fs::path path = folder.write("a.txt", std::string(100000, 'x') + "y");
  CHECK(run_program("gzip " + path.string()).exit_code == 0);
  fs::resize_file(path.string() + ".gz", 60);
  CHECK(message_of([&] { read_file(path.string() + ".gz"); }).find("damaged gzip file") !=
        std::string::npos);
}

TEST_CASE("a disk that fills up leaves the old file and no rubbish") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("report.html", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler =
      std::signal(SIGXFSZ, SIG_IGN);  // the write then fails with EFBIG, as with ENOSPC
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] { write_file(path, std::string(5000, 'n')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(message.find("cannot be written") != std::string::npos);
  CHECK(read_file(path) == "old");
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("SHA-256 of the standard's test message") {
  const TemporaryFolder folder;
  // FIPS 180-4 example: "abc"
  CHECK(sha256_of_file(folder.write("abc", "abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("SHA-256 of bytes: the example of FIPS 180-4") {
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
