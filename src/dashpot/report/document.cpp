#include "dashpot/report/document.h"

#include "dashpot/report/page.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/series.h"

namespace dashpot {
namespace {

/// Words as they stand; a line that begins like Markdown does not occur in sentences.
std::string markdown_section(const DocumentSection& section, const std::string& figures) {
  std::string text = "\n## " + section.title + "\n";
  for (const std::string& paragraph : section.paragraphs)
    text += "\n" + valid_utf8(paragraph) + "\n";
  for (const DocumentTable& table : section.tables) {
    text +=
        "\n**" + markdown_cell(table.title) + "**\n\n" + markdown_table(table.columns, table.rows);
    if (!table.note.empty()) text += "\n" + valid_utf8(table.note) + "\n";
  }
  for (const DocumentFigure& figure : section.figures) {
    const std::string words = markdown_cell(figure.title) + ". " + valid_utf8(figure.caption);
    text += figures.empty() ? "\n*" + words + "*\n"
                            : "\n![" + markdown_cell(figure.title) + "](" + figures + "/" +
                                  figure.name + ".svg)\n\n" + words + "\n";
  }
  if (!section.remarks.empty()) text += "\n";
  for (const std::string& remark : section.remarks) text += "* " + valid_utf8(remark) + "\n";
  return text;
}

std::vector<std::size_t> every(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

const char* mark_name(FigureSeries::Mark mark) {
  if (mark == FigureSeries::Mark::Dots) return "dots";
  return mark == FigureSeries::Mark::Dashes ? "dashes" : "line";
}

Value panel_json(const FigurePanel& panel) {
  Value series = Value::array();
  for (const FigureSeries& one : panel.series) {
    const std::vector<std::size_t> all = every(one.x.size());
    series.push_back(Value::object({{"label", one.label},
                                    {"colour", one.colour},
                                    {"mark", mark_name(one.mark)},
                                    {"width", one.width},
                                    {"x", pack_float32(one.x, all)},
                                    {"y", pack_float32(one.y, all)}}));
  }
  return Value::object({{"title", panel.title},
                        {"x_label", panel.x_label},
                        {"y_label", panel.y_label},
                        {"places", Value::array(panel.places)},
                        {"series", std::move(series)}});
}

Value table_json(const DocumentTable& table) {
  Value columns = Value::array(), rows = Value::array();
  for (const TextColumn& column : table.columns)
    columns.push_back(Value::object({{"title", column.title}, {"numeric", column.numeric}}));
  for (const auto& row : table.rows) rows.push_back(Value::array(row));
  return Value::object({{"title", table.title},
                        {"columns", std::move(columns)},
                        {"rows", std::move(rows)},
                        {"note", table.note}});
}

Value section_json(const DocumentSection& section, bool with_figures) {
  Value tables = Value::array(), figures = Value::array();
  for (const DocumentTable& table : section.tables) tables.push_back(table_json(table));
  for (const DocumentFigure& figure : section.figures) {
    Value panels = Value::array();
    if (with_figures)
      for (const FigurePanel& panel : figure.panels) panels.push_back(panel_json(panel));
    figures.push_back(Value::object({{"name", figure.name},
                                     {"title", figure.title},
                                     {"caption", figure.caption},
                                     {"columns", figure.columns},
                                     {"panels", std::move(panels)}}));
  }
  return Value::object({{"name", section.name},
                        {"title", section.title},
                        {"paragraphs", Value::array(section.paragraphs)},
                        {"tables", std::move(tables)},
                        {"figures", std::move(figures)},
                        {"remarks", Value::array(section.remarks)}});
}

Value whole_json(const Document& document, bool with_figures) {
  Value sections = Value::array();
  for (const DocumentSection& section : document.sections)
    sections.push_back(section_json(section, with_figures));
  return presentable(Value::object({{"page", "document"},
                                    {"title", document.title},
                                    {"subtitle", document.subtitle},
                                    {"verdict", document.verdict},
                                    {"sections", std::move(sections)},
                                    {"command", document.command},
                                    {"version", document.version},
                                    {"date", document.date}}));
}

}  // namespace

std::string html_document(const Document& document) {
  std::string summary = document.verdict;
  for (const DocumentSection& section : document.sections)
    for (const DocumentTable& table : section.tables)
      summary += "\n\n" + table.title + "\n" + text_table(table.columns, table.rows, 120);
  return make_page(document.title, summary, whole_json(document, true));
}

std::string markdown_document(const Document& document, const std::string& figures) {
  std::string text = "# " + document.title + "\n\n" + valid_utf8(document.subtitle) + "\n\n" +
                     valid_utf8(document.verdict) + "\n";
  for (const DocumentSection& section : document.sections)
    text += markdown_section(section, figures);
  return text + "\nMade by `" + document.command + "` (Dashpot " + document.version + ").\n";
}

Value document_json(const Document& document) { return whole_json(document, false); }

}  // namespace dashpot
