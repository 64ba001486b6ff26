#include "support.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <unistd.h>

#include <sys/wait.h>

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "dashpot-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const std::string& name, const std::string& content) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

std::string project_file(const std::string& path) { return DASHPOT_PROJECT_DIR "/" + path; }

std::string program_path() { return DASHPOT_PROGRAM; }

std::string own_c_compiler() { return DASHPOT_C_COMPILER; }

fs::path shared_data(const std::string& folder) {
  const fs::path path = fs::path(project_file("../shared/data")) / folder;
  if (fs::exists(path)) return path;
  MESSAGE("SKIPPED: the recordings " << path.string() << " are not here");
  return {};
}

ProgramResult run_program(const std::string& command_line) {
  ProgramResult result;
  FILE* pipe = popen((command_line + " 2>&1").c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}
