// A document as Markdown.
#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/report/document.h"

namespace dashpot {
namespace {

class Writer {
 public:
  Writer(Document document, const std::string& figures, int level)
      : document_(std::move(document)),
        figures_(figures),
        heading_(static_cast<std::size_t>(level), '#') {}

  std::string text() {
    text_ = heading_ + " " + markdown_cell(document_.title) + "\n";
    for (const std::string* words : {&document_.subtitle, &document_.verdict})
      if (!words->empty()) text_ += "\n" + markdown_prose(*words) + "\n";
    for (const DocumentSection& part : document_.sections)
      if (reaches(part.audience, Audience::Markdown)) section(part);
    if (const DocumentSection& last = document_.provenance; has_words(last)) section(last);
    if (!document_.command.empty())
      text_ += "\nMade by " + markdown_code(document_.command) + " (Dashpot " + document_.version +
               ").\n";
    return std::move(text_);
  }

 private:
  static bool has_words(const DocumentSection& section) {
    return !section.facts.empty() || !section.tables.empty() || !section.lists.empty();
  }

  void section(const DocumentSection& section) {
    text_ += "\n" + heading_ + "# " + markdown_cell(section.title) + "\n";
    for (const std::string& paragraph : section.paragraphs)
      text_ += "\n" + markdown_prose(paragraph) + "\n";
    if (!section.plain.empty()) text_ += "\n" + markdown_block(section.plain);
    parts(section, {});
    for (const DocumentFigure& one : section.figures)
      if (reaches(one.audience, Audience::Markdown)) figure(one);
    if (!section.remarks.empty()) text_ += "\n";
    for (const std::string& remark : section.remarks) text_ += "* " + markdown_prose(remark) + "\n";

    // Parts that depend on a choice follow, option by option.
    for (const DocumentSection& other : document_.sections)
      for (const DocumentChoice& choice : other.choices)
        for (std::size_t k = 0; k < choice.options.size(); ++k) option(section, choice, k);

    if (!section.facts.empty()) text_ += "\n";
    for (const auto& [name, meaning] : section.facts)
      if (!meaning.empty())
        text_ += "* " + markdown_cell(name) + ": " + markdown_prose(meaning) + "\n";
  }

  void option(const DocumentSection& section, const DocumentChoice& choice, std::size_t k) {
    const std::size_t before = text_.size();
    const std::string title = "\n" + heading_ + "## " + markdown_cell(choice.options[k]) + "\n";
    text_ += title;
    parts(section, {{choice.name, {k}}});
    if (text_.size() == before + title.size()) text_.resize(before);
  }

  /// Tables and lists that have exactly this condition.
  void parts(const DocumentSection& section, const When& when) {
    const auto is_shown = [&](const auto& part) {
      return reaches(part.audience, Audience::Markdown) && part.when == when;
    };
    for (const DocumentTable& one : section.tables)
      if (is_shown(one)) table(one);
    for (const DocumentList& list : section.lists)
      if (is_shown(list) && !list.lines.empty()) {
        text_ += list.title.empty() ? "\n" : "\n**" + markdown_cell(list.title) + "**\n\n";
        for (const std::string& line : list.lines) text_ += "* " + markdown_cell(line) + "\n";
      }
  }

  void table(const DocumentTable& table) {
    if (!table.title.empty()) text_ += "\n**" + markdown_cell(table.title) + "**\n";
    text_ += "\n" + markdown_table(table.columns, table.rows);
    if (!table.note.empty()) text_ += "\n" + markdown_prose(table.note) + "\n";
  }

  void figure(const DocumentFigure& figure) {
    const std::string words = markdown_cell(figure.title) + ". " + markdown_prose(figure.caption);
    text_ += figures_.empty() ? "\n*" + words + "*\n"
                              : "\n![" + markdown_cell(figure.title) + "](" + figures_ + "/" +
                                    figure.name + ".svg)\n\n" + words + "\n";
  }

  const Document document_;
  const std::string& figures_;
  const std::string heading_;
  std::string text_;
};

}  // namespace

std::string markdown_document(const Document& document, const std::string& figures, int level) {
  return Writer(in_units(document), figures, level).text();
}

}  // namespace dashpot
