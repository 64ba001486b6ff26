#pragma once
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

namespace dashpot {

/// What drawings name: data of one kind, in files of which some come with Dashpot.
template <class Thing>
struct NamedFiles {
  std::string what;    ///< "fluid"
  std::string folder;  ///< of the data that come with Dashpot
  Thing (*read)(const Value& value);
};

/// Whether the text names a file, and no thing that comes with Dashpot.
inline bool names_yaml_file(std::string_view text) {
  return text.ends_with(".yaml") || text.ends_with(".yml");
}

/// The thing of a name that comes with Dashpot, which is read once, or of a file relative to the
/// folder. Throws Error(where, "unknown fluid ...").
template <class Thing>
std::shared_ptr<const Thing> find_named(const NamedFiles<Thing>& files, std::string_view name,
                                        const std::string& where,
                                        const std::filesystem::path& folder) {
  const auto load = [&](const std::filesystem::path& path) {
    return std::make_shared<const Thing>(files.read(parse_yaml(read_file(path), path.string())));
  };
  if (names_yaml_file(name)) return load(folder / std::string(name));

  static std::mutex guard;
  static std::map<std::string, std::shared_ptr<const Thing>, std::less<>> known;
  const std::lock_guard lock(guard);
  if (const auto at = known.find(name); at != known.end()) return at->second;
  const std::vector<std::string> names = data_names(files.folder, ".yaml");
  if (std::ranges::find(names, name) == names.end())
    throw Error(where, "unknown " + files.what + " '" + std::string(name) + "'",
                suggest(name, names) + "; or a file, NAME.yaml");
  const std::string file = std::string(name) + ".yaml";
  return known[std::string(name)] = load(data_folder(files.folder) / file);
}

/// The words that stand in every such file: its name, which it must have, where its numbers come
/// from, and what is to be known of them.
template <class Thing>
void read_words(ObjectReader& reader, Thing& thing) {
  thing.name = reader.string("name");
  thing.source = reader.string("source", "");
  thing.note = reader.string("note", "");
}

/// An object that begins with these words.
template <class Thing>
Value words_json(const Thing& thing) {
  Value out = Value::object({{"name", thing.name}, {"source", thing.source}});
  if (!thing.note.empty()) out.add("note", thing.note);
  return out;
}

}  // namespace dashpot
