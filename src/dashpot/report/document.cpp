// A document as JSON: for programs, and for the page's own program.
#include "dashpot/report/document.h"

#include "dashpot/base/escape.h"
#include "dashpot/report/page.h"
#include "dashpot/report/series.h"

namespace dashpot {
namespace {

std::vector<std::size_t> every(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

Value indices(const std::vector<std::size_t>& places) {
  Value list = Value::array();
  for (const std::size_t place : places) list.push_back(place);
  return list;
}

Value when_json(const When& when) {
  Value json = Value::object();
  for (const auto& [name, options] : when) json.add(name, indices(options));
  return json;
}

/// Empty words and unset flags are left out: pages hold thousands of series.
void add_words(Value& json, const char* key, const std::string& words) {
  if (!words.empty()) json.add(key, words);
}
void add_flag(Value& json, const char* key, bool flag) {
  if (flag) json.add(key, true);
}
void add_when(Value& json, const When& when) {
  if (!when.empty()) json.add("when", when_json(when));
}

const char* mark_name(FigureSeries::Mark mark) {
  constexpr const char* kNames[] = {"line", "dashes", "dots", "rings", "bars", "area", "span"};
  return kNames[static_cast<std::size_t>(mark)];
}

Value series_json(const FigureSeries& one) {
  Value json = Value::object({{"label", one.label},
                              {"colour", one.colour},
                              {"mark", mark_name(one.mark)},
                              {"width", one.width}});
  if (one.shared) {
    json.add("x", one.shared->x);
    json.add("y", one.shared->y);
    if (one.shared->minus) json.add("minus", *one.shared->minus);
    if (one.shared->half_width) json.add("half_width", *one.shared->half_width);
    if (one.shared->first > 0) json.add("first", one.shared->first);
  } else {
    json.add("x", pack_float32(one.x, every(one.x.size())));
    json.add("y", pack_float32(one.y, every(one.y.size())));
  }

  // How it is listed and read.
  if (!one.names.empty()) json.add("names", Value::array(one.names));
  add_words(json, "reading", one.reading);
  add_flag(json, "unlisted", one.label.empty() || !one.is_listed);
  add_flag(json, "silent", one.label.empty() || !one.is_read);
  if (one.opacity < 1) json.add("opacity", one.opacity);
  add_when(json, one.when);
  return json;
}

Value panel_json(const FigurePanel& panel) {
  Value series = Value::array();
  for (const FigureSeries& one : panel.series) series.push_back(series_json(one));
  Value json = Value::object({{"title", panel.title},
                              {"x_label", panel.x_label},
                              {"y_label", panel.y_label},
                              {"height", panel.height},
                              {"places", Value::array(panel.places)},
                              {"series", std::move(series)}});

  // Parts that only some panels have.
  add_words(json, "note", panel.note);
  add_words(json, "empty", panel.empty);
  add_flag(json, "x_log", panel.x_log);
  add_flag(json, "y_log", panel.y_log);
  add_flag(json, "reads_along_x", panel.reads_along_x);
  return json;
}

Value figure_json(const DocumentFigure& figure) {
  Value panels = Value::array();
  for (const FigurePanel& panel : figure.panels) panels.push_back(panel_json(panel));
  return Value::object({{"title", figure.title},
                        {"caption", figure.caption},
                        {"columns", figure.columns},
                        {"panels", std::move(panels)}});
}

/// The shown columns of each row.
template <typename Cell>
Value matrix_json(const std::vector<std::vector<Cell>>& rows,
                  const std::vector<std::size_t>& shown) {
  Value matrix = Value::array();
  for (const auto& row : rows) {
    Value cells = Value::array();
    for (const std::size_t k : shown) cells.push_back(row[k]);
    matrix.push_back(std::move(cells));
  }
  return matrix;
}

Value table_json(const DocumentTable& table) {
  const std::vector<std::size_t> shown = columns_for(table.columns, Audience::Page);
  Value columns = Value::array();
  for (const std::size_t k : shown) {
    const TextColumn& column = table.columns[k];
    Value json = Value::object({{"title", column.title}, {"numeric", column.numeric}});
    add_words(json, "hint", column.hint);
    add_flag(json, "descending", column.descending);
    columns.push_back(std::move(json));
  }
  Value json = Value::object({{"title", table.title},
                              {"columns", std::move(columns)},
                              {"rows", matrix_json(table.rows, shown)},
                              {"note", table.note}});

  // Parts that only some tables have: keys to sort by, shades, marked rows, rows that choose.
  if (!table.keys.empty()) json.add("keys", matrix_json(table.keys, shown));
  if (!table.shades.empty()) json.add("shades", matrix_json(table.shades, shown));
  for (const auto& [name, marks] :
       {std::pair{"warnings", &table.warnings}, std::pair{"leaders", &table.leaders}}) {
    if (marks->empty()) continue;
    Value rows = Value::array();
    for (const bool mark : *marks) rows.push_back(mark);
    json.add(name, std::move(rows));
  }
  if (!table.chooses.empty()) {
    Value chooses = Value::array();
    for (const auto& changes : table.chooses) {
      Value row = Value::object();
      for (const auto& [name, option] : changes) row.add(name, option);
      chooses.push_back(std::move(row));
    }
    json.add("chooses", std::move(chooses));
    add_words(json, "leads_to", table.leads_to);
  }
  add_flag(json, "folded", table.folded);
  add_when(json, table.when);
  return json;
}

Value list_json(const DocumentList& list) {
  Value json = Value::object({{"title", list.title}, {"lines", Value::array(list.lines)}});
  add_flag(json, "folded", list.folded);
  add_when(json, list.when);
  return json;
}

Value choice_json(const DocumentChoice& choice) {
  return Value::object({{"name", choice.name},
                        {"label", choice.label},
                        {"options", Value::array(choice.options)},
                        {"chosen", choice.chosen}});
}

Value plane_json(const DocumentPlane& plane) {
  Value quantities = Value::array(), outstanding = Value::array();
  for (const DocumentPlane::Quantity& one : plane.quantities)
    quantities.push_back(Value::object({{"name", one.name},
                                        {"label", one.label},
                                        {"values", Value::array(one.values)},
                                        {"second", Value::array(one.second)},
                                        {"bound", one.bound ? Value(*one.bound) : Value()}}));
  for (const bool is_outstanding : plane.outstanding) outstanding.push_back(is_outstanding);

  // Names stand once for all quantities.
  return Value::object({{"title", plane.title},
                        {"note", plane.note},
                        {"quantities", std::move(quantities)},
                        {"names", Value::array(plane.names)},
                        {"outstanding", std::move(outstanding)},
                        {"points_label", plane.points_label},
                        {"outstanding_label", plane.outstanding_label},
                        {"second_label", plane.second_label},
                        {"choice", plane.choice}});
}

/// `first`: the place of its first program among those of the page.
Value sliders_json(const DocumentSliders& sliders, std::size_t first) {
  Value models = Value::array();
  for (const DocumentSliders::Model& model : sliders.models)
    models.push_back(Value::object({{"name", model.name}, {"program", first++}}));

  Value loops = Value::array();
  for (const DocumentSliders::Loop& loop : sliders.loops)
    loops.push_back(Value::object({{"name", loop.name},
                                   {"current", loop.drive},
                                   {"conditions", conditions_json(loop.conditions)},
                                   {"displacement", loop.displacement},
                                   {"velocity", loop.velocity},
                                   {"force", loop.force},
                                   {"first", loop.first}}));
  return Value::object({{"models", std::move(models)}, {"records", std::move(loops)}});
}

/// Those of the parts that a page shows.
template <typename Part, typename ToJson>
Value parts_json(const std::vector<Part>& parts, const ToJson& to_json) {
  Value list = Value::array();
  for (const Part& part : parts) {
    if constexpr (requires { part.audience; })
      if (!reaches(part.audience, Audience::Page)) continue;
    list.push_back(to_json(part));
  }
  return list;
}

/// `programs`: those of the page so far, to which its own come.
Value section_json(const DocumentSection& section, std::vector<JsText>& programs) {
  Value facts = Value::array();
  for (const auto& [name, meaning] : section.facts)
    facts.push_back(Value::array(std::vector<std::string>{name, meaning}));

  Value sliders;
  if (section.sliders) {
    sliders = sliders_json(*section.sliders, programs.size());
    for (const DocumentSliders::Model& model : section.sliders->models)
      programs.push_back(model.program);
  }

  // In the order in which a page draws them.
  return Value::object({{"name", section.name},
                        {"title", section.title},
                        {"lead", section.lead},
                        {"paragraphs", Value::array(section.paragraphs)},
                        {"choices", parts_json(section.choices, choice_json)},
                        {"plane", section.plane ? plane_json(*section.plane) : Value()},
                        {"sliders", std::move(sliders)},
                        {"tables", parts_json(section.tables, table_json)},
                        {"figures", parts_json(section.figures, figure_json)},
                        {"remarks", Value::array(section.remarks)},
                        {"lists", parts_json(section.lists, list_json)},
                        {"facts", std::move(facts)}});
}

Value key_figure_json(const KeyFigure& figure) {
  return Value::object({{"value", figure.value}, {"unit", figure.unit}, {"label", figure.label}});
}

Value samples_json(const SharedSamples& samples) {
  const std::vector<std::size_t> all = every(samples.values.size());
  return samples.is_exact ? pack_float32(samples.values, all) : pack_int16(samples.values, all);
}

/// How a page's own programs, which compute in SI, show what they draw.
Value units_json(const PrintUnits& units) {
  Value json = Value::object();
  for (const char* si_unit : {"N", "m", "m/s", "J"}) {
    const PrintUnit unit = units.of(si_unit);
    json.add(si_unit, Value::object({{"name", unit.name}, {"factor", unit.factor}}));
  }
  return json;
}

/// All that page/document.js draws; the programs that it runs come to `programs`.
Value page_json(const Document& document, std::vector<JsText>& programs) {
  const auto to_json = [&](const DocumentSection& section) {
    return section_json(section, programs);
  };
  return presentable(
      Value::object({{"kind", document.kind},
                     {"title", document.title},
                     {"subtitle", document.subtitle},
                     {"verdict", document.verdict},
                     {"key_figures", parts_json(document.key_figures, key_figure_json)},
                     {"sections", parts_json(document.sections, to_json)},
                     {"provenance", to_json(document.provenance)},
                     {"samples", parts_json(document.samples, samples_json)},
                     {"units", units_json(document.units)},
                     {"command", document.command},
                     {"version", document.version},
                     {"date", document.date}}));
}

}  // namespace

Value conditions_json(const Conditions& conditions) {
  Value value = Value::object();
  for (const auto& [name, number] : conditions) value.add(name, number);
  return value;
}

void add_row(DocumentTable& table, const std::vector<DocumentCell>& cells) {
  std::vector<std::string> texts;
  std::vector<double> keys;
  for (const DocumentCell& cell : cells) {
    texts.push_back(cell.text);
    keys.push_back(cell.key);
  }
  table.rows.push_back(std::move(texts));
  table.keys.push_back(std::move(keys));
}

std::string html_document(const Document& si) {
  const Document document = in_units(si);
  std::vector<JsText> programs;
  const Value data = page_json(document, programs);
  return make_page(document.title, document_text(document, 100), data, programs);
}

Value document_json(const Document& si) {
  if (!si.data.is_null()) return presentable(si.data);
  const Document document = in_units(si);

  // Cells are given as text, as people read them.
  Value sections = Value::array();
  for (const DocumentSection& section : document.sections) {
    Value tables = Value::array();
    for (const DocumentTable& table : section.tables) {
      std::vector<std::string> titles;
      for (const TextColumn& column : table.columns) titles.push_back(column.title);
      tables.push_back(
          Value::object({{"title", table.title},
                         {"columns", Value::array(titles)},
                         {"rows", matrix_json(table.rows, every(table.columns.size()))},
                         {"note", table.note}}));
    }
    sections.push_back(Value::object({{"name", section.name},
                                      {"title", section.title},
                                      {"paragraphs", Value::array(section.paragraphs)},
                                      {"tables", std::move(tables)},
                                      {"remarks", Value::array(section.remarks)}}));
  }
  return presentable(Value::object({{"title", document.title},
                                    {"subtitle", document.subtitle},
                                    {"verdict", document.verdict},
                                    {"sections", std::move(sections)},
                                    {"command", document.command},
                                    {"version", document.version},
                                    {"date", document.date}}));
}

}  // namespace dashpot
