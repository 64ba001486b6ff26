#include "dashpot/record/correction.h"

#include <algorithm>
#include <fnmatch.h>
#include <optional>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/statement_text.h"
#include "dashpot/value.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::string_view kMark = "# corrected by hand: ";

/// An object whose members can be set and taken away.
class Members {
 public:
  explicit Members(const Value* value) {
    if (value && value->kind() == Value::Kind::Object) members_ = value->members();
  }
  const Value* find(std::string_view key) const {
    const auto at = std::ranges::find(members_, key, &Value::Member::first);
    return at == members_.end() ? nullptr : &at->second;
  }
  void set(const std::string& key, Value value) {
    const auto at = std::ranges::find(members_, key, &Value::Member::first);
    if (at == members_.end())
      members_.emplace_back(key, std::move(value));
    else
      at->second = std::move(value);
  }
  void drop(std::string_view key) {
    std::erase_if(members_, [&](const Value::Member& member) { return member.first == key; });
  }
  bool empty() const { return members_.empty(); }
  Value value() const { return Value::object(members_); }

 private:
  std::vector<Value::Member> members_;
};

/// A number where the text is one, else the text.
Value number_or_text(const std::string& text) {
  const auto number = parse_number(text);
  return number ? Value(*number) : Value(text);
}

double required_number(const Correction& correction) {
  const auto number = parse_number(correction.second);
  if (!number) throw Error(correction.first, "is '" + correction.second + "', not a number");
  return *number;
}

/// "force.unit" = "kN" in the channels of an entry; a channel stated by its column alone becomes an
/// object.
void correct_channel(Members& entry, const Correction& correction) {
  constexpr std::string_view kKeys[] = {"column", "unit",   "scale",      "offset",
                                        "sign",   "centre", "moving_mass"};
  const auto& [what, value] = correction;
  const std::size_t dot = what.rfind('.');
  const std::string channel = what.substr(0, dot), key = what.substr(dot + 1);
  if (std::ranges::find(kKeys, key) == std::end(kKeys))
    throw Error(what, "cannot be corrected",
                "of a channel: column, unit, scale, offset, sign, centre or moving_mass");

  Members channels(entry.find("channels"));
  const Value* stated = channels.find(channel);
  Members one(stated);
  if (stated && stated->kind() != Value::Kind::Object) one.set("column", *stated);
  if (value.empty())
    one.drop(key);
  else if (key == "unit" || key == "centre")
    one.set(key, Value(value));
  else
    one.set(key, key == "column" ? number_or_text(value) : Value(required_number(correction)));
  if (!one.find("column"))
    throw Error(what, "no column is taken for " + channel,
                "say first which: " + channel + ".column=NAME");
  channels.set(channel, one.value());
  entry.set("channels", channels.value());
}

void correct_cut(Members& entry, const Correction& correction) {
  const auto& [what, value] = correction;
  Members cut(entry.find("cut"));
  if (what == "rest") {
    if (value != "drop" && value != "keep")
      throw Error(what, "is '" + value + "'", "it can be 'drop' or 'keep'");
    value == "drop" ? cut.set("rest", Value(true)) : cut.drop("rest");
  } else {
    cut.drop("from");
    cut.drop("to");
    const std::size_t colon = value.find(':');
    if (value != "none" && colon == std::string::npos)
      throw Error(what, "is '" + value + "'", "two times in s, as 0.5:3, or none");
    if (value != "none" && colon > 0)
      cut.set("from", required_number({what, value.substr(0, colon)}));
    if (value != "none" && colon + 1 < value.size())
      cut.set("to", required_number({what, value.substr(colon + 1)}));
  }
  cut.empty() ? entry.drop("cut") : entry.set("cut", cut.value());
}

void correct(Members& entry, const Correction& correction) {
  const auto& [what, value] = correction;
  if (what.find('.') != std::string::npos) {
    correct_channel(entry, correction);
  } else if (what == "cut" || what == "rest") {
    correct_cut(entry, correction);
  } else if (what == "level" || what == "velocity_cutoff") {
    entry.set(what, required_number(correction));
  } else if (what == "sample_rate") {
    entry.set("time", Value::object({{what, required_number(correction)}}));
  } else if (what == "condition" || what == "name") {
    entry.set(what, Value(value));
  } else if (value == "none" && entry.find("channels") && entry.find("channels")->find(what)) {
    Members channels(entry.find("channels"));
    channels.drop(what);
    entry.set("channels", channels.value());
  } else {
    throw Error(what, "cannot be corrected",
                "CHANNEL.column, .unit, .sign ..., CHANNEL=none, level, cut, rest, sample_rate, "
                "velocity_cutoff, condition or name");
  }
}

/// What the text says of a file: the keys of the first entry that matches it.
Members stated_entry(const std::string& text, const std::string& file) {
  if (text.empty()) return Members(nullptr);
  const Value root = parse_yaml(text, "dataset.yaml");
  const Value* files = root.find("files");
  if (!files) return Members(nullptr);
  const std::string bare = fs::path(file).filename().string();
  for (const Value& entry : files->items()) {
    const Value* match = entry.find("match");
    if (!match) continue;
    const std::vector<Value> patterns =
        match->kind() == Value::Kind::Array ? match->items() : std::vector{*match};
    for (const Value& pattern : patterns)
      for (const std::string& name : {file, bare})
        if (fnmatch(pattern.as_string().c_str(), name.c_str(), 0) == 0) return Members(&entry);
  }
  return Members(nullptr);
}

