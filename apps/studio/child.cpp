#include "child.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <utility>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "dashpot/error.h"

namespace dashpot::studio {
namespace {

constexpr std::size_t kMostOut = std::size_t{256} << 20, kMostErr = 1 << 16;

void limit(int what, std::size_t most) noexcept {
  if (most == 0) return;
  const rlimit both{most, most};
  setrlimit(static_cast<__rlimit_resource>(what), &both);
}

/// What happens in the child between fork and exec: calls of the system alone, since other threads
/// may have held locks.
[[noreturn]] void become(char* const* arguments, char* const* environment, const char* folder,
                         const ChildLimits& limits, int out, int err) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = open("/dev/null", O_RDONLY);
  if (chdir(folder) == 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
      dup2(err, STDERR_FILENO) >= 0) {
    close_range(STDERR_FILENO + 1, ~0U, 0);
    limit(RLIMIT_AS, limits.memory);
    limit(RLIMIT_CPU, limits.cpu_seconds);
    limit(RLIMIT_FSIZE, limits.file);
    limit(RLIMIT_CORE, 1);
    execve("/proc/self/exe", arguments, environment);
  }
  _exit(127);
}

/// A pipe whose ends are closed with it.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("dashpot", std::strerror(errno));
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_writing() { close(std::exchange(ends[1], -1)); }
};

/// Hands whole lines on and keeps what is left.
void take_lines(std::string& pending, const std::function<void(std::string_view)>& on_line) {
  std::size_t at = 0;
  for (std::size_t end; (end = pending.find('\n', at)) != std::string::npos; at = end + 1)
    if (on_line) on_line(std::string_view(pending).substr(at, end - at));
  pending.erase(0, at);
}

}  // namespace

ChildEnd run_self(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                  const ChildLimits& limits, const std::function<void(std::string_view)>& on_line,
                  std::atomic<int>* pid) {
  // All that the child needs is made before the fork.
  std::vector<std::string> words{"dashpot"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv, env;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::string arenas = "MALLOC_ARENA_MAX=2";  // an arena each would take the limit of memory away
  for (char** one = environ; *one; ++one) env.push_back(*one);
  if (limits.memory > 0) env.push_back(arenas.data());
  env.push_back(nullptr);
  const std::string where = folder.string();

  Pipe out, err;
  const pid_t child = fork();
  if (child < 0) throw Error("dashpot", std::strerror(errno));
  if (child == 0) become(argv.data(), env.data(), where.c_str(), limits, out.ends[1], err.ends[1]);
  if (pid) *pid = child;
  out.close_writing();
  err.close_writing();

  // Read both channels until the child closes them.
  ChildEnd end;
  std::string pending;
  std::array<char, 1 << 16> buffer;
  std::array<pollfd, 2> both{{{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}}};
  while (both[0].fd >= 0 || both[1].fd >= 0) {
    if (poll(both.data(), both.size(), -1) < 0 && errno != EINTR) break;
    for (pollfd& one : both) {
      if (one.fd < 0 || one.revents == 0) continue;
      const ssize_t count = read(one.fd, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        one.fd = -1;
        continue;
      }
      const std::string_view got(buffer.data(), static_cast<std::size_t>(count));
      if (&one == both.data()) {
        if (end.out.size() + got.size() <= kMostOut) end.out += got;
        continue;
      }
      end.err += got;
      if (end.err.size() > 2 * kMostErr) end.err.erase(0, end.err.size() - kMostErr);
      pending += got;
      take_lines(pending, on_line);
    }
  }

  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (pid) *pid = 0;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return end;
}

}  // namespace dashpot::studio
