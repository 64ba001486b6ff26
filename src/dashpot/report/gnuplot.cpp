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

/// Runs a script, which is called `name` in messages. Returns the text that gnuplot printed; throws
/// Error when it cannot be run.
std::string run_gnuplot(const std::string& script, const std::string& name) {
  ChildResult result;
  try {
    result = run_child({"gnuplot", script});
  } catch (const Error& error) {
    throw Error("gnuplot", error.what(), "install gnuplot-nox, or leave the figures out");
  }
  if (!result.succeeded)
    throw Error(name, "gnuplot cannot draw it: " + std::string(trim(result.printed)));
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

GnuplotText listed(const std::vector<GnuplotText>& parts) {
  GnuplotText result;
  for (std::size_t k = 0; k < parts.size(); ++k) result += k == 0 ? parts[k] : ", " + parts[k];
  return result;
}

GnuplotText GnuplotFigure::data(const std::vector<std::span<const double>>& columns) {
  const std::string name = fmt::format("$d{}", ++blocks_);
  data_ += name + " << EOD\n";
  for (std::size_t row = 0; row < columns.front().size(); ++row) {
    for (const std::span<const double> column : columns)
      data_ += std::isfinite(column[row]) ? fmt::format("{:.7g} ", column[row]) : "? ";
    data_ += "\n";
  }
  data_ += "EOD\n";
  return GnuplotText::own(name);
}

std::string GnuplotFigure::script(const std::string& svg, const std::string& pdf) const {
  // Multiplots cannot be replayed on another terminal, hence the loop over terminals in the script
  // itself.
  const GnuplotText loop = gnuplot(
      "do for [kind in \"svg pdf\"] {{\nif (kind eq \"svg\") {{\n"
      "set terminal svg size {:.0f},{:.0f} font 'FreeSans,11' background rgb 'white'\nset output "
      "{}\n}} else {{\n"
      "set terminal pdfcairo size {:.2f}cm,{:.2f}cm font 'FreeSans,8' linewidth 1\nset output "
      "{}\n}}\n",
      width_ * 46, height_ * 46, gnuplot_string(svg), width_, height_, gnuplot_string(pdf));
  return kStyle + data_ + loop.text() + commands_.text() + "unset output\n}\n";
}

std::vector<fs::path> GnuplotFigure::write(const fs::path& folder, const std::string& name) const {
  const fs::path kept = folder / (name + ".gp"), svg = folder / (name + ".svg"),
                 pdf = folder / (name + ".pdf");
  write_file(kept, script(svg.string(), pdf.string()));

  // Gnuplot writes to names only and does not say when a disk is full: it draws into memory, and
  // what is whole goes the way of every file.
  const MemoryFile drawn_svg, drawn_pdf, drawing;
  drawing.write(script(drawn_svg.name(), drawn_pdf.name()));
  const std::string printed = run_gnuplot(drawing.name(), kept.string());
  const auto finish = [&](const MemoryFile& drawn, const fs::path& path, std::string_view end) {
    const std::string content = drawn.content();
    if (!std::string_view(content).substr(0, content.find_last_not_of("\r\n") + 1).ends_with(end))
      throw Error(path.string(), "gnuplot left it unfinished: " + std::string(trim(printed)));
    write_file(path, content);
  };
  finish(drawn_svg, svg, "</svg>");
  finish(drawn_pdf, pdf, "%%EOF");
  return {svg, pdf};
}

}  // namespace dashpot
