#include "project.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/file.h>

#include "child.h"
#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/record/source_files.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

/// What reading may take: enough for 10^7 samples of six channels.
constexpr ChildLimits kReading{
    .memory = std::size_t{6} << 30, .cpu_seconds = 120, .file = std::size_t{2} << 30};
/// What running a model over the recordings may take.
constexpr ChildLimits kRunning{
    .memory = std::size_t{6} << 30, .cpu_seconds = 600, .file = std::size_t{2} << 30};

/// The parts of the folder that hold results.
constexpr std::array<std::string_view, 4> kResultFolders{"fits", "rides", "designs", "exports"};

bool is_result_folder(std::string_view name) {
  return std::ranges::find(kResultFolders, name) != kResultFolders.end();
}

}  // namespace

bool is_plain_name(std::string_view name) {
  constexpr std::size_t kLongest = 120;
  if (name.empty() || name.size() > kLongest || name.front() == '.' || name.front() == '-')
    return false;
  return std::ranges::none_of(name, [](char c) {
    return static_cast<unsigned char>(c) < 32 || c == 127 || c == '/' || c == '\\';
  });
}

std::string error_of(const ChildEnd& end) {
  constexpr std::string_view kLabel = "error: ";
  const std::size_t at = end.err.rfind(kLabel);
  if (at != std::string::npos) {
    std::string text = end.err.substr(at + kLabel.size());
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }
  if (end.exit_code > 128)
    return "it took more memory or time than it may (signal " +
           std::to_string(end.exit_code - 128) + ")";
  return "it ended with " + std::to_string(end.exit_code);
}

fs::path Project::make_result(std::string_view results, const std::string& name) const {
  mark_without_recordings(folder_ / results);
  const fs::path folder = inside(std::string(results) + "/" + name);
  make_folder(folder);
  return folder;
}

std::string Project::without_folder(std::string text) const {
  const std::string before = folder_.string() + "/";
  for (std::size_t at; (at = text.find(before)) != std::string::npos;)
    text.erase(at, before.size());
  return text;
}

