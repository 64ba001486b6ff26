#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "dashpot/base/escape.h"

namespace dashpot {

/// `format` with its {} replaced by numbers or by more of gnuplot's code: other text does not
/// compile and needs gnuplot_string() first.
template <std::size_t size, class... Parts>
GnuplotText gnuplot(const char (&format)[size], const Parts&... parts) {
  const auto code = [](const auto& part) -> decltype(auto) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(part)>>)
      return part;
    else
      return static_cast<const GnuplotText&>(part).text();
  };
  return GnuplotText::own(fmt::format(fmt::runtime(format), code(parts)...));
}

/// "a, b, c"
GnuplotText listed(const std::vector<GnuplotText>& parts);

/// A figure for print: gnuplot commands and the data blocks that they use.
class GnuplotFigure {
 public:
  /// `width`, `height` in cm.
  GnuplotFigure(double width, double height) : width_(width), height_(height) {}

  void command(const GnuplotText& line) { commands_ += line + "\n"; }
  /// Adds columns of equal length as a data block and returns its name ("$d3"). Numbers that are
  /// not finite leave a gap.
  GnuplotText data(const std::vector<std::span<const double>>& columns);

  /// Draws <name>.svg and <name>.pdf into `folder`; the script with its data stays beside them as
  /// <name>.gp, so that a figure can be changed by hand. Returns the paths of the figures. Throws
  /// Error when gnuplot is missing, complains or leaves a figure unfinished; the files that stood
  /// there are unchanged then.
  std::vector<std::filesystem::path> write(const std::filesystem::path& folder,
                                           const std::string& name) const;

 private:
  /// What gnuplot reads to draw into these two files.
  std::string script(const std::string& svg, const std::string& pdf) const;

  double width_, height_;
  std::string data_;
  GnuplotText commands_;
  int blocks_ = 0;
};

}  // namespace dashpot
