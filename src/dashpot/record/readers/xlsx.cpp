#include "dashpot/record/readers/xlsx.h"

#include <algorithm>
#include <map>

#include <pugixml.hpp>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv.h"
#include "dashpot/record/readers/packed_parts.h"
#include "dashpot/record/readers/sheet_lines.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kMostSheets = 1000;

/// A sheet that is shown, and the part that holds it.
struct Sheet {
  std::string name, part;
};

struct Workbook {
  std::vector<Sheet> sheets;
  WorkbookWords words;
  std::vector<std::string> notes;
};

/// Small parts are read whole; large ones, of which there may be thousands of kilobytes, never are.
pugi::xml_document parse(const PackedParts& parts, const std::string& name,
                         const std::string& file) {
  pugi::xml_document document;
  const std::string text = parts.text(name);
  const auto result = document.load_buffer(text.data(), text.size());
  if (!result && !text.empty())
    throw Error(file + ", " + name, std::string("is damaged: ") + result.description(),
                "copy it again from its source, or save it anew");
  return document;
}

std::string_view local(const char* name) {
  const std::string_view all(name);
  return all.substr(all.find(':') + 1);
}

/// Calls `take` for every element of a name, whatever its namespace's prefix and its depth.
template <class Take>
void each(const pugi::xml_node& under, std::string_view name, Take take) {
  struct Walker : pugi::xml_tree_walker {
    Walker(std::string_view wanted, Take& given) : name(wanted), take(given) {}
    bool for_each(pugi::xml_node& node) override {
      if (local(node.name()) == name) take(node);
      return true;
    }
    std::string_view name;
    Take& take;
  } walker(name, take);
  pugi::xml_node(under).traverse(walker);
}

/// An attribute by its name without a namespace's prefix: "r:id" may be called otherwise.
std::string attribute(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute& at : node.attributes())
    if (local(at.name()) == name) return at.value();
  return {};
}

