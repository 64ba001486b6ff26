#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A file format: recognises a file and turns it into tables. `head` is the beginning of the file
/// (gunzipped, at most 4 KiB) and `extension` its lower-case extension without ".gz". `read` gives
/// what the file holds, in the units and signs of the file: what columns mean is decided later, by
/// columns.h.
struct Reader {
  std::string_view name;
  std::string_view extensions;  ///< what folders are searched for, for people: ".csv .txt"
  bool (*recognises)(const std::filesystem::path& path, std::string_view extension,
                     std::string_view head);
  std::vector<RawTable> (*read)(const std::filesystem::path& path);
};

/// All formats; the first that recognises a file reads it, so the most telling come first.
std::span<const Reader> readers();

/// The path without ".gz": "run3.csv" of "run3.csv.gz".
std::filesystem::path without_gz(const std::filesystem::path& path);

/// The reader of a file, or nullptr when none recognises it. Throws Error when it cannot be opened.
const Reader* find_reader(const std::filesystem::path& path);

/// Reads a recording. Throws Error when it is empty, damaged or of no known format.
std::vector<RawTable> read_tables(const std::filesystem::path& path);

/// "CSV (.csv .txt ...), DAQ text log (...), ...", for messages.
std::string known_formats();

}  // namespace dashpot