/// Without a unit of the drive a level says nothing, and would be written without effect.
void require_drive(const std::string& text, const Dataset& dataset,
                   const std::vector<Correction>& corrections) {
  if (std::ranges::find(corrections, "level", &Correction::first) == corrections.end()) return;
  const Value root = text.empty() ? Value() : parse_yaml(text, "dataset.yaml");
  const Value* stated = root.kind() == Value::Kind::Object ? root.find("drive") : nullptr;
  const bool is_none = stated
                           ? stated->kind() == Value::Kind::String && stated->as_string() == "none"
                           : dataset.drive_unit == DriveUnit::None;
  if (is_none)
    throw Error("level",
                stated ? "has no effect beside 'drive: none' in dataset.yaml"
                       : "has no effect: no record tells whether the drive is a current "
                         "or a voltage",
                stated ? "write 'drive: A' or 'drive: V' there first"
                       : "have a dataset file written (--write-dataset), and say 'drive: A' or "
                         "'drive: V' in it first");
}

/// JSON on one line, which is YAML.
std::string flow(const Value& value) {
  std::string text = format_json(value, false);
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

/// A pattern for this file alone: what would be a pattern in its name may be any one character.
std::string pattern_for(std::string file) {
  for (char& c : file)
    if (c == '*' || c == '[' || c == ']') c = '?';
  return file;
}

/// The entry as lines behind `indent`.
std::string entry_lines(const Members& entry, const std::string& file, const std::string& indent) {
  std::string text = indent + std::string(kMark) + yaml_comment(file) + "\n" + indent +
                     "- match: " + yaml_string(pattern_for(file)) + "\n";
  const Value all = entry.value();
  for (const auto& [key, value] : all.members()) {
    if (key == "match") continue;
    if (key != "channels") {
      text += indent + "  " + key + ": " + flow(value) + "\n";
      continue;
    }
    text += indent + "  channels:\n";
    for (const auto& [channel, stated] : value.members())
      text += indent + "    " + yaml_string(channel) + ": " + flow(stated) + "\n";
  }
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::size_t indent_of(const std::string& line) { return line.find_first_not_of(' '); }

/// The text with `entry` (which makes lines behind an indentation) as the first of its entries, in
/// place of an earlier correction of this file.
std::string with_entry(const std::string& text, const Members& entry, const std::string& file) {
  // Find the list of entries and how far it is indented.
  std::vector<std::string> lines = lines_of(text);
  const auto files = std::ranges::find_if(lines, [](const std::string& line) {
    return line.starts_with("files:") && trim(line.substr(6)).empty();
  });
  const auto first =
      files == lines.end() ? lines.end() : std::find_if(files + 1, lines.end(), [](const auto& l) {
        return trim(l).starts_with("- ");
      });
  if (first == lines.end())
    throw Error("dataset.yaml", "its 'files' are not entries one below the other",
                "begin each entry on a line of its own with '- match:'");
  const std::string indent(indent_of(*first), ' ');

  // Take an earlier correction of this file out: its mark, and what is indented behind it.
  const std::string mark = indent + std::string(kMark) + yaml_comment(file);
  const auto place = files + 1 - lines.begin();
  if (const auto old = std::ranges::find(lines, mark);
      old != lines.end() && old + 1 < lines.end()) {
    auto end = old + 2;
    while (end != lines.end() && indent_of(*end) != std::string::npos &&
           indent_of(*end) > indent.size())
      ++end;
    lines.erase(old, end);
  }

  std::string out;
  for (std::size_t k = 0; k <= lines.size(); ++k) {
    if (static_cast<std::ptrdiff_t>(k) == place) out += entry_lines(entry, file, indent);
    if (k < lines.size()) out += lines[k] + "\n";
  }
  return out;
}

}  // namespace

std::vector<Correction> parse_corrections(const std::string& text) {
  std::vector<Correction> corrections;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    const std::string part(trim(std::string_view(text).substr(at, end - at)));
    at = end + 1;
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error("'" + part + "'", "is no correction", "as force.unit=kN; level=0.5");
    corrections.emplace_back(trim(std::string_view(part).substr(0, equals)),
                             trim(std::string_view(part).substr(equals + 1)));
  }
  if (corrections.empty()) throw Error("", "no correction is given", "as force.unit=kN; level=0.5");
  return corrections;
}

std::string corrected_statement(const std::string& text, const Dataset& dataset,
                                const fs::path& folder, const std::string& file,
                                const std::vector<Correction>& corrections) {
  const fs::path path = (folder / file).lexically_normal();
  const auto source = std::ranges::find_if(dataset.files, [&](const SourceFile& one) {
    return fs::path(one.path).lexically_normal() == path;
  });

  require_drive(text, dataset, corrections);

  // What was understood of the file, and over it what the text says of it already.
  const bool is_understood = source != dataset.files.end();
  const Value understood =
      is_understood ? parse_yaml("entry:\n" + file_statement_text(dataset, source->path), file)
                    : Value::object();
  Members entry(is_understood ? understood.find("entry") : nullptr);
  const Members stated = stated_entry(text, file);
  if (!is_understood && !stated.find("channels"))
    throw Error(file, "gave no record, so that there is nothing to correct yet",
                "'dashpot inspect' says why; write a dataset file by hand");
  const Value said = stated.value();
  for (const auto& [key, value] : said.members()) entry.set(key, value);
  for (const Correction& correction : corrections) correct(entry, correction);

  // A text that is not there yet states what was understood of all files.
  if (!text.empty()) return with_entry(text, entry, file);
  const std::string fresh =
      statement_text(dataset, folder, folder) +
      "  # Files that come later are understood as without this dataset file.\n  - match: '*'\n";
  return with_entry(fresh, entry, file);
}

}  // namespace dashpot
