#include "dashpot/base/data_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <dirent.h>
#include <dlfcn.h>
#include <initializer_list>

#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {

namespace {

/// Folders beside the program or shared library that runs; none where that is unknown.
std::vector<fs::path> beside_code(std::initializer_list<const char*> ways) {
  Dl_info here;
  std::error_code unknown;
  if (dladdr(reinterpret_cast<const void*>(&beside_code), &here) == 0 || !here.dli_fname) return {};
  // A program's own name may be relative to a folder that it has left.
  fs::path code = fs::read_symlink("/proc/self/exe", unknown);
  if (fs::path(here.dli_fname).filename() != code.filename())
    code = fs::absolute(here.dli_fname, unknown);
  std::vector<fs::path> folders;
  for (const char* way : ways) folders.push_back((code.parent_path() / way).lexically_normal());
  return folders;
}

/// Folders in which the data may lie, the best first: where the user says; beside the program or
/// shared library that runs, as an installation (which may have been moved) or a Python package has
/// it; in the source; where it was to be installed.
std::vector<fs::path> find_roots() {
  std::vector<fs::path> roots = beside_code({"data", "../share/dashpot", "../../share/dashpot"});
  if (const char* stated = std::getenv("DASHPOT_DATA"); stated && *stated) {
    // Other data than those that were asked for would be taken without a word.
    if (std::error_code none; !fs::is_directory(stated, none))
      throw Error("DASHPOT_DATA", "'" + std::string(stated) + "' is no folder",
                  "name the folder of Dashpot's data, or unset it");
    roots.insert(roots.begin(), stated);
  }
  roots.emplace_back(DASHPOT_DATA_SOURCE_DIR);
  roots.emplace_back(DASHPOT_DATA_INSTALL_DIR);
  return roots;
}

}  // namespace

fs::path data_folder(std::string_view kind) {
  static const std::vector<fs::path> roots = find_roots();
  for (const fs::path& root : roots)
    if (std::error_code none; fs::is_directory(root / kind, none)) return root / kind;
  return roots.back() / kind;
}

fs::path own_program(const std::string& name) {
  std::vector<fs::path> folders = beside_code({".", "../lib/dashpot", "../dashpot"});
  if (const char* stated = std::getenv("DASHPOT_PROGRAMS")) folders.insert(folders.begin(), stated);
  folders.emplace_back(DASHPOT_BUILD_DIR);
  folders.emplace_back(DASHPOT_PROGRAM_INSTALL_DIR);
  for (const fs::path& folder : folders)
    if (std::error_code none; fs::is_regular_file(folder / name, none)) return folder / name;
  throw Error(name, "this program of Dashpot is not where it was installed",
              "install Dashpot whole, or name the folder that holds it as DASHPOT_PROGRAMS");
}

std::vector<std::string> data_names(std::string_view kind, std::string_view extension) {
  // Every command comes here, and std::filesystem's iterator ends the program without memory.
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(data_folder(kind).c_str()), closedir);
  if (!folder && errno == ENOMEM) throw std::bad_alloc();
  std::vector<std::string> names;
  while (const dirent* const entry = folder ? readdir(folder.get()) : nullptr)
    if (const fs::path name = entry->d_name; name.extension() == extension)
      names.push_back(name.stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace dashpot
