#pragma once
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <doctest/doctest.h>

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                 kInfinity = std::numeric_limits<double>::infinity();

/// |actual - expected| <= rel |expected| + abs, with both numbers in the message.
#define CHECK_CLOSE(actual, expected, relative, absolute)              \
  do {                                                                 \
    const double check_actual = (actual), check_expected = (expected); \
    CAPTURE(check_actual);                                             \
    CAPTURE(check_expected);                                           \
    CHECK(std::abs(check_actual - check_expected) <=                   \
          (relative) * std::abs(check_expected) + (absolute));         \
  } while (false)

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The message of the dashpot::Error (or other exception) that `code` throws; "" when it throws
/// none.
template <class Code>
std::string message_of(Code code) {
  try {
    code();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// A folder of its own for one test, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file into it and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

/// The measured recordings beside the project, or a skip line and an empty path when absent.
std::filesystem::path shared_data(const std::string& folder);

/// A file or folder of the project itself.
std::string project_file(const std::string& path);
/// The program under test.
std::string program_path();
/// The C compiler of the build that made the tests.
std::string own_c_compiler();

/// A program's exit code and what it printed (stdout and stderr together).
struct ProgramResult {
  int exit_code = -1;
  std::string output;
};
ProgramResult run_program(const std::string& command_line);
