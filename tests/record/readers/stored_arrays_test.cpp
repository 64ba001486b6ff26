#include "dashpot/record/readers/stored_arrays.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <matio.h>
#include <regex>
#include <spawn.h>
#include <thread>
#include <unistd.h>

#include <hdf5.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "example_hdf5.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;  // what would be a signal is then a report and an exit status
#else
constexpr bool kSanitized = false;
#endif

/// What a reading process hands over: two arrays, one of them wide, and a note.
std::string handed_over() {
  std::string bytes;
  StoredWriter to([&](const void* from, std::size_t count) {
    bytes.append(static_cast<const char*>(from), count);
  });
  const float matrix[] = {1, 2, 3, 4, 5, 6};
  to.begin_array({.group = "g", .name = "F", .unit = "N", .height = 3, .width = 2});
  for (std::size_t c = 0; c < 2; ++c) to.add_column(matrix + c, 3, 2);
  to.begin_array({.group = "", .name = "image", .unit = "", .height = 100, .width = 200});
  to.note({"g", "a text passed over"});
  to.end();
  return bytes;
}

bool take_all(std::string_view bytes, std::size_t most, StoredArrays& to) {
  const auto take = [&](void* into, std::size_t count) {
    const std::size_t n = std::min(count, bytes.size());
    std::memcpy(into, bytes.data(), n);
    bytes.remove_prefix(n);
    return n;
  };
  return take_stored_arrays(take, most, to);
}

/// A folder in which dashpot-hdf5 is a shell script; the environment names it for that long.
class StandIn {
 public:
  explicit StandIn(const std::string& script) {
    const fs::path path = folder_.write("dashpot-hdf5", "#!/bin/sh\n" + script + "\n");
    fs::permissions(path, fs::perms::owner_all);
    setenv("DASHPOT_PROGRAMS", folder_.path().c_str(), 1);
  }
  ~StandIn() { unsetenv("DASHPOT_PROGRAMS"); }

 private:
  TemporaryFolder folder_;
};

std::string refusal(const fs::path& path) {
  return message_of([&] { read_tables(path); });
}

}  // namespace

TEST_CASE("stored arrays: what is handed over is what is taken, cut at any place it is refused") {
  const std::string whole = handed_over();
  StoredArrays all;
  REQUIRE(take_all(whole, whole.size(), all));
  REQUIRE(all.arrays.size() == 2);
  CHECK(all.arrays[0].columns == std::vector<std::vector<double>>{{1, 3, 5}, {2, 4, 6}});
  CHECK(all.arrays[0].unit == "N");
  CHECK(all.arrays[1].columns.empty());
  CHECK(all.notes.at(0).text == "a text passed over");

  for (std::size_t size = 0; size < whole.size(); ++size) {
    StoredArrays part;
    CHECK(!take_all(whole.substr(0, size), whole.size(), part));
    CHECK(!take_all(whole, size, part));
  }
}

TEST_CASE("stored arrays: nonsense is refused, within memory") {
  const std::string whole = handed_over();
  Random random(5);
  for (int k = 0; k < 2000; ++k) {
    std::string bytes = whole;
    for (std::size_t n = 1 + random.index(3); n > 0; --n)
      bytes[random.index(bytes.size())] = static_cast<char>(random.next());
    StoredArrays all;
    try {
      take_all(bytes, 1 << 20, all);
    } catch (const Error&) {
    }
    for (const StoredArray& array : all.arrays) CHECK(array.name.size() <= 1 << 20);
  }
}

TEST_CASE("files that end HDF5 are errors, and the next file is read") {
  const TemporaryFolder folder;
  const fs::path sound = folder.path() / "run.h5";
  write_example_hdf5(sound, {"a"});
  const fs::path damaged = folder.write("damaged.h5", without_chunk_sides(read_file(sound)));
  const std::string message = refusal(damaged);
  CAPTURE(message);
  CHECK(message.starts_with(damaged.string() + ": "));
  CHECK(contains(message, "copy it again from its source"));
  if (!kSanitized)
    CHECK(contains(message,
                   "is damaged: the HDF5 library was ended by signal 8 (Floating point "
                   "exception) while reading it"));
  CHECK(read_tables(sound).size() == 1);
}

TEST_CASE("a MAT file of version 7.3 that ends HDF5 is an error") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "run.mat";
  Mat_Close(Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT73));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const double numbers[40] = {};
  write_hdf5_dataset(file, "x", H5T_NATIVE_DOUBLE, numbers, 40, 1, "");
  H5Fclose(file);

  const std::string message =
      refusal(folder.write("damaged.mat", without_chunk_sides(read_file(path))));
  CAPTURE(message);
  CHECK(contains(message, "damaged.mat: "));
  if (!kSanitized) CHECK(contains(message, "the MAT library was ended by signal 8"));
}

