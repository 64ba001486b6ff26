#include "export_files.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>
#include <mutex>
#include <vector>

#include "child.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/export.h"
#include "dashpot/export/fmu/fmu.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

/// What an export may take; an FMU has a compiler inside.
constexpr ChildLimits kExporting{
    .memory = std::size_t{4} << 30, .cpu_seconds = 300, .file = std::size_t{256} << 20};
constexpr const char* kNoteFile = "studio.json";  // what was exported, by which command
constexpr std::size_t kMostBytes = std::size_t{256} << 20, kMostFiles = 1000;

std::mutex exports_mutex;  // one export is written or read at a time

/// "fits/run 1/models/bingham.json" becomes "run 1, bingham".
std::string export_folder(const std::string& model) {
  std::vector<std::string> parts;
  for (const fs::path& part : fs::path(model)) parts.push_back(part.string());
  return parts.at(1) + ", " + fs::path(model).stem().string();
}

/// A model among the results of the project.
fs::path model_file(const Project& project, const std::string& model) {
  const fs::path file = project.inside(model);
  for (const char* results : {"fits", "designs"}) {
    const std::vector<std::string> known = project.models(results);
    if (std::ranges::find(known, model) != known.end()) return file;
  }
  throw Error("'" + model + "'", "is no model of this project");
}

/// The report of the work that a model came of: it travels with what is exported of it.
void add_report(const fs::path& model, const fs::path& folder) {
  for (const char* name : {"report.html", "design.html"})
    if (const fs::path report = model.parent_path().parent_path() / name; fs::exists(report))
      write_file(folder / name, read_file(report));
}

/// A duration as it was typed; throws Error where it is none.
std::string checked_time(const std::string& text) {
  const double seconds = parse_quantity(text, "s", "sample time");
  if (!(seconds > 0 && seconds < 1)) throw Error("sample time", "is " + text, "as 1 ms");
  return text;
}

/// The files of an export below its folder, as names from it, in order.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->is_regular_file() && !at->is_symlink() && names.size() < kMostFiles &&
        at->path() != folder / kNoteFile)
      names.push_back(at->path().lexically_relative(folder).string());
  std::ranges::sort(names);
  return names;
}

/// What is said of an export: its note, and its files with their sizes.
Value described(const fs::path& folder) {
  const fs::path note = folder / kNoteFile;
  const Value said = parse_json(read_file(note), note.string());
  ObjectReader reader(said, "an export");
  Value files = Value::array();
  for (const std::string& name : files_below(folder)) {
    const auto bytes = static_cast<std::size_t>(fs::file_size(folder / name));
    files.push_back(Value::object({{"name", name}, {"bytes", bytes}}));
  }
  return Value::object({{"folder", folder.filename().string()},
                        {"model", reader.string("model")},
                        {"files", std::move(files)},
                        {"arguments", reader.required("arguments")}});
}

}  // namespace

Value export_model(const Project& project, const Value& asked) {
  // What is asked for, as words of the command.
  ObjectReader reader(asked, "an export");
  const std::string model = reader.string("model");
  const fs::path file = model_file(project, model);
  std::vector<std::string> formats;
  for (const Value& format : reader.required("formats").items())
    formats.emplace_back(find_exporter(format.as_string(), "formats").name);
  if (formats.empty()) throw Error("formats", "none is chosen");
  const std::string folder_name = export_folder(model);
  const fs::path folder = project.inside("exports/" + folder_name);
  std::vector<std::string> words{"export", file.string(), "--to", join(formats, ",")};
  if (const std::string name = reader.string("name", ""); !name.empty())
    words.insert(words.end(), {"--name", c_name(name)});
  if (const std::string precision = reader.string("precision", ""); !precision.empty()) {
    if (precision != "double" && precision != "float")
      throw Error("'" + precision + "'", "is no precision", "double or float");
    words.insert(words.end(), {"--precision", precision});
  }
  if (const std::string time = reader.string("sample_time", ""); !time.empty())
    words.insert(words.end(), {"--sample-time", checked_time(time)});
  reader.finish();
  words.insert(words.end(), {"--output", folder.string()});

  // An export takes the place of the one before.
  const std::lock_guard lock(exports_mutex);
  fs::remove_all(folder);
  project.make_result("exports", folder_name);
  const ChildEnd end = run_self(words, project.folder(), kExporting);
  if (end.exit_code != 0) throw Error("", project.without_folder(error_of(end)));
  add_report(file, folder);
  write_file(folder / kNoteFile,
             format_json(Value::object({{"model", model}, {"arguments", Value::array(words)}})));
  return described(folder);
}

Value exports(const Project& project) {
  using Entry = std::pair<fs::file_time_type, fs::path>;
  const std::lock_guard lock(exports_mutex);
  std::vector<Entry> all;
  std::error_code error;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(project.folder() / "exports", error))
    if (fs::exists(entry.path() / kNoteFile) && !entry.is_symlink())
      all.emplace_back(fs::last_write_time(entry.path() / kNoteFile), entry.path());
  std::ranges::sort(all, std::greater());
  Value list = Value::array();
  for (const auto& [time, folder] : all) try {
      list.push_back(described(folder));
    } catch (const Error&) {  // a note that nobody can read is no export of a studio
    }
  return list;
}

Download exported(const Project& project, const std::string& folder, const std::string& file) {
  const fs::path place = project.inside("exports/" + folder);
  const std::lock_guard lock(exports_mutex);
  const std::vector<std::string> names = files_below(place);
  if (!file.empty()) {
    if (std::ranges::find(names, file) == names.end())
      throw Error("'" + file + "'", "is no file of this export");
    return {fs::path(file).filename().string(), "application/octet-stream",
            read_file(project.inside("exports/" + folder + "/" + file))};
  }

  // All of them, as far as one archive goes.
  if (names.empty()) throw Error("'" + folder + "'", "is no export");
  std::vector<ExportedFile> files;
  std::size_t bytes = 0;
  for (const std::string& name : names) {
    bytes += fs::file_size(place / name);
    if (bytes > kMostBytes) throw Error("'" + folder + "'", "is too large for one archive");
    files.push_back({name, read_file(place / name)});
  }
  return {folder + ".zip", "application/zip", zip_archive(files, std::time(nullptr))};
}

}  // namespace dashpot::studio
