#include "dashpot/record/source_files.h"

#include <algorithm>
#include <cstring>
#include <fnmatch.h>
#include <map>
#include <set>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/readers/csv.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

/// A folder that holds a file of this name is not searched: results lie there, no recordings.
constexpr std::string_view kNoRecordings = ".no-recordings";

/// Lists the files below a folder. Folders behind links are searched too, each folder once, so that
/// a link to a folder above ends the search instead of turning it in circles.
class FolderSearch {
 public:
  FolderSearch(const fs::path& root, std::vector<SourcePath>& out) : root_(root), out_(out) {
    search(root);
  }

 private:
  void search(const fs::path& folder) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (!error && !seen_.insert(real).second) return;
    if (folder != root_ && fs::exists(folder / kNoRecordings, error)) return;
    fs::directory_iterator at(folder, error), end;
    for (; !error && at != end; at.increment(error)) take(at->path());
    if (error) throw Error(folder.string(), "cannot be read: " + error.message());
  }

  void take(const fs::path& path) {
    if (path.filename().string().starts_with(".")) return;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
      throw Error(path.string(), "is a link to what is not there",
                  "fetch the file, or remove the link");
    if (!fs::status_known(status)) throw Error(path.string(), "cannot be read: " + error.message());
    if (fs::is_directory(status)) return search(path);
    out_.push_back({path, path.lexically_relative(root_).string(), false});
  }

  fs::path root_;
  std::vector<SourcePath>& out_;
  std::set<fs::path> seen_;
};

/// Order of names with numbers by their value. strverscmp puts leading zeros first, which file
/// names want too: run01 before run1.
bool by_number(const SourcePath& a, const SourcePath& b) {
  return strverscmp(a.relative.c_str(), b.relative.c_str()) < 0;
}

/// Throws where two paths lead to one file: a recording that is there twice could be fitted and
/// then judged on as if it had not been seen.
void refuse_doubles(const std::vector<SourcePath>& files) {
  std::map<fs::path, fs::path> seen;
  for (const SourcePath& file : files) {
    std::error_code ignored;
    const auto [at, is_new] = seen.emplace(fs::canonical(file.path, ignored), file.path);
    if (!is_new && !at->first.empty())
      throw Error(file.path.string(), "is the same file as " + at->second.string(), "give it once");
  }
}

}  // namespace

std::vector<SourcePath> list_files(const std::vector<fs::path>& paths) {
  std::vector<SourcePath> out;
  for (const fs::path& path : paths) {
    if (path.empty()) throw Error("", "a path is empty", "give files, folders or a dataset file");

    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
      throw Error(path.string(), error && error != std::errc::no_such_file_or_directory
                                     ? "cannot be read: " + error.message()
                                     : "there is no such file or folder");

    if (!fs::is_directory(status)) {
      out.push_back({path, path.filename().string(), true});
      continue;
    }

    std::vector<SourcePath> inside;
    FolderSearch(path, inside);
    std::sort(inside.begin(), inside.end(), by_number);
    out.insert(out.end(), inside.begin(), inside.end());
  }
  refuse_doubles(out);
  return out;
}

void mark_without_recordings(const fs::path& folder) {
  const fs::path mark = folder / kNoRecordings;
  if (!fs::exists(mark)) write_file(mark, "");
}

bool matches(const std::string& pattern, const SourcePath& file) {
  return fnmatch(pattern.c_str(), file.relative.c_str(), 0) == 0 ||
         fnmatch(pattern.c_str(), file.path.filename().c_str(), 0) == 0;
}

