#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/error.h"
#include "dashpot/report/gnuplot.h"
#include "dashpot/report/search_report.h"

namespace dashpot {
namespace {

/// Parameters and ESR of some trials.
struct Points {
  std::vector<double> parameters, errors;
  void add(const Trial& trial) {
    parameters.push_back(static_cast<double>(trial.parameters));
    errors.push_back(trial.left_out.esr);
  }
};

/// A logarithmic axis that holds these values with some room.
GnuplotText log_range(const std::vector<double>& values) {
  constexpr double kRoom = 1.25;
  const auto [low, high] = std::ranges::minmax(values);
  return gnuplot("[{:.4g}:{:.4g}]", low / kRoom, high * kRoom);
}

/// "(2, 5, 10, 20)": round numbers over the values, for a logarithmic axis has labels at powers of
/// ten only.
GnuplotText log_tics(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  const std::vector<double> digits = high < 6 * low
                                         ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}
                                         : std::vector<double>{1, 2, 5};
  std::vector<GnuplotText> tics;
  for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::log10(high);
       ++power)
    for (const double digit : digits)
      tics.push_back(gnuplot("{:.4g}", digit * std::pow(10, power)));
  return "(" + listed(tics) + ")";
}

/// A curve of the plot; nothing without points.
void add_curve(GnuplotFigure& figure, std::vector<GnuplotText>& curves, const Points& points,
               const GnuplotText& style) {
  if (points.parameters.empty()) return;
  curves.push_back(figure.data({points.parameters, points.errors}) + " using 1:2 with " + style);
}

}  // namespace

std::vector<std::filesystem::path> write_search_figure(const SearchReport& search,
                                                       const std::filesystem::path& folder) {
  if (!search.best()) throw Error("figures", "no trial is usable");
  Points all, dropped, finalists, front, smallest;
  for (const Trial& trial : search.trials) {
    if (trial.is_usable()) all.add(trial);
    if (trial.is_usable()) (search.is_finalist(trial) ? finalists : dropped).add(trial);
    if (trial.on_front) front.add(trial);
  }
  smallest.add(*search.smallest());

  // Logarithmic axes with round numbers.
  GnuplotFigure figure(13, 9);
  figure.command("set logscale xy\nset xlabel 'Parameters'\nset ylabel 'Left-out error, ESR (%)'");
  figure.command("set key outside top center");
  figure.command("set xrange " + log_range(all.parameters) + "\nset yrange " +
                 log_range(all.errors));
  figure.command("set xtics " + log_tics(all.parameters) + "\nset ytics " + log_tics(all.errors));

  // Dropped trials below, the choice on top.
  std::vector<GnuplotText> curves;
  add_curve(figure, curves, dropped,
            "points pt 6 ps 0.5 lc rgb '#8b949e' title 'dropped on the way'");
  add_curve(figure, curves, finalists, "points pt 7 ps 0.5 lc rgb '#0b5cad' title 'trials'");
  add_curve(figure, curves, front, "lines lw 1 lc rgb '#be481e' title 'front'");
  add_curve(
      figure, curves, smallest,
      "points pt 6 ps 1.4 lw 1.5 lc rgb '#be481e' title 'smallest within one standard error'");
  figure.command("plot " + listed(curves));
  return figure.write(folder, "search");
}

}  // namespace dashpot
