#include "dashpot/report/gnuplot.h"

#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/child_process.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

namespace fs = std::filesystem;

namespace {

/// What gnuplot printed while it ran the script, or an Error when it could not run it.
std::string run_gnuplot(const fs::path& script) {
  ChildResult result;
  try {
    result = run_child({"gnuplot", script.string()});
  } catch (const Error& error) {
    throw Error("gnuplot", error.what(), "install gnuplot-nox, or leave the figures out");
  }
  if (!result.succeeded)
    throw Error(script.string(), "gnuplot cannot draw it: " + std::string(trim(result.printed)));
  return result.printed;
}

/// Colours of the page, plain axes, a light grid.
constexpr const char* kStyle = R"(set encoding utf8
set border 3 lc rgb '#5b6570' lw 0.8
set tics nomirror out scale 0.6 textcolor rgb '#1c2127'
set grid back lc rgb '#e4e7ea' lw 0.6
set key noenhanced bmargin center horizontal reverse Left samplen 1.4 width -1
set bmargin 5.2
set xlabel offset 0,0.5
set style fill solid 0.85 noborder
set datafile missing '?'
set minussign
)";

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result + "'";
}

std::string GnuplotFigure::data(const std::vector<std::span<const double>>& columns) {
  const std::string name = fmt::format("$d{}", ++blocks_);
  data_ += name + " << EOD\n";
  for (std::size_t row = 0; row < columns.front().size(); ++row) {
    for (const std::span<const double> column : columns)
      data_ += std::isfinite(column[row]) ? fmt::format("{:.7g} ", column[row]) : "? ";
    data_ += "\n";
  }
  data_ += "EOD\n";
  return name;
}

std::vector<fs::path> GnuplotFigure::write(const fs::path& folder, const std::string& name) const {
  const fs::path script = folder / (name + ".gp"), svg = folder / (name + ".svg"),
                 pdf = folder / (name + ".pdf");
  // Multiplots cannot be replayed on another terminal, hence the loop over terminals in the script
  // itself.
  std::string text = kStyle + data_;
  text += fmt::format(
      "do for [kind in \"svg pdf\"] {{\nif (kind eq \"svg\") {{\n"
      "set terminal svg size {:.0f},{:.0f} font 'FreeSans,11' background rgb 'white'\nset output "
      "{}\n}} else "
      "{{\n"
      "set terminal pdfcairo size {:.2f}cm,{:.2f}cm font 'FreeSans,8' linewidth 1\nset output "
      "{}\n}}\n",
      width_ * 46, height_ * 46, gnuplot_quoted(svg.string()), width_, height_,
      gnuplot_quoted(pdf.string()));
  text += commands_ + "unset output\n}\n";
  write_file(script, text);
  const std::string printed = run_gnuplot(script);
  for (const fs::path& figure : {svg, pdf})
    if (!fs::exists(figure) || fs::file_size(figure) == 0)
      throw Error(figure.string(), "gnuplot wrote nothing: " + std::string(trim(printed)));
  return {svg, pdf};
}

}  // namespace dashpot
