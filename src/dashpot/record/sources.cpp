#include "dashpot/record/sources.h"

#include <algorithm>
#include <optional>
#include <set>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

/// A file that cannot be looked at is none here: whoever needs it says so.
bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::size_t count_matches(const DatasetFile& stated, const std::vector<SourcePath>& files) {
  return static_cast<std::size_t>(
      std::count_if(files.begin(), files.end(),
                    [&](const SourcePath& f) { return statement_for(stated, f) != nullptr; }));
}

/// A file of that name and content in the folder of one of the files.
bool recognises(const DatasetFile& stated, const std::vector<SourcePath>& files) {
  std::set<fs::path> folders;
  for (const SourcePath& file : files) folders.insert(file.path.parent_path());
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    const fs::path candidate = folder / stated.recognise_file;
    return is_file(candidate) && sha256_of_file(candidate) == stated.recognise_sha256;
  });
}

/// The shipped dataset file that recognises the recordings and says most about them.
std::optional<DatasetFile> find_shipped(const std::vector<SourcePath>& files) {
  std::optional<DatasetFile> best;
  std::size_t most = 0;
  for (const fs::path& path : shipped_dataset_files()) {
    DatasetFile stated = load_dataset_file(path);
    const std::size_t count = count_matches(stated, files);
    if (stated.recognise_file.empty() || count <= most || !recognises(stated, files)) continue;
    most = count;
    best = std::move(stated);
  }
  return best;
}

/// Takes the dataset file out of the paths, or finds dataset.yaml in the only folder; empty when
/// there is none. Throws Error on a second one.
fs::path stated_dataset_file(std::vector<fs::path>& paths, const LoadOptions& options) {
  fs::path stated = options.dataset_file;
  for (auto at = paths.begin(); at != paths.end();) {
    const bool yaml = is_dataset_file(*at) && is_file(*at);
    if (yaml && !stated.empty())
      throw Error(at->string(), "is a second dataset file beside " + stated.string(), "give one");
    if (yaml) stated = *at;
    at = yaml ? paths.erase(at) : at + 1;
  }

  if (stated.empty() && paths.size() == 1 && is_file(paths[0] / "dataset.yaml"))
    stated = paths[0] / "dataset.yaml";
  return stated;
}

/// Without a statement every file is tried by its names.
DatasetFile nothing_stated(const std::vector<fs::path>& paths) {
  DatasetFile stated;
  fs::path first = fs::absolute(paths.front()).lexically_normal();
  if (first.filename().empty()) first = first.parent_path();
  stated.name = (fs::is_directory(first) ? first.filename() : without_gz(first).stem()).string();
  stated.files.emplace_back().match = {"*"};
  return stated;
}

}  // namespace

bool is_dataset_file(const fs::path& path) {
  const std::string extension = lower(path.extension().string());
  return extension == ".yaml" || extension == ".yml";
}

const FileStatement* statement_for(const DatasetFile& stated, const SourcePath& file) {
  for (const FileStatement& statement : stated.files)
    for (const std::string& pattern : statement.match)
      if (matches(pattern, file)) return &statement;
  return nullptr;
}

Sources find_sources(std::vector<fs::path> paths, const LoadOptions& options) {
  if (paths.empty() && options.dataset_file.empty())
    throw Error("", "no recordings given", "give files, folders or a dataset file");

  Sources sources;

  // A dataset file of the caller's, which may say where the recordings are.
  const fs::path stated = stated_dataset_file(paths, options);
  if (!stated.empty()) {
    sources.stated = load_dataset_file(stated);
    if (paths.empty()) paths = {sources.stated.root};

    sources.pointed_at = paths.front().string();
    sources.files = list_files(paths);
    return sources;
  }

  // None: perhaps a shipped dataset file knows these recordings by their content.
  sources.pointed_at = paths.front().string();
  sources.files = list_files(paths);
  if (options.recognise)
    if (auto shipped = find_shipped(sources.files)) {
      sources.stated = std::move(*shipped);
      sources.stated.notes.insert(sources.stated.notes.begin(),
                                  "recognised: understood as the dataset file " +
                                      fs::path(sources.stated.path).filename().string() +
                                      " states");
      return sources;
    }

  sources.stated = nothing_stated(paths);
  return sources;
}

std::vector<Sources> find_all_sources(const std::vector<fs::path>& paths,
                                      const LoadOptions& options) {
  const bool stated = !options.dataset_file.empty() ||
                      std::any_of(paths.begin(), paths.end(), [](const fs::path& path) {
                        return is_dataset_file(path) && is_file(path);
                      });
  const bool own = std::any_of(paths.begin(), paths.end(),
                               [](const fs::path& path) { return is_file(path / "dataset.yaml"); });
  std::vector<Sources> all;
  if (stated || !own || paths.size() < 2) {
    all.push_back(find_sources(paths, options));
    return all;
  }

  // Each by itself, once all are known to be different files.
  list_files(paths);
  for (const fs::path& path : paths) all.push_back(find_sources({path}, options));
  return all;
}

Manifest find_manifest(const Sources& sources) {
  const std::string name =
      sources.stated.manifest.empty() ? "manifest.csv" : sources.stated.manifest;
  for (const SourcePath& file : sources.files) {
    const fs::path candidate = file.path.parent_path() / name;
    if (is_file(candidate)) return Manifest(candidate);
  }
  if (!sources.stated.manifest.empty())
    throw Error(sources.stated.path, "its manifest '" + name + "' is not beside the recordings");
  return {};
}

}  // namespace dashpot
