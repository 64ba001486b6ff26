#include "dashpot/base/child_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <sys/socket.h>
#include <sys/wait.h>

#include "dashpot/error.h"

namespace dashpot {
namespace {

/// A program's words as it is given them: C strings, the last one null.
std::vector<char*> c_words(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

ChildResult run_child(std::vector<std::string> program_and_arguments) {
  const std::string program = program_and_arguments.front();

  // One pipe takes what the program prints, on either channel.
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(program, std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);

  // Start it, and keep only the reading end, so that the end of its output is seen.
  pid_t child = 0;
  const int problem = posix_spawnp(&child, program.c_str(), &actions, nullptr,
                                   c_words(program_and_arguments).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);

  // Read until the program closes its output.
  ChildResult result;
  std::array<char, 4096> buffer;
  if (problem == 0)
    for (ssize_t n; (n = read(ends[0], buffer.data(), buffer.size())) > 0;)
      result.printed.append(buffer.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  if (problem != 0) throw Error(program, std::strerror(problem));

  // Only an exit with 0 is a success; a signal is not.
  int status = 0;
  waitpid(child, &status, 0);
  result.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return result;
}

HandingChild::HandingChild(std::vector<std::string> program_and_arguments) {
  const std::string program = program_and_arguments.front();
  const std::vector<char*> words = c_words(program_and_arguments);
  // A pipe for what it hands over. What it is given goes through a socket, since nobody at the
  // other end of a pipe would be a signal to this process.
  std::array<int, 2> ends, input;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(program, std::strerror(errno));
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.data()) != 0) {
    for (const int end : ends) close(end);
    throw Error(program, std::strerror(errno));
  }

  // A large pipe, so that the two take turns less often; where it may not be, a small one does.
  constexpr int kPipeBytes = 1 << 20;
  fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], kHandOver);
  for (const int standard : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, standard, "/dev/null", O_RDWR, 0);

  // No signal is blocked or ignored, whatever this process does with it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);

  // Start it, and keep only the reading end, so that the end of its bytes is seen. In a program of
  // many threads this is sound: nothing of ours runs between the two.
  const int problem =
      posix_spawn(&child_, program.c_str(), &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  for (const int end : {ends[1], input[1]}) close(end);
  pipe_ = ends[0], input_ = input[0];
  if (problem == 0) return;
  for (const int end : {pipe_, input_}) close(end);
  throw Error(program, std::strerror(problem));
}

HandingChild::~HandingChild() { wait(); }

void HandingChild::give(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  shutdown(input_, SHUT_WR);
}

std::size_t HandingChild::read_some(char* to, std::size_t room) {
  for (;;) {
    const ssize_t n = read(pipe_, to, room);
    if (n < 0 && errno == EINTR) continue;
    is_closed_ = n <= 0;
    return is_closed_ ? 0 : static_cast<std::size_t>(n);
  }
}

std::size_t HandingChild::take(void* to, std::size_t count) {
  auto* const bytes = static_cast<char*>(to);
  std::size_t done = 0, n = 1;
  for (; done < count && n > 0; done += n) {
    // Large pieces are read to where they go, small ones come out of a block that is kept.
    const std::size_t left = count - done;
    const bool is_empty = kept_from_ == kept_to_;
    if (is_empty && left >= kept_.size()) {
      n = read_some(bytes + done, left);
      continue;
    }
    if (is_empty) kept_from_ = 0, kept_to_ = read_some(kept_.data(), kept_.size());
    n = std::min(kept_to_ - kept_from_, left);
    std::copy_n(kept_.data() + kept_from_, n, bytes + done);
    kept_from_ += n;
  }
  return done;
}

ChildStatus HandingChild::wait() {
  ChildStatus end;
  if (child_ <= 0) return end;
  end.was_ended = !is_closed_;
  if (end.was_ended) kill(child_, SIGKILL);
  for (const int own : {pipe_, input_}) close(own);

  int status = 0;
  pid_t waited;
  do waited = waitpid(child_, &status, 0);
  while (waited < 0 && errno == EINTR);
  child_ = 0;
  if (waited > 0 && WIFEXITED(status)) end.exit_status = WEXITSTATUS(status);
  if (waited > 0 && WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

}  // namespace dashpot