Project::Project(const fs::path& folder) {
  // A misspelt name must not become a project that holds nothing.
  if (std::error_code none; !fs::is_directory(folder, none))
    throw Error(folder.string(), "is no folder",
                "name that of the recordings, or make an empty one for a new project (mkdir)");
  folder_ = fs::canonical(folder);
  make_folder(folder_ / ".studio");
  mark_without_recordings(folder_ / "fits");

  lock_ =
      open((folder_ / ".studio" / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (lock_ < 0) throw Error(folder_.string(), std::strerror(errno));
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw Error(folder_.string(), "another studio has this folder open",
                "go on there, or end it first");
  }
}

Project::~Project() {
  if (lock_ >= 0) close(lock_);
}

fs::path Project::inside(const std::string& relative) const {
  fs::path path = folder_;
  std::size_t parts = 0;
  for (const fs::path& part : fs::path(relative)) {
    constexpr std::size_t kDeepest = 8;
    if (!is_plain_name(part.string()) || ++parts > kDeepest)
      throw Error("'" + relative + "'", "is no name in this project", kPlainName);
    path /= part;
    if (fs::is_symlink(path)) throw Error("'" + relative + "'", "is a link");
  }
  if (parts == 0) throw Error("", "a name is empty");
  return path;
}

std::string Project::fingerprint() const {
  // Names, sizes and times of everything that may be a recording.
  std::string text;
  std::error_code error;
  fs::recursive_directory_iterator at(folder_, fs::directory_options::skip_permission_denied,
                                      error),
      end;
  for (; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const bool is_own = at.depth() == 0 && (name == ".studio" || is_result_folder(name));
    if (at->is_directory(error)) {
      if (is_own || name.starts_with('.')) at.disable_recursion_pending();
      continue;
    }
    if (name.starts_with('.')) continue;
    text += fmt::format("{} {} {}\n", at->path().string(), at->file_size(error),
                        at->last_write_time(error).time_since_epoch().count());
  }
  return sha256(text);
}

Value Project::recordings() {
  const std::lock_guard lock(mutex_);
  const std::string now = fingerprint();
  if (now == known_fingerprint_) return known_;

  // The child reads all of them and leaves their samples to be drawn.
  const ChildEnd end =
      run_self({"inspect", folder_.string(), "--json", "--quiet", "--samples", samples().string()},
               folder_, kReading);
  constexpr int kFilesUnread = 4;
  Value value = Value::object();
  if (end.exit_code == 0 || end.exit_code == kFilesUnread) {
    value = parse_json(end.out, "dashpot inspect");
    const fs::path index = samples() / "samples.json";
    const Value drawn = parse_json(read_file(index), index.string());
    for (const char* key : {"unread", "suspects"})
      if (const Value* list = drawn.find(key)) value.add(key, *list);
  } else {
    value.add("error", without_folder(error_of(end)));
  }
  value.add("folder", folder_.string());
  value.add("dataset_file", fs::exists(folder_ / "dataset.yaml"));
  known_ = value;
  known_fingerprint_ = now;
  return value;
}

Value Project::correct(const std::string& file, const std::string& corrections) {
  const std::lock_guard lock(mutex_);
  inside(file);
  const ChildEnd end =
      run_self({"inspect", folder_.string(), "--quiet", "--correct", file, "--set", corrections},
               folder_, kReading);
  constexpr int kFilesUnread = 4;
  if (end.exit_code == 0 || end.exit_code == kFilesUnread) return Value::object({{"done", true}});
  return Value::object({{"error", without_folder(error_of(end))}});
}

fs::path Project::incoming() const {
  static std::atomic<unsigned> count = 0;
  make_folder(folder_ / ".studio" / "incoming");
  return folder_ / ".studio" / "incoming" / std::to_string(count++);
}

void Project::take_in(const fs::path& incoming, const std::string& name) {
  inside(name);
  const fs::path place = inside("recordings/" + name);
  make_folder(place.parent_path());
  // A link of the new content to its name fails where the name is taken.
  if (link(incoming.c_str(), place.c_str()) != 0) {
    if (errno != EEXIST) throw Error(name, std::strerror(errno));
    if (!fs::is_regular_file(place) || sha256_of_file(place) != sha256_of_file(incoming))
      throw Error(name, "a file of this name and another content is there already",
                  "rename one of them");
  }
}

Value Project::costs() {
  const std::lock_guard lock(mutex_);
  const std::string now = fingerprint();
  if (now == fingerprint_of_costs_) return known_costs_;
  const ChildEnd end =
      run_self({"rank", folder_.string(), "--models", "all", "--costs", "--json", "--quiet"},
               folder_, kReading);
  Value list = Value::array();
  if (!end.out.empty()) {
    const Value said = parse_json(end.out, "dashpot rank");
    if (const Value* costs = said.find("costs")) list = *costs;
  }
  known_costs_ = list;
  fingerprint_of_costs_ = now;
  return list;
}

std::vector<std::string> Project::models(std::string_view results) const {
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& result : fs::directory_iterator(folder_ / results, error)) {
    std::error_code none;
    for (const fs::directory_entry& model : fs::directory_iterator(result.path() / "models", none))
      if (model.path().extension() == ".json")
        found.push_back(model.path().lexically_relative(folder_).string());
  }
  std::ranges::sort(found);
  return found;
}

fs::path Project::traces(const std::string& model) {
  const fs::path file = inside(model);
  const std::string key = sha256(sha256_of_file(file) + fingerprint());
  const fs::path place = folder_ / ".studio" / "traces" / key.substr(0, 32);

  const std::lock_guard lock(mutex_);
  if (fs::exists(place / "samples.json")) return place;
  const ChildEnd end = run_self({"evaluate", file.string(), folder_.string(), "--quiet", "--traces",
                                 "raw", "--output", place.string()},
                                folder_, kRunning);
  if (!fs::exists(place / "samples.json")) throw Error("", without_folder(error_of(end)));
  return place;
}

fs::path Project::module(const std::string& model) {
  const fs::path file = inside(model);
  const fs::path place =
      folder_ / ".studio" / "modules" / sha256_of_file(file).substr(0, 32) / "model.mjs";

  const std::lock_guard lock(mutex_);
  if (fs::exists(place)) return place;
  const ChildEnd end = run_self({"export", file.string(), "--to", "js", "--name", "model",
                                 "--quiet", "--output", place.parent_path().string()},
                                folder_, kReading);
  if (!fs::exists(place)) throw Error("", without_folder(error_of(end)));
  return place;
}

}  // namespace dashpot::studio
