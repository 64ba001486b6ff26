#include "dashpot/base/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// A kind of file: by how its format begins, or else by keys of which no other kind has all.
struct FileKind {
  std::string_view what, format;
  std::vector<std::string_view> keys;
  std::string_view right;  ///< where such files come from
};

/// The first row that fits a document is its kind.
const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> kinds{
      {"a model file", "dashpot-model", {}, "one that 'dashpot identify' wrote: models/NAME.json"},
      {"a file of an inverse", "dashpot-inverse", {}, "one that 'dashpot invert' wrote"},
      {"a report", "dashpot report", {}, ""},
      {"the results of a search", "dashpot search", {}, ""},
      {"the results of a design", "dashpot design", {}, ""},
      {"a parameter set", "", {"model", "drive_range"}, "one like those of data/parameters"},
      {"a plant with its sensors", "", {"plant", "inputs"}, "docs/in-plant.md"},
      {"a sweep", "", {"plant", "road", "vary"}, "docs/sweep.md"},
      {"a plant", "", {"plant", "parameters", "verified"}, "one like those of data/plants"},
      {"a plant", "", {"matrices", "title"}, "one like those of data/plants"},
      {"a dataset file", "", {"files"}, "docs/dataset-files.md"},
      {"a design request", "", {"damper", "vary"}, "docs/design.md"},
      {"a damper description", "", {"gap", "pole_length"}, "docs/physics.md"},
      {"a fluid", "", {"density", "laws"}, "one like those of data/fluids"},
      {"a steel", "", {"name", "points"}, "one like those of data/steels"},
      {"the file of a law", "", {"law", "parameters"}, "docs/laws-from-a-file.md"}};
  return kinds;
}

bool fits(const FileKind& kind, const Value& document) {
  const Value* format = document.find("format");
  if (!kind.format.empty())
    return format && format->kind() == Value::Kind::String &&
           format->as_string().starts_with(kind.format);
  return std::ranges::all_of(kind.keys,
                             [&](std::string_view key) { return document.find(key) != nullptr; });
}

Error wrong_kind(const std::string& where, const std::string& problem, const std::string& what) {
  const auto wanted = std::ranges::find(file_kinds(), what, &FileKind::what);
  return {where, problem, wanted == file_kinds().end() ? "" : std::string(wanted->right)};
}

}  // namespace

std::string file_kind(const Value& document) {
  if (document.kind() != Value::Kind::Object) return {};
  for (const FileKind& kind : file_kinds())
    if (fits(kind, document)) return std::string(kind.what);
  return {};
}

void refuse_other_kind(const Value& document, const std::string& what) {
  const std::string kind = file_kind(document);
  if (!kind.empty() && kind != what)
    throw wrong_kind(document.where(), "is " + kind + ", not " + what, what);
}

Value parse_json_of(std::string_view text, const std::string& source, const std::string& what) {
  // Words, comments and tables begin with what no JSON does.
  const std::string_view begin = trim(text.substr(0, 100));
  const bool is_other =
      !begin.empty() && begin.front() != '{' && begin.front() != '[' &&
      (std::isalpha(static_cast<unsigned char>(begin.front())) || begin.front() == '#');
  if (!is_other) {
    Value document = parse_json(text, source);
    refuse_other_kind(document, what);
    return document;
  }

  // A file of YAML may be another one of Dashpot's.
  std::string kind;
  try {
    kind = file_kind(parse_yaml(text, source));
  } catch (const Error&) {
    kind.clear();
  }
  throw wrong_kind(source,
                   "is " + (kind.empty() ? "no JSON, as " + what + " is" : kind + ", not " + what),
                   what);
}

}  // namespace dashpot
