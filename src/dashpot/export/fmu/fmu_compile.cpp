#include <filesystem>
#include <unistd.h>

#include "dashpot/base/child_process.h"
#include "dashpot/base/file.h"
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

}  // namespace

std::string compile_shared_library(const std::vector<ExportedFile>& files,
                                   const std::vector<std::string>& translation_units,
                                   const std::string& compiler) {
  const BuildFolder folder;
  for (const ExportedFile& file : files)
    write_file(fs::path(folder.path) / file.name, file.content);

  // The command: the compiler and its arguments as they were named, ours, then the files.
  std::vector<std::string> words;
  for (const std::string& word : split(compiler, ' '))
    if (!word.empty()) words.push_back(word);
  if (words.empty())
    throw Error("compiler", "its name is empty", "name one, as cc, or ask for sources only");
  const std::vector<std::string> flags{
      "-std=c99", "-O2", "-shared", "-fPIC", "-fvisibility=hidden", "-s", "-Wl,-z,defs"};
  words.insert(words.begin() + 1, flags.begin(), flags.end());
  const std::string library = folder.path + "/library.so";
  for (const std::string& unit : translation_units) words.push_back(folder.path + '/' + unit);
  for (const std::string& word : {std::string("-o"), library, std::string("-lm")})
    words.push_back(word);

  ChildResult result;
  try {
    result = run_child(words);
  } catch (const Error& error) {
    throw Error(compiler, "the C compiler cannot be run: " + std::string(error.what()),
                "install one (gcc), name one with --compiler, or ask for --sources-only");
  }
  if (!result.succeeded)
    throw Error(compiler, "the C compiler complains: " + std::string(trim(result.printed)));
  return read_file(library);
}

}  // namespace dashpot
