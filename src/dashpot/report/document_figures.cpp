// Figures of a document for print.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "dashpot/report/document.h"
#include "dashpot/report/gnuplot.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;

constexpr double kPanelWidth = 8, kWholeWidth = 16, kPanelHeight = 6;  // cm

/// The page's palette on white (page.css).
std::string colour_code(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, const char*>, 10> kPalette{
      {{"measured", "#8b949e"},
       {"modelled", "#0b5cad"},
       {"series-1", "#0072b2"},
       {"series-2", "#e69f00"},
       {"series-3", "#009e73"},
       {"series-4", "#cc79a7"},
       {"series-5", "#d55e00"},
       {"series-6", "#7a828c"},
       {"series-7", "#56b4e9"},
       {"series-8", "#7f6d00"}}};
  for (const auto& [known, code] : kPalette)
    if (known == name) return code;
  return "#1c2127";
}

GnuplotText style_of(const FigureSeries& series) {
  const GnuplotText colour = "lc rgb " + gnuplot_string(colour_code(series.colour));
  if (series.mark == FigureSeries::Mark::Dots)
    return gnuplot("points pt 7 ps {} {}", 0.1 * series.width, colour);
  if (series.mark == FigureSeries::Mark::Rings)
    return gnuplot("points pt 6 ps {} {}", 0.1 * series.width, colour);
  return gnuplot(
      "lines lw {}{} {}", series.width,
      series.mark == FigureSeries::Mark::Dashes ? GnuplotText(" dt (8,5)") : GnuplotText(), colour);
}

/// The unbroken pieces of a curve, each a plot of its own: gnuplot would draw a line across what is
/// missing.
void add_curves(GnuplotFigure& figure, const FigureSeries& series, bool is_listed,
                std::vector<GnuplotText>& curves) {
  const auto is_there = [&](std::size_t i) {
    return std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
  };
  for (std::size_t first = 0; first < series.x.size();) {
    std::size_t last = first;
    while (last < series.x.size() && is_there(last)) ++last;
    if (last > first) {
      const GnuplotText title = is_listed ? " title " + gnuplot_string(series.label) : " notitle";
      curves.push_back(figure.data({std::span(series.x).subspan(first, last - first),
                                    std::span(series.y).subspan(first, last - first)}) +
                       " using 1:2 with " + style_of(series) + title);
      is_listed = false;
    }
    first = last + 1;
  }
}

void draw(GnuplotFigure& figure, const FigurePanel& panel) {
  figure.command("set title " + gnuplot_string(panel.title) + " noenhanced");
  figure.command("set xlabel " + gnuplot_string(panel.x_label) + " noenhanced\nset ylabel " +
                 gnuplot_string(panel.y_label) + " offset 1,0 noenhanced");

  // Words at whole places, or numbers.
  std::vector<GnuplotText> tics;
  for (std::size_t k = 0; k < panel.places.size(); ++k)
    tics.push_back(gnuplot("{} {}", gnuplot_label(panel.places[k]), k));
  figure.command(tics.empty() ? GnuplotText("set xtics auto norotate\nset autoscale x")
                              : gnuplot("set xtics ({}) norotate\nset xrange [-0.6:{}]",
                                        listed(tics), static_cast<double>(tics.size()) - 0.4));

  // Each label once in the legend.
  std::vector<GnuplotText> curves;
  std::vector<std::string> labels;
  for (const FigureSeries& series : panel.series) {
    if (series.x.empty()) continue;
    const bool is_listed = !series.label.empty() &&
                           std::find(labels.begin(), labels.end(), series.label) == labels.end();
    if (is_listed) labels.push_back(series.label);
    add_curves(figure, series, is_listed, curves);
  }
  if (!curves.empty()) figure.command("plot " + listed(curves));
}

}  // namespace

std::vector<fs::path> write_document_figures(const Document& si, const fs::path& folder) {
  const Document document = in_units(si);
  std::vector<fs::path> paths;
  for (const DocumentSection& section : document.sections)
    for (const DocumentFigure& figure : section.figures) {
      const std::size_t rows = (figure.panels.size() + figure.columns - 1) / figure.columns;
      GnuplotFigure drawing(
          figure.columns == 1 ? kWholeWidth : kPanelWidth * static_cast<double>(figure.columns),
          kPanelHeight * static_cast<double>(rows));
      drawing.command(gnuplot("set multiplot layout {},{}", rows, figure.columns));
      for (const FigurePanel& panel : figure.panels) draw(drawing, panel);
      drawing.command("unset multiplot");
      for (fs::path& path : drawing.write(folder, figure.name)) paths.push_back(std::move(path));
    }
  return paths;
}

}  // namespace dashpot
