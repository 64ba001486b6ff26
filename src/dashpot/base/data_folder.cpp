#include "dashpot/base/data_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <dirent.h>
#include <dlfcn.h>

namespace fs = std::filesystem;

namespace dashpot {

namespace {

/// Folders in which the data may lie, the best first: where the user says; beside the program or
/// shared library that runs, as an installation (which may have been moved) or a Python package has
/// it; in the source; where it was to be installed.
std::vector<fs::path> find_roots() {
  std::vector<fs::path> roots;
  if (const char* stated = std::getenv("DASHPOT_DATA")) roots.emplace_back(stated);
  Dl_info here;
  std::error_code unknown;
  if (dladdr(reinterpret_cast<const void*>(&find_roots), &here) != 0 && here.dli_fname) {
    // A program's own name may be relative to a folder that it has left.
    fs::path code = fs::read_symlink("/proc/self/exe", unknown);
    if (fs::path(here.dli_fname).filename() != code.filename())
      code = fs::absolute(here.dli_fname, unknown);
    const fs::path folder = code.parent_path();
    for (const fs::path& root :
         {folder / "data", folder / "../share/dashpot", folder / "../../share/dashpot"})
      roots.push_back(root.lexically_normal());
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
