#include "dashpot/base/child_process.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <sys/wait.h>

#include "dashpot/error.h"

namespace dashpot {

ChildResult run_child(std::vector<std::string> program_and_arguments) {
  const std::string program = program_and_arguments.front();

  // One pipe takes what the program prints, on either channel.
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(program, std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);

  // The program sees its arguments as C strings, the last one null.
  std::vector<char*> arguments;
  for (std::string& argument : program_and_arguments) arguments.push_back(argument.data());
  arguments.push_back(nullptr);

  // Start it, and keep only the reading end, so that the end of its output is seen.
  pid_t child = 0;
  const int problem =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
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

}  // namespace dashpot
