// A document in the units in which people see it.
#include "dashpot/report/document.h"
#include "dashpot/report/quantity.h"

namespace dashpot {
namespace {

/// Replaces what words carry, part by part.
class Shower {
 public:
  explicit Shower(const PrintUnits& units) : units_(units) {}

  void show(std::string& text) const { text = in_units(text, units_); }
  void show(std::vector<std::string>& texts) const {
    for (std::string& text : texts) show(text);
  }

  void show(DocumentTable& table) const {
    show(table.title);
    show(table.note);
    for (TextColumn& column : table.columns) {
      show(column.title);
      show(column.hint);
    }
    for (std::vector<std::string>& row : table.rows) show(row);
  }

  void show(FigurePanel& panel) const {
    show(panel.title);
    show(panel.note);
    show(panel.places);
    axis(panel.x_label, panel.x_unit);
    axis(panel.y_label, panel.y_unit);
    const double x = units_.of(panel.x_unit).factor, y = units_.of(panel.y_unit).factor;
    for (FigureSeries& series : panel.series) {
      show(series.label);
      show(series.reading);
      scale(series.x, x);
      scale(series.y, y);
    }
    panel.x_unit = panel.y_unit = {};
  }

  void show(DocumentSection& section) const {
    for (std::string* text : {&section.title, &section.lead, &section.plain}) show(*text);
    for (auto* texts : {&section.paragraphs, &section.remarks}) show(*texts);
    for (DocumentTable& table : section.tables) show(table);
    for (DocumentFigure& figure : section.figures) {
      show(figure.title);
      show(figure.caption);
      for (FigurePanel& panel : figure.panels) show(panel);
    }
    for (DocumentList& list : section.lists) {
      show(list.title);
      show(list.lines);
    }
    for (auto& [term, meaning] : section.facts) {
      show(term);
      show(meaning);
    }
  }

  void show(SharedSamples& samples) const {
    scale(samples.values, units_.of(samples.unit).factor);
    samples.unit = {};
  }

 private:
  /// "Force" in N: "Force (lbf)"; the unit alone where there are no words.
  void axis(std::string& label, const std::string& unit) const {
    show(label);
    if (unit.empty()) return;
    const std::string& name = units_.of(unit).name;
    label = label.empty() ? name : label + " (" + name + ")";
  }

  static void scale(std::vector<double>& values, double factor) {
    if (factor == 1) return;
    for (double& value : values) value *= factor;
  }

  const PrintUnits& units_;
};

}  // namespace

Document in_units(Document document) {
  const Shower shower(document.units);
  for (std::string* text : {&document.title, &document.subtitle, &document.verdict})
    shower.show(*text);
  for (DocumentSection& section : document.sections) shower.show(section);
  shower.show(document.provenance);
  for (KeyFigure& figure : document.key_figures)
    for (std::string* text : {&figure.value, &figure.unit, &figure.label}) shower.show(*text);
  for (SharedSamples& samples : document.samples) shower.show(samples);
  return document;
}

}  // namespace dashpot