Manifest::Manifest(const fs::path& path) : path_(path.string()) {
  TextTable table = read_text_table(path);
  names_ = std::move(table.names);
  rows_ = std::move(table.rows);
  lines_ = std::move(table.lines);
  decimal_ = table.decimal;
  const auto at = std::find(names_.begin(), names_.end(), "file");
  if (at == names_.end())
    throw Error(path_, "has no column 'file'",
                "its first line names the columns, one of them 'file'");
  file_column_ = static_cast<std::size_t>(at - names_.begin());

  // Of two rows that differ none is known to be the right one.
  std::map<std::string, std::size_t> first;
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (const auto [told, is_new] = first.emplace(listed_file(k), k);
        !is_new && rows_[told->second] != rows_[k])
      throw Error(path_ + ':' + std::to_string(lines_[k]),
                  told->first + " stands in line " + std::to_string(lines_[told->second]) +
                      ", too, with other values",
                  "one row for each file");
}

std::string Manifest::listed_file(std::size_t row) const {
  std::string listed = rows_[row][file_column_];
  std::replace(listed.begin(), listed.end(), '\\', '/');
  return fs::path(listed).lexically_normal().string();
}

std::optional<std::size_t> Manifest::row_of(const SourcePath& file) const {
  if (rows_.empty()) return std::nullopt;
  const fs::path here = fs::absolute(path_).lexically_normal().parent_path();
  const std::string below = fs::absolute(file.path).lexically_normal().lexically_relative(here);
  const std::string name = file.path.filename().string();
  std::optional<std::size_t> by_name;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const std::string listed = listed_file(k);
    if (listed == below || listed == file.relative) return k;
    if (listed == name && !by_name) by_name = k;
  }
  return by_name;
}

std::optional<std::string> Manifest::cell(const SourcePath& file, const std::string& column) const {
  const auto row = row_of(file);
  const auto at = std::find(names_.begin(), names_.end(), column);
  if (!row || at == names_.end()) return std::nullopt;
  return rows_[*row][static_cast<std::size_t>(at - names_.begin())];
}

double Manifest::number(const SourcePath& file, const std::string& column) const {
  const auto text = cell(file, column);
  if (!text)
    throw Error(path_, "has no '" + column + "' for " + file.relative,
                "its columns are " + join(names_, ", "));
  const auto value = parse_number(*text, decimal_);
  if (!value)
    throw Error(path_, "'" + column + "' of " + file.relative + " is '" + *text +
                           "', not a number" +
                           (decimal_ == ',' ? ": its numbers have decimal commas" : ""));
  return *value;
}

bool Manifest::holds_numbers(const std::string& column) const {
  const auto at = static_cast<std::size_t>(std::ranges::find(names_, column) - names_.begin());
  return std::ranges::all_of(
      rows_, [&](const auto& row) { return parse_number(row[at], decimal_).has_value(); });
}

std::vector<std::string> Manifest::missing_files(const std::vector<SourcePath>& files) const {
  std::set<std::size_t> found;
  for (const SourcePath& file : files)
    if (const auto row = row_of(file)) found.insert(*row);
  std::vector<std::string> missing;
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (const std::string listed = listed_file(k); !found.contains(k))
      if (!fs::exists(fs::path(path_).parent_path() / listed))
        missing.push_back("'" + listed + "' (line " + std::to_string(lines_[k]) + ")");
  return missing;
}

double Manifest::level(const SourcePath& file, const std::string& column) const {
  // The unit that the column's name holds, whatever else it is called: "lev [mA]".
  NamedChannel named = recognise_channel(column, "");
  if (named.channel.empty())
    if (const std::size_t bracket = column.find_first_of("[("); bracket != std::string::npos)
      named = recognise_channel("current " + column.substr(bracket), "");
  if (!named.problem.empty()) throw Error(path_, "column '" + column + "' has " + named.problem);
  const double value = number(file, column);
  const auto unit = parse_unit(named.unit);
  return unit ? unit->factor * value : value;
}

std::optional<std::pair<std::string, DriveUnit>> Manifest::level_column() const {
  for (const std::string& name : names_) {
    const std::string channel = recognise_channel(name, "").channel;
    if (channel == "current" || channel == "voltage")
      return std::pair(name, channel == "current" ? DriveUnit::Ampere : DriveUnit::Volt);
  }
  return std::nullopt;
}

}  // namespace dashpot