TEST_CASE("however its reader ends, a file is refused and says why") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "run.h5";
  write_example_hdf5(path, {"a"});
  const std::string real = own_program("dashpot-hdf5").string();
  const std::string begun = real + " \"$1\" \"$2\" $$ 3>&1 | head -c 300 >&3; ";
  struct {
    std::string script, told;
  } const cases[] = {
      {"kill -SEGV $$", "is damaged: the HDF5 library was ended by signal 11 (Segmentation fault)"},
      {"kill -ABRT $$", "is damaged: the HDF5 library was ended by signal 6 (Aborted)"},
      {"kill -XCPU $$", "took more time to read it than any file of its size needs"},
      {"kill -KILL $$", "its reader was ended from outside by signal 9 (Killed); read it again"},
      {"exit 0", "which reads it, ended with status 0"},
      {"exit 3", "which reads it, ended with status 3"},
      {"echo nonsense that goes on for more than thirty bytes >&3; sleep 100",
       "handed over what is no recording"},
      {begun + "kill -SEGV $$", "is damaged: the HDF5 library was ended by signal 11"},
      {begun + "exit 0", "ended with status 0"},
      {real + " \"$1\" \"$2\" $$; echo more >&3", "which reads it, "}};
  for (const auto& one : cases) {
    CAPTURE(one.script);
    const StandIn instead(one.script);
    const std::string message = refusal(path);
    CAPTURE(message);
    CHECK(message.starts_with(path.string() + ": "));
    CHECK(contains(message, one.told));
  }
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);  // nobody is left over
  CHECK(read_tables(path).size() == 1);
}

TEST_CASE("files are read beside each other, also where signals of children are ignored") {
  const TemporaryFolder folder;
  const fs::path sound = folder.path() / "run.h5";
  write_example_hdf5(sound, {"a"});
  const fs::path damaged = folder.write("damaged.h5", without_chunk_sides(read_file(sound)));
  const auto handler = std::signal(SIGCHLD, SIG_IGN);
  std::vector<std::thread> threads;
  std::atomic<int> read = 0, refused = 0;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (int n = 0; n < 5; ++n) {
        if (k % 2 == 0) read += static_cast<int>(read_tables(sound).size());
        if (k % 2 == 1) refused += refusal(damaged).empty() ? 0 : 1;
      }
    });
  for (std::thread& thread : threads) thread.join();
  std::signal(SIGCHLD, handler);
  CHECK(read == 10);
  CHECK(refused == 10);
}

TEST_CASE("the reader ends with the process that has started it") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "large.h5";
  const std::vector<double> numbers(200'000);  // more than a pipe holds
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  write_hdf5_dataset(file, "x", H5T_NATIVE_DOUBLE, numbers.data(), numbers.size(), 1, "");
  H5Fclose(file);

  // A shell starts the reader and waits; nobody takes what it hands over, so that it waits, too.
  const fs::path told = folder.path() / "pid";
  const std::string script =
      "exec 3>\"$2\" ; \"$1\" read-hdf5 \"$3\" $$ 3>&3 & echo $! >\"$4\"; wait";
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int end = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  std::string words[] = {"sh", "-c", script, "sh", own_program("dashpot-hdf5"), pipe, path, told};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(),
                       words[3].data(), words[4].data(), words[5].data(),
                       words[6].data(), words[7].data(), nullptr};
  pid_t shell = 0;
  REQUIRE(posix_spawnp(&shell, "sh", nullptr, nullptr, arguments, environ) == 0);

  // Once it has handed over something, it is in the middle of its file.
  using namespace std::chrono_literals;
  char byte;
  for (int k = 0; k < 3000 && read(end, &byte, 1) != 1; ++k) std::this_thread::sleep_for(10ms);
  while (!fs::exists(told) || fs::file_size(told) == 0) std::this_thread::sleep_for(10ms);
  const std::string status = "/proc/" + std::to_string(std::stoi(read_file(told))) + "/stat";
  const auto runs = [&] {
    std::error_code none;
    if (!fs::exists(status, none)) return false;
    std::ifstream from(status);
    std::string text;
    std::getline(from, text);
    const std::size_t name = text.rfind(')');
    return name != std::string::npos && text.compare(name + 2, 1, "Z") != 0;
  };
  CHECK(runs());
  std::ifstream limits("/proc/" + std::to_string(std::stoi(read_file(told))) + "/limits");
  const std::string text{std::istreambuf_iterator<char>(limits), {}};
  CAPTURE(text);
  CHECK(std::regex_search(text, std::regex("Max cpu time +[0-9]+ ")));
  CHECK(std::regex_search(text, std::regex("Max file size +0 ")));
  kill(shell, SIGKILL);
  waitpid(shell, nullptr, 0);
  for (int k = 0; k < 1000 && runs(); ++k) std::this_thread::sleep_for(10ms);
  CHECK(!runs());
  close(end);
}
