#include <filesystem>
#include <unistd.h>

#include "dashpot/base/child_process.h"
#include "dashpot/base/file.h"
#include "dashpot/base/find_row.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {

namespace fs = std::filesystem;

namespace {

/// A temporary folder, removed with the object.
struct BuildFolder {
  std::string path = (fs::temp_directory_path() / "dashpot-XXXXXX").string();
  BuildFolder() {
    if (!mkdtemp(path.data())) throw Error(path, "cannot make a folder to compile in");
  }
  BuildFolder(const BuildFolder&) = delete;
  BuildFolder& operator=(const BuildFolder&) = delete;
  ~BuildFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

// FMI 2 names no folder for ARM; FMI 3's is taken.
constexpr FmuPlatform kPlatforms[] = {
    {"aarch64-linux", "aarch64-linux", "aarch64-linux", ".so", "aarch64-linux-gnu-gcc",
     "gcc-aarch64-linux-gnu libc6-dev-arm64-cross"},
    {"linux64", "linux64", "x86_64-linux", ".so", "x86_64-linux-gnu-gcc", "gcc-x86-64-linux-gnu"},
    {"win64", "win64", "x86_64-windows", ".dll", "x86_64-w64-mingw32-gcc", "gcc-mingw-w64-x86-64"}};

}  // namespace

std::span<const FmuPlatform> fmu_platforms() { return kPlatforms; }

const FmuPlatform& own_platform() {
#ifdef __aarch64__
  return find_platform("aarch64-linux");
#else
  return find_platform("linux64");
#endif
}

const FmuPlatform& find_platform(std::string_view name) {
  return find_row(kPlatforms, name, "platform", "--platforms");
}

std::string compile_shared_library(const std::vector<ExportedFile>& files,
                                   const std::vector<std::string>& translation_units,
                                   const FmuPlatform& platform, const std::string& compiler) {
  const BuildFolder folder;
  for (const ExportedFile& file : files)
    write_file(fs::path(folder.path) / file.name, file.content);

  // The command: the compiler and its arguments as they were named, ours, then the files.
  const bool is_own = platform.name == own_platform().name;
  std::vector<std::string> words;
  for (const std::string& word : split(is_own ? compiler : std::string(platform.compiler), ' '))
    if (!word.empty()) words.push_back(word);
  if (words.empty())
    throw Error("compiler", "its name is empty", "name one, as cc, or ask for sources only");
  std::vector<std::string> flags{"-std=c99", "-O2", "-shared", "-fvisibility=hidden", "-s",
                                 // Else a processor with fused products rounds otherwise.
                                 "-ffp-contract=off"};
  const bool is_elf = platform.ending == ".so";
  if (is_elf)
    flags.insert(flags.end(), {"-fPIC", "-Wl,-z,defs"});
  else
    flags.emplace_back("-static-libgcc");
  words.insert(words.begin() + 1, flags.begin(), flags.end());
  const std::string library = folder.path + "/library" + std::string(platform.ending);
  for (const std::string& unit : translation_units) words.push_back(folder.path + '/' + unit);
  for (const std::string& word : {std::string("-o"), library, std::string("-lm")})
    words.push_back(word);

  ChildResult result;
  try {
    result = run_child(words);
  } catch (const Error& error) {
    if (!is_own)
      throw Error(std::string(platform.name),
                  "needs the compiler " + words.front() + ", which cannot be run here",
                  "install it (Debian: apt-get install " + std::string(platform.package) +
                      "), or leave the platform out");
    throw Error(compiler, "the C compiler cannot be run: " + std::string(error.what()),
                "install one (gcc), name one with --compiler, or ask for --sources-only");
  }
  if (!result.succeeded)
    throw Error(words.front(), "the C compiler complains: " + std::string(trim(result.printed)));
  return read_file(library);
}

}  // namespace dashpot
