#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// Text as a gnuplot string in single quotes; line ends become spaces.
std::string gnuplot_quoted(const std::string& text);

/// A figure for print: gnuplot commands and the data blocks that they use.
class GnuplotFigure {
 public:
  /// `width`, `height` in cm.
  GnuplotFigure(double width, double height) : width_(width), height_(height) {}

  void command(const std::string& line) { commands_ += line + "\n"; }
  /// Adds columns of equal length as a data block and returns its name ("$d3"). Numbers that are
  /// not finite leave a gap.
  std::string data(const std::vector<std::span<const double>>& columns);

  /// Draws <name>.svg and <name>.pdf into `folder`; the script with its data stays beside them as
  /// <name>.gp, so that a figure can be changed by hand. Returns the paths of the figures. Throws
  /// Error when gnuplot is missing or complains.
  std::vector<std::filesystem::path> write(const std::filesystem::path& folder,
                                           const std::string& name) const;

 private:
  double width_, height_;
  std::string data_, commands_;
  int blocks_ = 0;
};

}  // namespace dashpot
