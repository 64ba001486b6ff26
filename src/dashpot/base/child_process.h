#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace dashpot {

struct ChildResult {
  bool succeeded = false;
  std::string printed;  ///< on its standard output and error
};

/// Runs a program, found along PATH, with its arguments and waits for it. Throws Error(program,
/// ...) when it cannot be started.
ChildResult run_child(std::vector<std::string> program_and_arguments);

/// How a child ended. Neither is known where somebody else in this process has waited for it.
struct ChildStatus {
  int exit_status = -1;
  int signal = 0;
  bool was_ended = false;  ///< by this process, since it had more to hand over
};

/// A program that hands over bytes through its descriptor kHandOver while it runs; what it prints
/// is dropped. It has a process group of its own, so that a key pressed at the terminal ends this
/// process first, and signals as a fresh process has them. Of one thread at a time.
class HandingChild {
 public:
  static constexpr int kHandOver = 3;

  /// Throws Error(program, ...) when it cannot be started. `program` is a path.
  explicit HandingChild(std::vector<std::string> program_and_arguments);
  ~HandingChild();
  HandingChild(const HandingChild&) = delete;
  HandingChild& operator=(const HandingChild&) = delete;

  /// Gives it all of that to read at its standard input, which then ends. Where it does not read
  /// on, this tells nothing: its end will.
  void give(std::string_view bytes);
  /// Fills `to` with `count` bytes, with fewer only where the child has closed its end.
  std::size_t take(void* to, std::size_t count);
  /// Waits until it has ended, which it is made to where it has not closed its end yet.
  ChildStatus wait();

 private:
  std::size_t read_some(char* to, std::size_t room);

  int pipe_ = -1, input_ = -1;
  pid_t child_ = 0;  ///< 0: waited for
  bool is_closed_ = false;
  std::array<char, 1 << 16> kept_;
  std::size_t kept_from_ = 0, kept_to_ = 0;
};

}  // namespace dashpot