/// Whether a format code shows a date or a time: outside quotes, brackets and escapes it has a
/// letter of one. Hours beyond a day, "[h]", are a duration.
bool shows_clock(std::string_view code) {
  for (std::size_t k = 0; k < code.size() && code[k] != ';'; ++k) {
    if (code[k] == '"') {
      k = std::min(code.find('"', k + 1), code.size());
    } else if (code[k] == '\\' || code[k] == '_' || code[k] == '*') {
      ++k;
    } else if (code[k] == '[') {
      const std::size_t close = std::min(code.find(']', k), code.size());
      const std::string inside = lower(code.substr(k + 1, close - k - 1));
      if (!inside.empty() && inside.find_first_not_of("hms") == std::string::npos) return true;
      k = close;
    } else if (std::string_view("ydhmsYDHMS").find(code[k]) != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

/// Formats that have a number and no code in the file (ECMA-376, 18.8.30).
bool is_built_in_clock(int id) {
  return (id >= 14 && id <= 22) || (id >= 27 && id <= 36) || (id >= 45 && id <= 47) ||
         (id >= 50 && id <= 58);
}

/// By the number of a cell's style: <numFmts> and <cellXfs><xf numFmtId="14"/>...
std::vector<bool> read_clock_styles(const pugi::xml_document& styles) {
  std::map<int, bool> by_format;
  each(styles, "numFmt", [&](const pugi::xml_node& format) {
    by_format[format.attribute("numFmtId").as_int()] = shows_clock(attribute(format, "formatCode"));
  });
  std::vector<bool> is_clock;
  each(styles, "cellXfs", [&](const pugi::xml_node& formats) {
    for (const pugi::xml_node& format : formats.children()) {
      const int id = format.attribute("numFmtId").as_int();
      const auto stated = by_format.find(id);
      is_clock.push_back(stated != by_format.end() ? stated->second : is_built_in_clock(id));
    }
  });
  return is_clock;
}

/// "xl/worksheets/sheet1.xml" of a target "worksheets/sheet1.xml" or "/xl/worksheets/sheet1.xml".
std::string part_of_target(const std::string& target) {
  if (target.starts_with('/')) return target.substr(1);
  return (fs::path("xl") / target).lexically_normal().generic_string();
}

Workbook read_workbook(const PackedParts& parts, const std::string& file) {
  Workbook workbook;
  const std::string kBook = "xl/workbook.xml", kStrings = "xl/sharedStrings.xml";
  if (!parts.has(kBook))
    throw Error(file, "holds no " + kBook + ": it is no workbook, whatever its name says",
                "save it as XLSX or CSV");
  const pugi::xml_document book = parse(parts, kBook, file);

  // Which part holds which sheet, by the kind of the relation: charts are sheets, too.
  std::map<std::string, std::string> parts_of_sheets;
  each(parse(parts, "xl/_rels/workbook.xml.rels", file), "Relationship",
       [&](const pugi::xml_node& relation) {
         if (attribute(relation, "Type").ends_with("/worksheet"))
           parts_of_sheets[attribute(relation, "Id")] =
               part_of_target(attribute(relation, "Target"));
       });
  each(book, "sheet", [&](const pugi::xml_node& sheet) {
    const std::string name = attribute(sheet, "name");
    const auto part = parts_of_sheets.find(attribute(sheet, "id"));
    const std::string state = attribute(sheet, "state");
    if (part == parts_of_sheets.end()) return;
    if (!state.empty() && state != "visible")
      return workbook.notes.push_back("sheet '" + name + "' passed over: it is hidden");
    workbook.sheets.push_back({name, part->second});
  });
  if (workbook.sheets.size() > kMostSheets)
    throw Error(file, "has more than " + std::to_string(kMostSheets) + " sheets",
                "save those with recordings in a file of their own");

  // What the cells of all sheets refer to.
  each(book, "workbookPr", [&](const pugi::xml_node& properties) {
    const std::string from_1904 = attribute(properties, "date1904");
    workbook.words.from_1904 = from_1904 == "1" || from_1904 == "true";
  });
  workbook.words.is_clock = read_clock_styles(parse(parts, "xl/styles.xml", file));
  if (parts.has(kStrings))
    workbook.words.strings = read_shared_strings(parts.open(kStrings), file + ", " + kStrings);
  return workbook;
}

/// Tables that are short beside the longest are lists of settings and results.
void pass_over_short(std::vector<RawTable>& tables, std::vector<std::string>& notes) {
  std::size_t longest = 0;
  for (const RawTable& table : tables) longest = std::max(longest, table.rows());
  std::erase_if(tables, [&](const RawTable& table) {
    const bool is_short = 10 * table.rows() < longest;
    if (is_short)
      notes.push_back(table.part + " passed over: its rows of numbers are " +
                      std::to_string(table.rows()) + ", another's " + std::to_string(longest));
    return is_short;
  });
}

}  // namespace

bool is_xlsx(const fs::path&, std::string_view extension, std::string_view head) {
  return head.starts_with("PK\x03\x04") && (extension == ".xlsx" || extension == ".xlsm");
}

std::vector<RawTable> read_xlsx(const fs::path& path) {
  const std::string file = path.string();
  if (lower(path.extension().string()) == ".gz")
    throw Error(file, "is a packed workbook", "unpack it with gunzip first");
  const PackedParts parts(path);
  Workbook workbook = read_workbook(parts, file);

  // A table of each sheet that holds one.
  std::vector<RawTable> tables;
  for (const Sheet& sheet : workbook.sheets) {
    RawTable table;
    table.file = file;
    table.part_name = sheet.name;
    table.part = "sheet '" + sheet.name + "'";
    try {
      SheetLines lines(parts.open(sheet.part), table.place(), workbook.words);
      read_lines(lines, '\t', table);
      tables.push_back(std::move(table));
    } catch (const NoTable&) {
      workbook.notes.push_back("sheet '" + sheet.name + "' passed over: no table of numbers");
    }
  }
  if (tables.empty())
    throw NoTable(file, "no sheet holds numbers in columns",
                  "give a table: a row of names, then one row per sample");

  pass_over_short(tables, workbook.notes);
  for (std::size_t k = 0; k < tables.size(); ++k) tables[k].part_index = k;
  auto& notes = tables.front().notes;
  notes.insert(notes.begin(), workbook.notes.begin(), workbook.notes.end());
  return tables;
}

}  // namespace dashpot
