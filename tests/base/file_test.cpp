#include "dashpot/base/file.h"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <unistd.h>

#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>

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

TEST_CASE("a pipe and a device are refused at once") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe.csv";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const fs::path& path : {pipe, fs::path("/dev/zero")}) {
    CHECK(contains(message_of([&] { read_file(path); }), "is a pipe or a device"));
    CHECK(contains(message_of([&] { sha256_of_file(path); }), "is a pipe or a device"));
  }
  CHECK(contains(message_of([] { write_file("/dev/null", "x"); }), "is no regular file"));
  CHECK(!fs::is_regular_file("/dev/null"));
}

TEST_CASE("where no file can be written is told before any is, and nothing is made") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.csv", "old"), missing = folder.path() / "missing";
  const auto refusal = [](const fs::path& path) {
    return message_of([&] { require_writable(path); });
  };
  CHECK(contains(refusal(folder.path()), "is no regular file"));
  CHECK(contains(refusal(missing / ""), "is no regular file"));
  CHECK(contains(refusal(file / "b" / "c.csv"), "a.csv is no folder"));
  CHECK(refusal(file).empty());
  CHECK(refusal(missing / "b" / "c.csv").empty());
  CHECK(refusal("c.csv").empty());

  // What would be refused leaves no folder behind.
  CHECK(contains(message_of([&] { write_file(missing / "", "x"); }), "is no regular file"));
  CHECK(!fs::exists(missing));
}

TEST_CASE("gzip files of several parts are read to the end, and only whole ones") {
  const TemporaryFolder folder;
  const fs::path first = folder.write("a", "one\n"), second = folder.write("b", "two\n");
  const std::string in = "cd " + folder.path().string() + " && ";
  REQUIRE(run_program(in + "gzip a b && cat a.gz b.gz > ab.gz && cp ab.gz padded.gz && "
                           "head -c 600 /dev/zero >> padded.gz && cp a.gz wrong.gz && "
                           "tail -c +2 b.gz >> wrong.gz")
              .exit_code == 0);
  CHECK(read_file(folder.path() / "ab.gz") == "one\ntwo\n");
  CHECK(read_file(folder.path() / "padded.gz") == "one\ntwo\n");
  CHECK(contains(message_of([&] { read_file(folder.path() / "wrong.gz"); }),
                 "what follows its first part is no gzip"));
}

TEST_CASE("a gzip file that unpacks to far more than a recording is refused") {
  const TemporaryFolder folder;
  const std::string bomb = (folder.path() / "bomb.gz").string();
  REQUIRE(run_program("head -c 200000000 /dev/zero | gzip > " + bomb).exit_code == 0);
  CHECK(contains(message_of([&] { read_file(bomb); }), "unpacks to more than 25 times its size"));
}

TEST_CASE("a link in the place of a file is replaced, and what it named stays") {
  const TemporaryFolder folder;
  const fs::path victim = folder.write("victim", "precious"), link = folder.path() / "out.mat";
  fs::create_symlink(victim, link);
  write_file(link, "new");
  CHECK(read_file(victim) == "precious");
  CHECK(read_file(link) == "new");
  CHECK(!fs::is_symlink(link));
}

TEST_CASE("what a killed writer left is removed, what a living one writes is not") {
  const TemporaryFolder folder;
  const fs::path dead = folder.write("a.csv.part-AbC123", "half"),
                 alive = folder.write(".part-XyZ789", "half"),
                 young = folder.write(".part-q1w2e3", "half"),
                 other = folder.write("my.part-1", "mine");
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const fs::path& path : {dead, alive, other}) fs::last_write_time(path, long_ago);
  const int held = open(alive.c_str(), O_RDONLY);
  REQUIRE(flock(held, LOCK_EX) == 0);
  write_file(folder.path() / "b.csv", "whole");
  close(held);
  CHECK(!fs::exists(dead));
  CHECK(fs::exists(alive));
  CHECK(fs::exists(young));
  CHECK(fs::exists(other));
}

TEST_CASE("a file in memory has a name for programs, and gives back what they wrote") {
  const MemoryFile memory;
  memory.write("abc");
  CHECK(memory.content() == "abc");
  CHECK(run_program("cat " + memory.name()).output == "abc");
  REQUIRE(run_program("printf longer > " + memory.name()).exit_code == 0);
  CHECK(memory.content() == "longer");
}

TEST_CASE("SHA-256 of the standard's test message") {
  const TemporaryFolder folder;
  // FIPS 180-4 example: "abc"
  CHECK(sha256_of_file(folder.write("abc", "abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("SHA-256 of bytes: the examples of FIPS 180-4") {
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const std::string many(1'000'000, 'a'),
      expected = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
  CHECK(sha256(many) == expected);
  const TemporaryFolder folder;
  CHECK(sha256_of_file(folder.write("many", many)) == expected);
}
