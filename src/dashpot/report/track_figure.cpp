#include "dashpot/report/track_figure.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "dashpot/report/gnuplot.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr double kShown = 2;  // s: more would hide how the force follows
constexpr std::array kColours = {"#0b5cad", "#be481e", "#3ca05f", "#d69614"};

GnuplotText curve(const GnuplotText& data, const GnuplotText& columns, const GnuplotText& style,
                  const std::string& title) {
  return data + " using " + columns + " with " + style +
         (title.empty() ? GnuplotText(" notitle") : " title " + gnuplot_string(title));
}

}  // namespace

std::vector<std::filesystem::path> write_track_figure(const std::vector<TrackedScheme>& schemes,
                                                      DriveUnit drive_unit,
                                                      const std::filesystem::path& folder) {
  GnuplotFigure figure(17, 13);
  const TrackReport& first = schemes.front().report;
  const auto end = std::ranges::find_if(first.time, [](double t) { return t > kShown; });
  const auto samples = static_cast<std::size_t>(end - first.time.begin());
  const auto shown = [&](const std::vector<double>& values) {
    return std::span(values).first(samples);
  };

  const GnuplotText wanted = figure.data(
      {shown(first.time), shown(first.wanted), shown(first.least), shown(first.greatest)});
  std::vector<GnuplotText> forces{
      curve(wanted, "1:3:4", "filledcurves fs solid 0.2 noborder lc rgb '#8b949e'",
            "in reach of " + schemes.front().name),
      curve(wanted, "1:2", "lines lw 3 lc rgb '#8b949e'", "wanted")};
  std::vector<GnuplotText> currents;
  for (std::size_t k = std::min(schemes.size(), kColours.size()); k-- > 0;) {  // the first on top
    const auto& [name, report] = schemes[k];
    const GnuplotText data =
        figure.data({shown(report.time), shown(report.obtained), shown(report.current)});
    const GnuplotText style = "lines lw 1.2 lc rgb " + gnuplot_string(kColours[k]);
    forces.push_back(curve(data, "1:2", style,
                           fmt::format("{}, {} %", name, percent_text(report.all.rms_span))));
    currents.push_back(curve(data, "1:3", style, {}));
  }
  figure.command("set multiplot layout 2,1\nset xrange [] noextend\nset lmargin 10\nset rmargin 2");
  figure.command("set ylabel 'Force (N)' offset 1,0\nplot " + listed(forces));
  figure.command(
      "unset key\nset bmargin 3.2\nset ylabel " +
      gnuplot_string(drive_unit == DriveUnit::Volt ? "Coil voltage (V)" : "Coil current (A)") +
      "\nset xlabel 'Time (s)'\nplot " + listed(currents) + "\nunset multiplot");
  return figure.write(folder, "track");
}

}  // namespace dashpot
